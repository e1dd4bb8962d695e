"""The graph of results, what its steps hand on, what a run gives back, and the raw files at its beginning."""

from functools import partial
from pathlib import Path

import numpy as np
import pytest

from colonnade.campaign import load
from colonnade.findings import note, serious, warning
from colonnade.store import files
from colonnade.workflow import graph as module
from colonnade.workflow.chain import RunResult, StageRun
from colonnade.workflow.graph import Graph, RawFile, copies
from colonnade.workflow.product import Catalogue
from every import every
from raw_files import Column, diadem


def test_the_code_is_hashed_again_only_if_a_source_changed(small, monkeypatch):
    campaign, catalogue = load(small.folder), Catalogue(small.layout)

    def codes(catalogue):
        return [step.code for step in Graph(campaign, small.layout, catalogue).of_test(campaign.tests["pulse-01"])]

    before = codes(catalogue)
    catalogue.save()
    monkeypatch.setattr("colonnade.workflow.product.code_hash", lambda *given, **more: "parsed again")
    assert codes(Catalogue(small.layout)) == before
    monkeypatch.setattr("colonnade.workflow.product.package_hash", lambda: "other sources")
    assert set(codes(Catalogue(small.layout))) == {"parsed again"}


def result(*stages, **given):
    return RunResult(stages, Path("summary.json"), None, **given)


def test_what_became_of_stages_is_told_by_subject_the_worst_first():
    mild, bad = note("gap", "a gap."), serious("gain", "a wrong gain.")
    told = result(
        StageRun("a", "ingest", "done", findings=(mild,)),
        StageRun("a", "rocking", "up-to-date", findings=(bad,)),
        StageRun("prism", "contact", "failed", findings=(mild,)),
        StageRun("b", "ingest", "done"),
        of_campaign=(warning("column", "an unused column."),),
    )
    assert list(told.findings) == ["campaign file", "a", "specimen prism"]
    assert [each.text for each, _ in told.findings["a"]] == ["a wrong gain.", "a gap."]
    assert told.failed
    assert told.has_warnings
    assert not result(StageRun("a", "ingest", "done", findings=(mild,)), of_campaign=(mild,)).has_warnings
    assert not result(StageRun("a", "ingest", "done"), StageRun("a", "rocking", "up-to-date")).failed


def recordings(small, digests):
    """Findings about copied files, if the files of the first tests have these digests."""
    campaign = load(small.folder)
    tests = zip(campaign.tests, digests, strict=False)
    raw = {test: {path: RawFile(each, (1, 1, 1)) for path, each in files.items()} for test, files in tests}
    return [found.text.partition(". ")[0] for found in copies(campaign, raw)]


@every(
    ("digests", "named"),
    [
        ([{"raw/a.csv": "1"}, {"raw/b.csv": "2"}], None),
        ([{"raw/a.csv": "1", "raw/b.csv": "1"}], None),
        ([{"raw/a.csv": None}, {"raw/b.csv": None}], None),
        ([{"raw/a.csv": "1"}, {"raw/a.csv": "1"}], "raw/a.csv"),
        ([{"raw/a.csv": "1", "raw/a.tdx": "2"}, {"raw/b.csv": "1", "raw/b.tdx": "2"}], "raw/a.tdx, raw/b.tdx"),
    ],
)
def test_two_tests_of_one_file_or_of_its_copy_are_one_recording(small, digests, named):
    assert recordings(small, digests) == ([f"free-01, free-02 are one recording: {named}"] if named else [])


def test_windows_keep_two_tests_of_one_file_apart(small):
    for name, window in (("free-01", '["0 s", "11 s"]'), ("free-02", '["9 s", "20 s"]')):
        small.edit(f'file = "raw/{name}.csv"', f'file = "raw/{name}.csv"\nwindow = {window}')
    assert recordings(small, [{"raw/a.csv": "1"}] * 2) == []


@pytest.fixture
def in_two_parts(untouched):
    """The small campaign with one test whose raw file is in two parts, once run up to ingest."""
    raw = untouched.raw("pulse-01")
    time, top, table = np.loadtxt(raw, delimiter=",", skiprows=1, unpack=True)
    diadem(raw, time, [Column("top", "mm", top), Column("table", "m/s^2", table)])
    assert not untouched.run(only="pulse-01", until="ingest").failed
    return untouched


def values_of(campaign):
    return campaign.raw("pulse-01").with_suffix(".tdx")


def alter(path):
    content = bytearray(path.read_bytes())
    content[-2] ^= 0x20
    path.write_bytes(content)


def test_both_parts_are_in_the_provenance_and_altered_values_are_ingested_again(in_two_parts):
    attributes = files.read_attributes(in_two_parts.layout.stage("pulse-01", "ingest"))
    assert list(attributes["raw_files"]) == ["raw/pulse-01.csv", "raw/pulse-01.tdx"]
    assert all(len(digest) == 64 for digest in attributes["raw_sha256"])
    redone = partial(in_two_parts.redone, only="pulse-01", until="ingest")
    assert redone() == {}
    alter(values_of(in_two_parts))
    assert redone() == {("pulse-01", "ingest"): "raw file changed"}
    assert redone() == {}


def test_values_that_change_or_go_while_they_are_read_are_told(in_two_parts, monkeypatch):
    expect = module.expect_unchanged
    for change in (alter, Path.unlink):
        with monkeypatch.context() as still:

            def still_copying(*arguments, change=change):
                change(values_of(in_two_parts))
                expect(*arguments)

            still.setattr(module, "expect_unchanged", still_copying)
            result = in_two_parts.run(only="pulse-01", until="ingest", start_from="ingest")
        assert "raw/pulse-01.tdx: this file changed while it was being read" in result.stages[0].reason
        assert not in_two_parts.layout.stage("pulse-01", "ingest").exists()


def test_values_that_are_a_link_out_of_the_campaign_are_refused_and_not_hashed(in_two_parts, tmp_path):
    values = values_of(in_two_parts)
    outside = values.rename(tmp_path / "outside")
    values.symlink_to(outside)
    (failed,) = in_two_parts.run(only="pulse-01", until="ingest").stages
    assert "its values are in pulse-01.tdx, which is a link to" in failed.reason
    attributes = files.read_attributes(in_two_parts.layout.stage("pulse-01", "ingest"))
    assert not attributes["raw_sha256"][1]
    values.unlink()
    outside.rename(values)
    assert not in_two_parts.run(only="pulse-01", until="ingest").failed
