"""Options that commands share are declared once and mean the same everywhere."""

import click
import pytest

from colonnade.cli.app import app


def params(command):
    return command.get_params(click.Context(command))


def options(command):
    return {option for each in params(app.commands[command]) for option in each.opts}


@pytest.mark.parametrize("command", ["run", "ingest", "identify", "predict", "report"])
def test_commands_that_run_stages_have_the_same_options(command):
    shared = {"--only", "--workers", "--scheduler", "--results", "--verify", "--strict", "--json"}
    assert shared <= options(command)


def test_an_option_has_the_same_help_everywhere():
    said = {}
    for command in app.commands.values():
        for each in params(command):
            if each.opts[0] in ("--json", "--workers", "--scheduler", "--results", "--specimen"):
                # Some commands take one specimen, others several.
                said.setdefault((each.opts[0], each.multiple), set()).add(each.help)
    assert ("--specimen", False) in said
    assert all(len(texts) == 1 for texts in said.values())
