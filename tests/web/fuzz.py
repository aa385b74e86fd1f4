"""Requests made from the OpenAPI file, as each role and as nobody: no failure, no privilege gained.

    python -m tests.web.fuzz --cases 2000 [--as viewer] [--seed 1]

schemathesis makes the requests, valid and invalid ones; a real service on the emulated machine answers them
over a socket. No answer may be a failure of the service; it must be a refusal if the table of roles requires
it; and it must agree with the OpenAPI file.
"""

from __future__ import annotations

import argparse
import logging
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, get_args

import schemathesis
from hypothesis import HealthCheck, Phase, given, seed, settings
from schemathesis import GenerationMode
from schemathesis.checks import load_all_checks
from schemathesis.config import SchemathesisConfig
from schemathesis.core.failures import Failure, FailureGroup
from schemathesis.core.result import Ok

from station.people import ALLOWED, Permission, new_secret, secret_hash
from station.records import Actor, Role
from station.reference import route_needs
from station.service import Runtime
from station.settings import EmulatedSettings, ServiceSettings, Settings
from tests.web.conftest import listening
from web.app import create_app
from web.application import kept_description

ROOT = Actor(name="root", via="terminal")
NOBODY = "nobody"
EVERYBODY = (NOBODY, *get_args(Role))
KEPT_OUT = (401, 403)
ANSWERS = {"/api/v1/stop": 502, "/readyz": 503}
"""Statuses that are valid answers there: an axis with an ordered fault did not confirm, or is not ready."""
CONFORMING = ("response_schema_conformance", "content_type_conformance", "status_code_conformance")
WAIT_S = 60.0


@dataclass
class Found:
    """The result of one author's requests."""

    cases: int = 0
    statuses: Counter[int] = field(default_factory=Counter)
    wrong: dict[str, str] = field(default_factory=dict)
    """The first request for each kind of fault and location."""

    def note(self, what: str, case: Any) -> None:
        self.wrong.setdefault(what, case.as_curl_command()[:600])


class Asker:
    """One role, or nobody, with one station."""

    def __init__(self, who: str, runtime: Runtime, address: str) -> None:
        self.who, self._runtime, self._address = who, runtime, address
        self._needs = {(need.method, need.path): need.permission for need in route_needs()}
        self.headers = self._key()
        self.found = Found()

    def _key(self) -> dict[str, str]:
        if self.who == NOBODY:
            return {}
        key = new_secret("fbs_")
        role: Any = self.who
        self._runtime.store.add_key(ROOT, f"{role} {time.time_ns()}", role, secret_hash(key), None)
        return {"Authorization": f"Bearer {key}"}

    def try_out(self, operation: Any, cases: int, number: int) -> None:
        """This many requests of one operation."""

        @seed(number)
        @settings(
            max_examples=cases,
            database=None,
            deadline=None,
            phases=[Phase.explicit, Phase.generate],
            suppress_health_check=list(HealthCheck),
        )
        @given(
            case=operation.as_strategy(generation_mode=GenerationMode.POSITIVE)
            | operation.as_strategy(generation_mode=GenerationMode.NEGATIVE)
        )
        def ask(case: Any) -> None:
            self.ask(case)

        ask()

    def ask(self, case: Any) -> None:
        for header in ("Authorization", "Cookie"):
            case.headers.pop(header, None)
        answer = case.call(base_url=self._address, headers=self.headers, timeout=WAIT_S)
        if answer.status_code == 401 and self.headers and self._revoked():
            self.headers = self._key()
            answer = case.call(base_url=self._address, headers=self.headers, timeout=WAIT_S)
        self.found.cases += 1
        self.found.statuses[answer.status_code] += 1
        self._judge(case, answer)

    def _revoked(self) -> bool:
        digest = secret_hash(self.headers["Authorization"].removeprefix("Bearer "))
        kept = self._runtime.store.key(digest)
        return kept is None or kept.revoked_at is not None

    def _judge(self, case: Any, answer: Any) -> None:
        path, status = case.operation.path, answer.status_code
        name = f"{case.method} {path}"
        if status == 404 and answer.json().get("detail") == "Not Found":
            return  # no route matched: a serial with a line break, for instance
        permission = self._needs.get((case.method.upper(), path), Permission.ENTER)
        if status >= 500 and ANSWERS.get(path) != status:
            self.found.note(f"{name}: {status} {answer.text[:200]}", case)
        may = permission is Permission.ENTER or (self.who in ALLOWED[permission])
        panel = permission is Permission.STOP  # a stop from this computer needs no sign-in
        if not (may or panel) and status not in (*KEPT_OUT, 405):
            self.found.note(f"{name}: {self.who} got {status}", case)
        try:
            case.validate_response(answer, checks=_checks())
        except (Failure, FailureGroup) as failure:
            several = failure.exceptions if isinstance(failure, FailureGroup) else [failure]
            for one in several:
                self.found.note(f"{name}: {status} {type(one).__name__} {str(one)[:300]}", case)


def _checks() -> list[Any]:
    load_all_checks()
    return schemathesis.checks.CHECKS.get_by_names(list(CONFORMING))


@contextmanager
def station() -> Iterator[tuple[Runtime, str]]:
    """A station on the emulated machine, where everybody has to sign in."""
    with tempfile.TemporaryDirectory() as folder:
        wanted = Settings(service=ServiceSettings(open=False), emulated=EmulatedSettings(speed=1000.0))
        with Runtime.open(wanted, Path(folder)) as runtime, listening(create_app(runtime)) as port:
            runtime.store.add_user(ROOT, "Ada", "administrator", password_hash="none")
            yield runtime, f"http://127.0.0.1:{port}"


def fuzz(who: str, cases: int, number: int) -> Found:
    """This many requests as one role, spread over all operations."""
    document = kept_description()
    schema = schemathesis.openapi.from_dict(document, config=SchemathesisConfig())
    operations = [found.ok() for found in schema.get_all_operations() if isinstance(found, Ok)]
    with station() as (runtime, address):
        asker = Asker(who, runtime, address)
        users = {(user.name, user.role) for user in runtime.store.users()}
        keys = {(key.name, key.role) for key in runtime.store.api_keys()}
        while (left := cases - asker.found.cases) > 0:  # some operations have few requests
            for operation in operations:
                asker.try_out(operation, -(-left // len(operations)), number)
            number += 1
        if who != "administrator":
            grown = {(user.name, user.role) for user in runtime.store.users()} != users
            if grown or {(key.name, key.role) for key in runtime.store.api_keys()} != keys:
                asker.found.wrong["users or keys have changed"] = ""
        checked = runtime.store.check_audit()
        if checked.broken is not None:
            asker.found.wrong["the audit is broken"] = str(checked.broken)
    return asker.found


def main() -> int:
    """0, or 1 if a requirement is violated."""
    parser = argparse.ArgumentParser(prog="python -m tests.web.fuzz")
    parser.add_argument("--cases", type=int, default=2000, help="of each")
    parser.add_argument("--as", dest="who", choices=EVERYBODY, action="append")
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    logging.disable(logging.CRITICAL)
    wrong = 0
    for who in arguments.who or EVERYBODY:
        began_s = time.monotonic()
        found = fuzz(who, arguments.cases, arguments.seed)
        statuses = ", ".join(f"{status}: {n}" for status, n in sorted(found.statuses.items()))
        print(f"{who}: {found.cases} cases in {time.monotonic() - began_s:.0f} s ({statuses})", flush=True)
        for what, request in found.wrong.items():
            print(f"  {what}\n    {request}", flush=True)
        wrong += len(found.wrong)
    print(f"{wrong} wrong")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
