"""The REST interface, from the checked-in OpenAPI file."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any

from station.reference.markdown import code, page, section, table
from web.application import FILE

OF_EVERY_CALL = ("422", "500")


def rest_page() -> str:
    """Every call with its parameters, body and answers; the fields of every body."""
    document = json.loads(FILE.read_text(encoding="utf-8"))
    schemas = document["components"]["schemas"]
    return page(
        "REST",
        "JSON over HTTP; the whole description is `/openapi.json`. Errors are RFC 9457 problem documents: `type`, `title`, `status`, "
        "`detail`, and the field at fault. Every call can answer 422 (a value is refused) and 500. The live feed is a WebSocket at "
        "`/api/v1/live`: first a full snapshot, then numbered events, and a beat every second.",
        section("Calls"),
        *_calls(document["paths"]),
        section("Bodies and answers"),
        *(
            _schema(name, schema)
            for name, schema in sorted(schemas.items())
            if "properties" in schema or "enum" in schema
        ),
    )


def _calls(paths: Any) -> Iterator[str]:
    for path, item in paths.items():
        for method, call in item.items():
            answers = [
                (status, _content(answer.get("content", {})), answer.get("description", ""))
                for status, answer in sorted(call["responses"].items())
                if status not in OF_EVERY_CALL
            ]
            body = _content(call.get("requestBody", {}).get("content", {}))
            yield section(
                f"{method.upper()} {path}",
                "",
                call.get("description", ""),
                f"\nBody: {body}." if body else "",
                table(
                    ("parameter", "in", "value", "meaning"),
                    (
                        (code(p["name"]), p["in"], _type(p["schema"]), p.get("description", ""))
                        for p in call.get("parameters", [])
                    ),
                ),
                table(("status", "answer", "meaning"), answers),
                level=3,
            )


def _content(content: Any) -> str:
    return ", ".join(_type(c["schema"]) if c.get("schema") else code(kind) for kind, c in content.items())


def _schema(name: str, schema: Any) -> str:
    if "enum" in schema:
        return section(name, "", schema.get("description", ""), f"One of {_type(schema)}.", level=3)
    required = schema.get("required", [])
    rows = (
        (code(field), _type(value), "required" if field in required else "", value.get("description", ""))
        for field, value in schema["properties"].items()
    )
    return section(
        name, "", schema.get("description", ""), table(("field", "value", "", "meaning"), rows), level=3
    )


def _type(schema: Any) -> str:
    if "$ref" in schema:
        name = schema["$ref"].rsplit("/", 1)[1]
        if name == "JsonValue":
            return "anything"
        return f"[{name}](#{name.lower()})"
    for several in ("anyOf", "oneOf", "allOf"):
        if several in schema:
            return " or ".join(_type(one) for one in schema[several])
    if "enum" in schema:
        return ", ".join(code(str(value)) for value in schema["enum"])
    if "const" in schema:
        return code(str(schema["const"]))
    if schema.get("type") == "array":
        items = schema.get("items") or {"type": f"{len(schema.get('prefixItems', []))} values"}
        return f"list of {_type(items)}"
    return str(schema.get("type", "anything"))
