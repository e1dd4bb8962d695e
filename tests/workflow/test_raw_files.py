"""Raw files: hashed once, and asked again whether they are still the same when they have been read."""

from __future__ import annotations

import os

import pytest

from colonnade.campaign import load
from colonnade.workflow import raw_files as module
from colonnade.workflow.catalogue import Catalogue
from colonnade.workflow.raw_files import raw_files


@pytest.fixture
def seen(untouched, monkeypatch):
    """Looks at the raw file of one test with a catalogue, and which files were hashed."""
    campaign, hashed = load(untouched.folder), []
    sha256_of = module.sha256_of
    monkeypatch.setattr(module, "sha256_of", lambda path: hashed.append(path.name) or sha256_of(path))
    untouched.layout.processed.mkdir(exist_ok=True)
    return lambda catalogue: raw_files(campaign, campaign.tests["pulse-01"], catalogue), hashed


def test_a_file_is_hashed_once_until_its_size_time_or_place_changes(untouched, seen):
    look, hashed = seen
    catalogue = Catalogue(untouched.layout)
    assert look(catalogue) == look(catalogue)
    catalogue.save()
    first = look(Catalogue(untouched.layout))
    assert hashed == ["pulse-01.csv"]
    os.utime(untouched.raw("pulse-01"), (1, 1))
    again = look(Catalogue(untouched.layout))
    assert hashed == ["pulse-01.csv"] * 2
    assert again["raw/pulse-01.csv"].sha256 == first["raw/pulse-01.csv"].sha256


def test_a_file_that_is_not_there_has_no_hash(untouched, seen):
    untouched.raw("pulse-01").unlink()
    found = seen[0](Catalogue(untouched.layout))["raw/pulse-01.csv"]
    assert found.sha256 is None
    assert found.is_empty
