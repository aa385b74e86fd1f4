"""Every page of the reference, by file name."""

from __future__ import annotations

from station.reference.commands import commands_page
from station.reference.files import measurement_file_page, robot_file_page, station_file_page
from station.reference.names import names_page
from station.reference.rest import rest_page
from station.reference.roles import roles_page


def pages() -> dict[str, str]:
    """The text of each page; the same code gives the same text."""
    return {
        "commands.md": commands_page(),
        "measurement-file.md": measurement_file_page(),
        "names.md": names_page(),
        "rest.md": rest_page(),
        "robot-file.md": robot_file_page(),
        "roles.md": roles_page(),
        "station-file.md": station_file_page(),
    }
