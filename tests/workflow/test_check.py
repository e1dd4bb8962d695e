"""Check: the problems and findings of each test as a run would have them, with nothing written."""

import shutil

import pytest

from colonnade.campaign import load
from colonnade.findings import note, serious, warning
from colonnade.readers import registry
from colonnade.workflow.check import CampaignCheck, Checked, check
from every import every


def checked(small, **options):
    return check(load(small.folder), **options)


@every(
    ("made", "status"),
    [
        (Checked(), "good"),
        (Checked(findings=[warning("noise", "much"), note("clock", "late")]), "good"),
        (Checked(findings=[serious("gain", "ten times")]), "doubtful"),
        (Checked(concerning=(serious("unit", "cm"),)), "doubtful"),
        (Checked(problems=["no file"], findings=[serious("gain", "ten times")]), "would fail"),
    ],
)
def test_a_test_is_as_good_as_the_worst_that_was_found(made, status):
    assert made.status == status


@every(
    ("made", "fails", "warns"),
    [
        (Checked(), False, False),
        (Checked(findings=[note("clock", "late")]), False, False),
        (Checked(findings=[warning("noise", "much")]), False, True),
        (Checked(problems=["no file"]), True, False),
    ],
)
def test_a_campaign_fails_by_a_problem_and_warns_above_a_note(untouched, made, fails, warns):
    whole = CampaignCheck(load(untouched.folder), {"pulse-01": made, "pulse-02": Checked()})
    assert (whole.fails, whole.has_warnings) == (fails, warns)
    assert list(whole.findings) == ["campaign file", "pulse-01", "pulse-02"]


def test_every_test_is_looked_at_counted_and_nothing_is_written(untouched):
    counted, before = [], untouched.files()
    found = checked(untouched, progress=lambda done, total: counted.append((done, total)))
    assert [each.status for each in found.tests.values()] == ["good"] * 4
    assert counted == [(done, 4) for done in range(5)]
    assert untouched.files() == before


@pytest.mark.whole
def test_several_processes_find_the_same(untouched, monkeypatch):
    alone = checked(untouched)
    monkeypatch.setattr("colonnade.workflow.check.MANY", 1)
    assert checked(untouched) == alone


def test_a_hole_in_the_base_motion_is_a_problem_before_anything_is_predicted(untouched):
    raw = untouched.raw("pulse-01")
    lines = raw.read_text(encoding="utf-8").splitlines()
    lines[300:500] = [line.rpartition(",")[0] + "," for line in lines[300:500]]
    raw.write_text("\n".join([*lines, ""]), encoding="utf-8")
    (problem,) = checked(untouched).tests["pulse-01"].problems
    assert problem.startswith("The base acceleration is missing 200 of 1600 samples, the first at 1.495 s")
    assert untouched.run(only="pulse-01").failed


def test_a_test_that_people_excluded_is_not_read(untouched):
    entry = 'test = "pulse-01"\nwho = "N. N."\nwhen = 2013-04-26\nwhy = "touched by hand"\n'
    (untouched.folder / "review.toml").write_text(f"schema = 1\n[[exclude]]\n{entry}", encoding="utf-8")
    untouched.raw("pulse-01").unlink()
    found = checked(untouched).tests["pulse-01"]
    assert found.problems == []
    (finding,) = found.findings
    assert finding.kind == "excluded"
    assert "touched by hand (review.toml)." in finding.text


def test_a_copy_of_a_raw_file_is_a_warning_of_the_campaign(untouched):
    untouched.raw("pulse-02").write_bytes(untouched.raw("pulse-01").read_bytes())
    found = checked(untouched)
    assert found.has_warnings
    assert not found.fails
    assert any("pulse-02.csv" in each.text for each, _ in found.findings["campaign file"])


def test_a_file_that_tests_share_is_read_once(untouched, monkeypatch):
    untouched.edit('file = "raw/pulse-02.csv"', 'file = "raw/pulse-01.csv"')
    seen, real = [], registry.read

    def spy(path, *rest, **more):
        seen.append(path.stem)
        return real(path, *rest, **more)

    monkeypatch.setattr(registry, "read", spy)
    checked(untouched)
    assert seen.count("pulse-01") == 1


def test_ground_motions_and_hazard_of_assessments_are_read(assessed_copy):
    found = check(load(assessed_copy))
    assert not found.fails
    assert [each.text.split(":")[0] for each in found.assessments["site"].findings] == ["broken.csv is left out"]
    (assessed_copy / "hazard.csv").write_text("pga [g], rate [1/year]\n0.1,0.01\n", encoding="utf-8")
    shutil.rmtree(assessed_copy / "records")
    found = check(load(assessed_copy))
    assert found.fails
    missing, hazard = found.assessments["site"].problems
    assert "records" in missing
    assert '"pga"' in hazard
