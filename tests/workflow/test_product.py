"""The catalogue: with it no result is opened without need; without it, or if it was altered, all is as before."""

import json

import pytest

from colonnade.store import files
from colonnade.workflow.product import Catalogue


@pytest.fixture
def opened(monkeypatch):
    """Results whose files were opened, by name."""
    names = []
    for place, name in ((files, "read_attributes"), (files, "read")):
        ask = getattr(place, name)
        monkeypatch.setattr(place, name, lambda path, ask=ask: names.append(path.name) or ask(path))
    return names


def test_a_run_with_nothing_to_do_opens_no_result_of_a_test(small, opened):
    small.run()
    opened.clear()
    small.run()
    assert opened == []


NO_CATALOGUE = (
    "",
    "no JSON",
    "[" * 100_000,
    "null",
    '{"results processed/tests/pulse-01/rocking.nc": 1, "sha256": 3}',
)
ALTERED = {
    "a record that is none": ('\\"kind\\":\\"pulse\\"', '\\"kind\\":\\"pulsar\\"'),
    "another status of a file": ('"status":"done"', '"status":"failed"'),
    "another hash of a file": ('"content":"', '"content":"0'),
}


@pytest.mark.whole
def test_a_catalogue_that_is_no_good_or_was_altered_only_costs_time(small, opened):
    summary, sound = small.summary(), small.layout.catalogue.read_text(encoding="utf-8")
    (key, *_) = json.loads(sound)["kept record pulse-01"]
    assert Catalogue(small.layout).kept("record pulse-01", key)
    assert all(before in sound for before, _ in ALTERED.values())
    for text in (*NO_CATALOGUE, *(sound.replace(*change) for change in ALTERED.values())):
        small.layout.catalogue.write_text(text, encoding="utf-8")
        opened.clear()
        looked_at = Catalogue(small.layout)
        assert looked_at.attributes(small.layout.stage("pulse-01", "rocking"))["status"] == "done", text[:80]
        assert opened == ["rocking.nc"], text[:80]
        assert looked_at.kept("record pulse-01", key) is None, text[:80]
    assert small.redone() == {}
    assert small.summary() == summary
