"""The commands, from click."""

from __future__ import annotations

import click

from station.cli import main
from station.reference.markdown import code, page, section, table

INTRODUCTION = """
`station COMMAND`, also `python -m station COMMAND`. Exit status: 0 done; 1 the run or the verdict failed; 2 the input was refused,
with one line on standard error.
"""


def commands_page() -> str:
    """Every command with its arguments and options."""
    context = click.Context(main, info_name="station")
    names = main.list_commands(context)
    found = [(name, command) for name in names if (command := main.get_command(context, name)) is not None]
    overview = table(
        ("command", "does"),
        (
            (f"[`station {name}`](#station-{name})", (command.help or "").strip().split("\n\n")[0])
            for name, command in found
        ),
    )
    own = section("Options of every command", _options(main, context))
    return page("Commands", INTRODUCTION.strip(), overview, own, *(_command(n, c, context) for n, c in found))


def _command(name: str, command: click.Command, parent: click.Context) -> str:
    context = click.Context(command, info_name=name, parent=parent)
    usage = " ".join(command.collect_usage_pieces(context))
    return section(
        f"station {name}",
        (command.help or "").strip(),
        "",
        code(f"station {name} {usage}"),
        _options(command, context),
    )


def _options(command: click.Command, context: click.Context) -> str:
    records = (p.get_help_record(context) for p in command.get_params(context) if isinstance(p, click.Option))
    return table(("option", "meaning"), ((code(names), meaning) for names, meaning in filter(None, records)))
