"""Arguments of a run as a notebook gives them; hostile ones of every call are in tests/test_arguments.py."""

from __future__ import annotations

from pathlib import Path

import pytest

from colonnade.workflow.arguments import check_run
from every import every

SOUND = {
    "campaign": "campaign.toml",
    "stages": {"until": "compare", "start_from": None},
    "only": (),
    "workers": None,
    "scheduler": None,
    "verify": False,
    "awaiting": False,
    "results": None,
    "progress": None,
}


@pytest.mark.parametrize(
    "given",
    [
        {},
        {"campaign": Path("a"), "results": Path("b"), "workers": 2, "only": "free-01", "verify": True},
        {"only": {"free-01"}, "scheduler": "tcp://localhost:8786", "progress": print},
    ],
)
def test_what_a_run_takes_passes(given):
    check_run(**SOUND | given)


@every(
    ("given", "message"),
    [
        ({"campaign": None}, "campaign is None; a path was expected"),
        ({"results": 3}, "results is 3; a path was expected"),
        ({"stages": {"until": 3}}, "until is 3; the name of a stage was expected"),
        ({"scheduler": 8786}, "scheduler is 8786; an address was expected"),
        ({"only": [1]}, "only is an array of shape .*; the id of a test, or a list of ids"),
        ({"workers": 0}, "workers is 0; a whole number from 1 to 10000"),
        ({"verify": 1}, "verify is 1; True or False"),
        ({"awaiting": "yes"}, "awaiting is the text 'yes'; True or False"),
        ({"progress": "bar"}, "progress is the text 'bar'; a function"),
    ],
)
def test_what_it_does_not_take_is_named(given, message):
    with pytest.raises(ValueError, match=message):
        check_run(**SOUND | given)
