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


@pytest.mark.parametrize(
    "text",
    [
        "",
        "no JSON",
        "[" * 100_000,
        "null",
        '{"results": {}, "kept": {}, "sha256": 3}',
        "[]",
        "{}",
        '{"results": 3, "kept": {}}',
        '{"results": {"processed/tests/pulse-01/rocking.nc": 1}, "kept": {}}',
    ],
)
def test_a_catalogue_that_is_no_good_only_costs_time(small, text):
    before = small.summary()
    small.layout.catalogue.write_text(text, encoding="utf-8")
    assert small.redone() == {}
    assert small.summary() == before


@pytest.mark.parametrize(
    ("before", "after"),
    [
        pytest.param('\\"kind\\":\\"pulse\\"', '\\"kind\\":\\"pulsar\\"', id="a record that is none"),
        pytest.param('\\"status\\":\\"done\\"', '\\"status\\":\\"failed\\"', id="another status in a record"),
        pytest.param('"status":"done"', '"status":"failed"', id="another status of a file"),
        pytest.param('"content":"', '"content":"0', id="another hash of a file"),
    ],
)
def test_a_catalogue_that_was_altered_only_costs_time(small, before, after):
    summary, text = small.summary(), small.layout.catalogue.read_text(encoding="utf-8")
    assert before in text
    small.layout.catalogue.write_text(text.replace(before, after), encoding="utf-8")
    assert small.redone() == {}
    assert small.summary() == summary


def test_records_follow_their_results(small):
    small.change_a_sample("pulse-01")
    small.run()
    remembered = json.loads(small.layout.catalogue.read_text(encoding="utf-8"))["kept"]
    assert json.loads(remembered["record pulse-01"][1]) == small.summary()["tests"]["pulse-01"]


def test_what_is_gone_from_the_campaign_is_forgotten(small):
    text = (small.folder / "campaign.toml").read_text(encoding="utf-8")
    (small.folder / "campaign.toml").write_text(text[: text.rindex("[[tests]]")], encoding="utf-8")
    small.run(until="report")
    known = json.loads(small.layout.catalogue.read_text(encoding="utf-8"))
    tests = small.summary()["tests"]
    expected = {f"{kind} {name}" for kind in ("record", "page") for name in tests}
    assert set(known["kept"]) == expected | {"specimen-record prism"}
