"""`colonnade run` and the commands on its way: what they do, what they say, what they leave alone."""

from __future__ import annotations

import json

from colonnade.cli import work
from colonnade.workflow import steps


def test_the_stages_that_can_be_named_are_the_workflows():
    assert work.STAGES == steps.STAGES


def times(folder):
    return {path: path.stat().st_mtime_ns for path in folder.rglob("*") if path.is_file()}


def test_run_lists_what_was_redone_and_why_and_says_where_the_report_is(colonnade, campaign):
    told = colonnade("run", "--workers", "1")
    assert (told.returncode, told.stderr) == (0, "")
    assert "never run" in told.stdout
    assert told.stdout.endswith(f"report: {campaign / 'report' / 'index.html'}\n")

    before = times(campaign)
    again = colonnade("run", "--workers", "1")
    assert again.returncode == 0
    assert again.stdout.startswith("0 redone")
    assert times(campaign) == before

    raw = campaign / "raw" / "free-02.csv"
    raw.write_text(raw.read_text(encoding="utf-8").replace("0.0000;", "0.0001;", 1), encoding="utf-8")
    third = json.loads(colonnade("run", "--workers", "1", "--json").stdout)
    redone = [stage for stage in third["stages"] if stage["action"] == "done"]
    assert {stage["subject"] for stage in redone} == {"free-02", "prism", "free-01"}
    assert {stage["stage"] for stage in redone if stage["subject"] == "free-01"} <= {"predict", "ensemble", "compare"}


def test_one_bad_file_fails_its_test_alone(colonnade, campaign):
    (campaign / "raw" / "free-02.csv").write_text("nothing that could be read\n", encoding="utf-8")
    told = colonnade("run", "--workers", "1")
    assert told.returncode == 1
    assert "Traceback" not in told.stdout + told.stderr
    shown = json.loads(colonnade("show", "tests", "--json").stdout)
    assert (shown["free-01"]["status"], shown["free-02"]["status"]) == ("done", "failed")
    assert "free-02.csv" in shown["free-02"]["reason"]
    assert colonnade("run", "--workers", "1").returncode == 1


def test_ingest_stops_after_the_first_stage(colonnade, campaign):
    assert colonnade("ingest", "--workers", "1", "--only", "free-01").returncode == 0
    folder = campaign / "processed" / "tests"
    assert [path.relative_to(folder).as_posix() for path in folder.rglob("*.nc")] == ["free-01/recorded.nc"]


def test_identify_stops_with_the_restitution(colonnade, campaign):
    assert colonnade("identify", "--workers", "1").returncode == 0
    prism = json.loads(colonnade("show", "specimens", "prism", "--json").stdout)["restitution"]
    assert prism["source"] == "identified"
    assert abs(prism["value"] - 0.95) < 0.002
    assert not list(campaign.rglob("predicted-*.nc"))


def test_from_redoes_a_stage_and_what_follows(colonnade, campaign):
    colonnade("run", "--workers", "1")
    again = json.loads(colonnade("run", "--workers", "1", "--from", "predict", "--json").stdout)
    assert {stage["stage"] for stage in again["stages"] if stage["action"] == "done"} == {
        "predict",
        "ensemble",
        "compare",
    }


def test_an_unknown_id_is_refused_with_the_nearest_one(colonnade, campaign):
    told = colonnade("run", "--workers", "1", "--only", "fre-01")
    assert told.returncode == 2
    assert 'Did you mean "free-01"?' in told.stderr
