"""The catalogue of results: nothing is opened twice, and nothing that changed is taken for what it was."""

import json

import pytest

from colonnade.store import files
from colonnade.workflow import catalogue as module
from colonnade.workflow.catalogue import Catalogue


@pytest.fixture
def opened(monkeypatch):
    """Results whose files were opened, by name."""
    names = []
    for place, name in ((module, "stored_attributes"), (files, "read")):
        ask = getattr(place, name)
        monkeypatch.setattr(place, name, lambda path, ask=ask: names.append(path.name) or ask(path))
    return names


def test_a_run_with_nothing_to_do_opens_no_result_of_a_test(small, opened):
    small.run()
    opened.clear()
    small.run()
    assert opened == []


def test_a_result_that_was_replaced_is_looked_at_again(small, opened):
    path = small.layout.stage("pulse-01", "rocking")
    before = Catalogue(small.layout).attributes(path)
    files.write_failed(path, "replaced by the test", attributes={"stage": "rocking"})
    after = Catalogue(small.layout).attributes(path)
    assert after["content"] != before["content"]
    assert opened == ["rocking.nc"]


def test_verifying_opens_every_result(small, opened):
    small.run(verify=True)
    assert {"recorded.nc", "conditioned.nc", "rocking.nc", "compared.nc"} <= set(opened)


NO_CATALOGUE = (
    "",
    "no JSON",
    "[" * 100_000,
    "null",
    '{"results": {}, "kept": {}, "sha256": 3}',
    "[]",
    "{}",
    '{"results": 3, "kept": {}}',
    '{"results": {"processed/tests/pulse-01/rocking.nc": 1}, "kept": {}}',
)
ALTERED = {
    "a record that is none": ('\\"kind\\":\\"pulse\\"', '\\"kind\\":\\"pulsar\\"'),
    "another status in a record": ('\\"status\\":\\"done\\"', '\\"status\\":\\"failed\\"'),
    "another status of a file": ('"status":"done"', '"status":"failed"'),
    "another hash of a file": ('"content":"', '"content":"0'),
}


@pytest.mark.whole
def test_a_catalogue_that_is_no_good_or_was_altered_only_costs_time(small, opened):
    summary, sound = small.summary(), small.layout.catalogue.read_text(encoding="utf-8")
    (key, *_) = json.loads(sound)["kept"]["record pulse-01"]
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


def test_records_follow_their_results(small):
    small.change_a_sample("pulse-01")
    small.run()
    remembered = json.loads(small.layout.catalogue.read_text(encoding="utf-8"))["kept"]
    assert json.loads(remembered["record pulse-01"][1]) == small.summary()["tests"]["pulse-01"]


@pytest.mark.whole
def test_what_is_gone_from_the_campaign_is_forgotten(small):
    text = (small.folder / "campaign.toml").read_text(encoding="utf-8")
    (small.folder / "campaign.toml").write_text(text[: text.rindex("[[tests]]")], encoding="utf-8")
    small.run(until="report")
    known = json.loads(small.layout.catalogue.read_text(encoding="utf-8"))
    tests = small.summary()["tests"]
    expected = {f"{kind} {name}" for kind in ("record", "page") for name in tests}
    assert set(known["kept"]) == expected | {"specimen-record prism"}
