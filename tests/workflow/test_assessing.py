"""Questions of one's own: options over the keys of a campaign, columns without one, refusals."""

from html import unescape

import pytest

from colonnade.campaign import load
from colonnade.campaign.assessment import Prototype
from colonnade.errors import CampaignError
from colonnade.store import files
from colonnade.store.layout import Layout
from colonnade.workflow.assessing import _given, assess
from colonnade.workflow.executors import Where
from colonnade.workflow.product import Catalogue
from colonnade.workflow.run import run
from every import every
from short_campaign import Small

pytestmark = pytest.mark.whole

HERE = Where(workers=1)


def own(folder, base="site", **options):
    campaign = load(folder) if base else load(folder).but(assessments={})
    [found] = assess(campaign, Layout(folder), (base,) if base else (), options, HERE)
    return found


def test_options_replace_keys_and_store_nothing(assessed):
    before = sorted(path.stat().st_mtime_ns for path in assessed.rglob("*") if path.is_file())
    found = own(assessed, restitution=0.9, draws=1, levels=["1 m/s", "2 m/s", "4 m/s"])
    assert found.record.restitution_source == "given"
    assert found.record.restitution.value == 0.9
    assert found.record.restitution.low == pytest.approx(0.88)
    assert found.result is not None
    assert found.result.sizes["level"] == 3
    assert sorted(path.stat().st_mtime_ns for path in assessed.rglob("*") if path.is_file()) == before


def test_a_column_without_a_campaign_is_the_same_column(assessed):
    campaign = load(assessed)
    block = campaign.block("prism")
    options = {
        "records": assessed / "records",
        "restitution": 0.9,
        "restitution_range": [0.85, 0.95],
        "draws": 2,
        "resamples": 200,
        "measures": ["pga", "pgv"],
        "levels": ["0.5 m/s", "1 m/s", "1.5 m/s", "2.5 m/s", "4 m/s"],
    }
    options |= {"critical_angle": f"{block.critical_angle} rad", "p": f"{block.p / 20**0.5} rad/s"}
    [alone] = assess(None, None, (), options, HERE)
    same = own(assessed, restitution=0.9, restitution_range=[0.85, 0.95])
    assert alone.record.median.value == pytest.approx(same.record.median.value, rel=1e-6)


def test_another_measure_leaves_the_hazard_of_the_old_one(assessed):
    found = own(assessed, measure="pga", levels=["0.5 g", "1 g", "2 g"], draws=1)
    assert found.record.status == "done"
    assert found.record.annual_rate.value is None


@every(
    ("options", "words"),
    [
        ({"base": "sight"}, 'no assessment "sight"'),
        ({"base": "sight", "draws": 1}, 'no assessment "sight"'),
        ({"base": None, "restitution": 0.9}, "--records"),
        ({"base": None, "specimen": "prism", "restitution": 0.9}, "--records"),
        ({"draws": 0}, "--draws: "),
    ],
)
def test_what_cannot_be_asked_is_refused(assessed, options, words):
    with pytest.raises(CampaignError) as refused:
        own(assessed, **options)
    assert words in str(refused.value)


def test_limits_of_another_value_do_not_hold_for_the_one_that_is_asked(assessed):
    ranges = {"critical_angle_range": ["0.17 rad", "0.19 rad"], "friction": 0.6, "friction_range": [0.5, 0.7]}
    written = Prototype.model_validate({"restitution": 0.9, **ranges})
    campaign = load(assessed).but(prototype={"prism": written})
    given = {"critical_angle": "0.25 rad", "levels": ["1 m/s", "2 m/s"], "draws": 2}
    [found] = assess(campaign, Layout(assessed), (), given, HERE)
    assert set(found.result["drawn_critical_angle"].to_numpy().ravel()) == {0.25}
    assert found.record.friction_range == (0.5, 0.7)


def test_a_hazard_replaces_that_of_the_campaign(assessed, tmp_path):
    hazard = tmp_path / "other.csv"
    hazard.write_text("pgv [m/s], rate [1/year]\n0.05,0.04\n0.3,0.004\n3,6e-6\n", encoding="utf-8")
    same, twice = own(assessed), own(assessed, hazard=hazard)
    assert twice.record.annual_rate.value == pytest.approx(2 * same.record.annual_rate.value)


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
    assert len({digest for each in found["records_used"] for digest in each["files"].values()}) == 8


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
    for text in others:
        assert (
            'the hazard is given for "pga"'
            in text[text.index('Assessment <a href="assessments.html#assessment-site">site</a> failed') :][:600]
        )


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
