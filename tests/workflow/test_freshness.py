"""Only what is out of date is executed, and the reason is told."""

from __future__ import annotations

import os

import pytest

from colonnade.workflow import freshness

OF_A_PULSE = ("ingest", "condition", "rocking", "predict", "ensemble", "compare")


def stages_of(redone, subject):
    return {stage for name, stage in redone if name == subject}


def test_a_first_run_executes_everything_and_says_why(untouched):
    redone = untouched.redone()
    assert set(redone.values()) == {"never run"}
    assert stages_of(redone, "free-01") == {
        "ingest",
        "condition",
        "rocking",
        "restitution",
        "predict",
        "ensemble",
        "compare",
    }
    assert stages_of(redone, "pulse-01") == set(OF_A_PULSE)
    assert stages_of(redone, "prism") == {"specimen"}


def test_a_second_run_executes_no_stage_and_changes_no_file(small):
    small.run(until="report")
    before = small.files()
    result = small.run(until="report")
    assert {stage.action for stage in result.stages} == {"up-to-date"}
    assert small.files() == before


def test_a_campaign_that_is_moved_stays_up_to_date(small):
    assert small.redone() == {}


def test_touching_a_raw_file_redoes_nothing(small):
    os.utime(small.raw("free-01"), (1, 1))
    before = small.contents()
    assert small.redone() == {}
    assert small.contents() == before


def test_one_changed_sample_redoes_that_test_alone_where_nothing_depends_on_it(small):
    small.change_a_sample("pulse-01")
    redone = small.redone()
    assert set(redone) == {("pulse-01", stage) for stage in OF_A_PULSE}
    assert redone["pulse-01", "ingest"] == "raw file changed"
    assert redone["pulse-01", "condition"] == "upstream changed"


def test_one_changed_sample_of_a_free_vibration_redoes_its_specimens_predictions(small):
    small.change_a_sample("free-01")
    redone = small.redone()
    assert stages_of(redone, "free-01") == {
        "ingest",
        "condition",
        "rocking",
        "restitution",
        "predict",
        "ensemble",
        "compare",
    }
    assert stages_of(redone, "prism") == {"specimen"}
    assert stages_of(redone, "pulse-01") == stages_of(redone, "free-02") == {"predict", "ensemble", "compare"}
    assert redone["pulse-01", "predict"] == "upstream changed"


def test_a_changed_sample_that_is_put_back_gives_the_first_values_again(small):
    before, raw = small.contents(), small.raw("free-01").read_bytes()
    small.change_a_sample("free-01")
    small.run()
    assert small.contents() != before
    small.raw("free-01").write_bytes(raw)
    small.run()
    assert small.contents() == before


def test_a_setting_redoes_the_stage_that_reads_it_and_what_follows(small):
    small.edit(
        "[setups.frame.channels]", "[processing.restitution]\nlowest_amplitude = 0.05\n\n[setups.frame.channels]"
    )
    redone = small.redone()
    assert {stage for _, stage in redone} == {"restitution", "specimen", "predict", "ensemble", "compare"}
    assert redone["free-01", "restitution"] == "settings changed"


def test_what_no_stage_reads_redoes_nothing(small):
    small.edit("A small campaign", "A small campaign, retitled")
    assert small.redone() == {}


def test_changed_sources_redo_everything_and_give_the_same_values(small, monkeypatch):
    before = small.contents()
    monkeypatch.setattr(freshness, "source_hash", lambda: "other sources")
    stages = small.run().stages
    assert {stage.because for stage in stages} == {"code changed"}
    assert len(stages) == len(before)
    assert small.contents() == before


@pytest.mark.parametrize(
    ("stage", "expected"),
    [
        ("predict", {"predict", "ensemble", "compare"}),
        ("restitution", {"restitution", "specimen", "predict", "ensemble", "compare"}),
    ],
)
def test_start_from_redoes_a_stage_and_what_follows(small, stage, expected):
    redone = small.redone(start_from=stage)
    assert {name for _, name in redone} == expected
    assert set(redone.values()) == {"asked for"}


def test_a_file_of_unchanged_size_and_time_is_hashed_again_only_on_request(small):
    path = small.raw("pulse-01")
    times = (path.stat().st_atime_ns, path.stat().st_mtime_ns)
    text = path.read_text()
    path.write_text(text[:-2] + ("1" if text[-2] != "1" else "2") + "\n")
    os.utime(path, ns=times)
    assert small.redone() == {}
    assert small.redone(verify=True)["pulse-01", "ingest"] == "raw file changed"


def test_a_damaged_result_is_made_anew(small):
    before = small.contents()
    path = small.layout.stage("pulse-01", "rocking")
    path.write_bytes(path.read_bytes()[:3000])
    assert set(small.redone()) == {("pulse-01", "rocking")}
    assert small.contents() == before


@pytest.mark.parametrize(
    "text",
    [
        '{"raw/pulse',
        "[]",
    ],
)
def test_a_damaged_index_of_raw_files_costs_a_hash_and_nothing_else(small, text):
    small.layout.raw_index.write_text(text)
    assert small.redone() == {}
