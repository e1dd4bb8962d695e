"""Assessments in the graph: made once, made again for what changed, failing without stopping the rest."""

from html import unescape

import pytest

from colonnade.campaign import load
from colonnade.store import files
from colonnade.store.layout import Layout
from colonnade.workflow.assessing import _given
from colonnade.workflow.catalogue import Catalogue
from colonnade.workflow.run import run
from short_campaign import Small


def action(folder):
    """What became of the assessment, and why."""
    [stage] = [stage for stage in run(folder, workers=1).stages if stage.stage == "assessment"]
    return stage.action, stage.because or stage.reason


def test_the_summary_has_the_answer_and_the_result_its_files(assessed):
    layout = Layout(assessed)
    [(name, found)] = Small(assessed).summary()["assessments"].items()
    assert (name, found["status"], found["specimen"]) == ("site", "done", "prism")
    assert found["uplift_acceleration"] == pytest.approx(9.81 * 86 / 456, rel=1e-9)
    assert found["restitution_source"] == "identified"
    assert [each["record"] for each in found["records_left_out"]] == ["broken.csv"]
    stored = files.read(layout.stage("site", "assessment"))
    assert stored.sizes["record"] == 8
    assert len(set(stored.attrs["record_sha256"])) == 8


def test_only_what_changed_makes_it_again(assessed_copy):
    assert action(assessed_copy) == ("up-to-date", "")
    (assessed_copy / "records" / "broken.csv").unlink()
    assert action(assessed_copy) == ("done", "upstream changed")
    Small(assessed_copy).edit("[0.85, 0.95]", "[0.86, 0.95]")
    assert action(assessed_copy) == ("done", "settings changed")
    assert not list(Layout(assessed_copy).processed.glob("assessments/.*"))


def test_an_answer_that_is_out_of_date_is_not_in_the_summary(assessed_copy):
    campaign = Small(assessed_copy)
    before = campaign.summary()["assessments"]
    campaign.run()
    assert campaign.summary()["assessments"] == before
    campaign.edit("[0.85, 0.95]", "[0.86, 0.95]")
    campaign.run()
    assert campaign.summary()["assessments"] == {}
    campaign.run(until="report")
    assert campaign.summary()["assessments"]["site"]["restitution"]["low"] == 0.86


def test_a_failure_is_told_and_stops_nothing(assessed_copy):
    (assessed_copy / "hazard.csv").write_text("pga [g], rate [1/year]\n0.1,0.01\n0.5,0.001\n", encoding="utf-8")
    result = run(assessed_copy, workers=1)
    assert result.failed
    [failed] = [stage for stage in result.stages if stage.action == "failed"]
    assert (failed.heading, failed.stage) == ("assessment site", "assessment")
    assert 'the hazard is given for "pga"' in failed.reason
    summary = Small(assessed_copy).summary()
    assert summary["assessments"]["site"]["status"] == "failed"
    assert summary["tests"]["free-01"]["status"] == "done"
    names = "assessments.html", "index.html", "problems.html"
    page, *others = (unescape((assessed_copy / "report" / name).read_text(encoding="utf-8")) for name in names)
    assert "There is no answer" in page
    for text, heading in zip(others, ("Assessment site failed", "assessments.html#assessment-site"), strict=True):
        assert 'the hazard is given for "pga"' in text[text.index(heading) :][:600], heading


def test_files_of_one_name_in_two_folders_are_two_files(assessed_copy):
    records = assessed_copy / "records"
    for number, name in enumerate(("a", "b")):
        (records / name).mkdir()
        (records / name / "x.csv").write_bytes((records / f"r{number}.csv").read_bytes())
    listed = records / "list.csv"
    listed.write_text("file,record\na/x.csv,a\nb/x.csv,b\n", encoding="utf-8")
    asked = load(assessed_copy).assessments["site"].model_copy(update={"records": listed})
    catalogue = Catalogue(Layout(assessed_copy))
    before = _given(asked, catalogue)
    (records / "a" / "x.csv").write_bytes((records / "r2.csv").read_bytes() + b"\n")
    assert _given(asked, catalogue)["records"] != before["records"]


def test_while_tests_arrive_the_answers_wait(assessed_copy):
    Layout(assessed_copy).stage("site", "assessment").unlink()
    result = run(assessed_copy, workers=1, awaiting=True)
    assert not [stage for stage in result.stages if stage.stage == "assessment"]
    page = (assessed_copy / "report" / "assessments.html").read_text(encoding="utf-8")
    assert "None has been made yet" in page
