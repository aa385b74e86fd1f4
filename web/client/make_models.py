"""`python web/client/make_models.py` writes the client's models from `web/openapi.json`.

Only the client's own requests and answers, with datamodel-code-generator. Answers are parsed leniently: a
value that a later station adds to a list of choices, or a new field, must not stop an older client.
"""

from __future__ import annotations

import hashlib
import json
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import cast

from pydantic import JsonValue

HERE = Path(__file__).parent
OPENAPI = HERE.parent / "openapi.json"
MODELS = HERE / "fivebar_client" / "models.py"
SENT = ("CalibrationBody",)
_CHECKED_THERE = {"pattern", "minLength", "maxLength", "maxItems", "minimum", "maximum", "exclusiveMinimum"}
READ = ("Calibration", "CalibrationList", "EventList", "Problem", "ReadingList", "StationView", "Stopped")
_HEADER = '''"""What the station takes and answers.  Made by `make reference`; do not edit.

From schemas with SHA-256 {digest}.
"""'''

Schemas = dict[str, JsonValue]


def schemas() -> Schemas:
    """Schemas by name, with all schemas they refer to."""
    document = json.loads(OPENAPI.read_text(encoding="utf-8"))["components"]["schemas"]
    found: Schemas = {}
    _collect(document, SENT, found, lenient=False)
    _collect(document, READ, found, lenient=True)
    return found


def digest() -> str:
    """Digest of the schemas and of this file, which changes if the models change."""
    text = json.dumps(schemas(), sort_keys=True) + Path(__file__).read_text(encoding="utf-8")
    return hashlib.sha256(text.encode()).hexdigest()


def header() -> str:
    """The first lines of models that match the current schemas."""
    return _HEADER.format(digest=digest())


def _collect(document: Schemas, names: tuple[str, ...], found: Schemas, *, lenient: bool) -> None:
    for name in names:
        if name not in found:
            found[name] = {}  # it may refer to itself
            found[name] = _plain(document[name], lenient=lenient)
            _collect(document, _named(found[name]), found, lenient=lenient)


def _plain(schema: JsonValue, *, lenient: bool) -> JsonValue:
    """The schema without titles, which repeat the name of the field, and limits, which the station checks."""
    if isinstance(schema, list):
        return [_plain(one, lenient=lenient) for one in schema]
    if not isinstance(schema, dict):
        return schema
    if schema.get("$ref") == "#/components/schemas/JsonValue":
        return {}
    if lenient and schema.get("type") == "string" and "enum" in schema:
        known = ", ".join(f"`{value}`" for value in cast(list[str], schema["enum"]))
        said = cast(str, schema.get("description", ""))
        return {"type": "string", "description": f"{said}  Today {known}.".strip()}
    dropped = _CHECKED_THERE | ({"title"} if isinstance(schema.get("title"), str) else set())
    if "properties" in schema:
        dropped = dropped | {"additionalProperties"}
    return {key: _plain(value, lenient=lenient) for key, value in schema.items() if key not in dropped}


def _named(schema: JsonValue) -> tuple[str, ...]:
    if isinstance(schema, list):
        return tuple(name for one in schema for name in _named(one))
    if not isinstance(schema, dict):
        return ()
    own = (ref.rpartition("/")[2],) if isinstance(ref := schema.get("$ref"), str) else ()
    return (*own, *(name for value in schema.values() for name in _named(value)))


def main() -> None:
    """Write the models."""
    info = {"title": "", "version": ""}
    document = {"openapi": "3.1.0", "info": info, "paths": {}, "components": {"schemas": schemas()}}
    with tempfile.TemporaryDirectory() as folder:
        source = Path(folder) / "openapi.json"
        source.write_text(json.dumps(document), encoding="utf-8")
        target = Path(folder) / "models.py"
        command = [
            sys.executable, "-W", "ignore", "-m", "datamodel_code_generator",
            "--input", str(source), "--input-file-type", "openapi", "--output", str(target),
            "--output-model-type", "pydantic_v2.BaseModel", "--target-python-version", "3.11",
            "--use-annotated", "--use-union-operator", "--use-standard-collections",
            "--enum-field-as-literal", "all", "--use-schema-description", "--use-field-description",
            "--use-inline-field-description", "--disable-timestamp", "--collapse-root-models",
            "--use-tuple-for-fixed-items",
            "--custom-file-header", header(), "--formatters", "builtin",
        ]  # fmt: skip
        subprocess.run(command, check=True)
        MODELS.write_text(target.read_text(encoding="utf-8"), encoding="utf-8")
    for step in (("check", "--quiet", "--fix"), ("format", "--quiet")):
        subprocess.run([sys.executable, "-m", "ruff", *step, str(MODELS)], check=True)


if __name__ == "__main__":
    main()
