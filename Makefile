# One verb per chore; continuous integration uses the same.
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
PAGE := $(shell find web/ui \( -name node_modules -o -name tests -o -name api-types.ts \) -prune -o -type f -print) \
	web/openapi.json station/messages/en.json hatch_build.py deploy/node.py
PIP := $(BIN)/python -m pip --disable-pip-version-check
NPM := $(BIN)/python deploy/node.py
PROGRAMS := chromium curl firefox-esr fonts-dejavu-core fonts-wqy-microhei mbpoll mosquitto nginx
TESTS := $(BIN)/pytest --numprocesses 3 --dist loadfile --no-loadscope-reorder

.PHONY: run test coverage record pictures plans page-figures lint format bench security mutate reference lock bundle check-bundle clean

run: $(VENV)/installed  ## install and start the service on the emulated rig; prints the address
	$(BIN)/station serve

test: $(VENV)/installed-for-tests  ## everything that can be checked
	$(NPM) test
	$(NPM) ci --prefix ../../tests/web/provider
	$(NPM) ci --prefix ../../tests/browser/firefox
	deploy/debian-packages $(PROGRAMS)
	$(TESTS)

coverage: $(VENV)/installed-for-tests  ## the same tests, with the lines that none of them runs (slower)
	deploy/debian-packages $(PROGRAMS)
	$(TESTS) --cov=station --cov=drivers --cov=web

record: $(VENV)/installed-for-tests  ## the closed loop in the browser, recorded; prints the folder
	deploy/debian-packages chromium
	folder=$$(mktemp -d) && STATION_RECORD=$$folder $(BIN)/pytest tests/browser/test_diagnosing.py && \
	echo "Recorded in $$folder; watch one with: $(BIN)/playwright show-trace FILE.zip"

pictures: $(VENV)/installed-for-tests  ## reference pictures of the page; look at what changed (git diff) before a commit
	deploy/debian-packages chromium fonts-dejavu-core fonts-wqy-microhei
	STATION_PICTURES=$${STATION_PICTURES:-1} $(BIN)/pytest tests/browser/test_languages.py tests/browser/test_states.py -k picture

plans: $(VENV)/installed-for-tests  ## every plan done at the page; the pictures of docs/how-to/plans (minutes)
	deploy/debian-packages chromium fonts-dejavu-core
	$(BIN)/python -m tests.browser.plans docs/how-to/plans

page-figures: $(VENV)/installed-for-tests  ## the page's figures of docs/benchmarks.md, measured in Chromium
	deploy/debian-packages chromium
	$(BIN)/python -m tests.browser.page_figures

lint: $(VENV)/installed-for-tests  ## style, types, import layers, spelling
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy
	$(BIN)/lint-imports
	$(BIN)/codespell
	$(NPM) run lint

format: $(VENV)/installed-for-tests
	$(BIN)/ruff check --fix .
	$(BIN)/ruff format .
	$(NPM) run format

bench: $(VENV)/installed-for-tests  ## the figures of docs/benchmarks.md
	$(BIN)/station bench

security: $(VENV)/installed-for-tests  ## bandit, then 2,000 requests as each role and as nobody (half an hour)
	$(BIN)/bandit --quiet --recursive station drivers web deploy --exclude ./web/ui,./web/static -lll
	$(BIN)/python -m tests.web.fuzz --cases 2000

mutate: $(VENV)/installed-for-tests  ## changes what decides, one place at a time; lists what no test notices (hours)
	mkdir -p mutants
	@echo "Progress goes to mutants/progress.log"
	$(BIN)/mutmut run > mutants/progress.log 2>&1
	$(BIN)/python tests/mutation_score.py mutants

reference: $(VENV)/installed-for-tests  ## docs/reference, web/openapi.json and the client's models, made from the code
	$(BIN)/python -m web.openapi
	$(BIN)/python -m station.reference docs/reference
	$(BIN)/python web/client/make_models.py

lock: $(VENV)/installed-for-tests  ## newest versions that fit, with hashes
	deploy/lock $(BIN)

bundle: $(VENV)/installed-for-tests  ## dist/bundle, which installs on a computer without internet
	deploy/bundle $(BIN) dist/bundle

check-bundle: bundle  ## installs it in a clean Debian tree without a network; as root, needs debootstrap (minutes)
	deploy/check-bundle dist/bundle

clean:
	rm -rf $(VENV) dist web/static web/ui/node_modules

$(VENV)/bin/python:
	@echo "Making a virtual environment in $(VENV)"
	deploy/python-venv $(PYTHON) $(VENV)

$(VENV)/installed: deploy/requirements.lock pyproject.toml $(PAGE) | $(VENV)/bin/python
	@echo "Installing the station: 1 of 2, libraries (a minute)"
	$(PIP) install --require-hashes -r deploy/requirements.lock
	@echo "Installing the station: 2 of 2, the station and its page (a minute; Node.js is fetched if there is none)"
	$(PIP) install --no-deps --editable .
	$(BIN)/python -m compileall -q station drivers web/*.py web/routes
	touch $@

$(VENV)/installed-for-tests: tests/requirements.lock $(VENV)/installed
	@echo "Installing what tests and checks need (a minute)"
	$(PIP) install --require-hashes --no-deps --no-compile -r tests/requirements.lock
	touch $@
