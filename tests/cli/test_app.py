"""The group of all commands: in the order in which they are met, each with one line of help."""

from __future__ import annotations

import colonnade as package
from colonnade.cli.app import COMMANDS, app


def test_commands_are_listed_in_the_order_in_which_they_are_met(colonnade):
    told = colonnade("--help").stdout
    places = [told.index(f"│ {command.name} ") for command in COMMANDS]
    assert places == sorted(places)
    assert list(app.commands) == [command.name for command in COMMANDS]


def test_every_command_says_in_a_line_what_it_does():
    for command in COMMANDS:
        assert command.get_short_help_str(200).rstrip(".")


def test_the_version_is_that_of_the_package(colonnade):
    assert package.__version__ in colonnade("--version").stdout
