"""The commands, from click."""

from __future__ import annotations

from inspect import cleandoc

import click

from station.cli import main
from station.reference.markdown import code, page, section, table

INTRODUCTION = """
`station COMMAND`, also `python -m station COMMAND`. Exit status: 0 success; 1 the run or the verdict failed; 2 the input was
refused, with one line on standard error.
"""


def commands_page() -> str:
    """Every command with its arguments and options."""
    context = click.Context(main, info_name="station")
    names = main.list_commands(context)
    found = [(name, command) for name in names if (command := main.get_command(context, name)) is not None]
    overview = table(
        ("command", "effect"),
        (
            (f"[`station {name}`](#station-{name})", _help(command).split("\n\n")[0])
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
        _help(command),
        "",
        code(f"station {name} {usage}"),
        *([_parts(command, context)] if isinstance(command, click.Group) else []),
        _options(command, context),
    )


def _help(command: click.Command) -> str:
    return cleandoc(command.help or "")


def _parts(group: click.Group, context: click.Context) -> str:
    """The commands of a group; `--help` of each lists its options."""
    rows = []
    for name in group.list_commands(context):
        part = group.commands[name]
        own = click.Context(part, info_name=name, parent=context)
        rows.append((code(f"{own.command_path} {' '.join(part.collect_usage_pieces(own))}"), _help(part)))
    return table(("command", "effect"), rows)


def _options(command: click.Command, context: click.Context) -> str:
    records = (p.get_help_record(context) for p in command.get_params(context) if isinstance(p, click.Option))
    return table(("option", "meaning"), ((code(names), meaning) for names, meaning in filter(None, records)))
