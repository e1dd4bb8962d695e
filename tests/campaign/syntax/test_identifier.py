"""Ids that every file system can hold and tell apart."""

from __future__ import annotations

import pytest

from colonnade.campaign.syntax.identifier import clashes, identifier
from every import every


@pytest.mark.parametrize("name", ["free-01", "span-2.0", "A", "0", "a_b", "console", "x" * 100])
def test_an_id_passes(name):
    assert identifier(name) == name


@every("name", ["", "a b", "-a", ".a", "ä", "a/b", "a\n", "con", "CON.csv", "Lpt1", "aux", "x" * 101, 3, None, ["a"]])
def test_what_a_file_system_does_not_hold_fails(name):
    with pytest.raises(ValueError, match=r"cannot be an id|device on Windows|too long|An id in quotes"):
        identifier(name)


def test_ids_that_differ_by_case_or_a_last_dot_clash():
    assert clashes(["a", "b", "A", "b."]) == [(2, "A", "a"), (3, "b.", "b")]


def test_ids_that_become_the_same_variable_clash_only_there():
    assert clashes(["a-1", "a.1"]) == []
    assert clashes(["a-1", "a.1", "a_2"], as_variables=True) == [(1, "a.1", "a-1")]
