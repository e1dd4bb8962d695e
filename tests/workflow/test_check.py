"""Check: the problems and findings of each test as a run would have them, with nothing written."""

import shutil

import pytest

from colonnade.campaign import load
from colonnade.workflow.check import check


def checked(small, **options):
    return check(load(small.folder), **options)


def problems(found, subject):
    return [stage.reason for stage in found.stages if stage.subject == subject and stage.action == "failed"]


def test_every_test_is_looked_at_counted_and_nothing_is_written(untouched):
    counted, before = [], untouched.files()
    found = checked(untouched, progress=lambda done, total: counted.append((done, total)))
    assert [(stage.subject, stage.action, stage.findings) for stage in found.stages] == [
        (name, "done", ()) for name in ("free-01", "free-02", "pulse-01", "pulse-02")
    ]
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
    (problem,) = problems(checked(untouched), "pulse-01")
    assert problem.startswith("The base acceleration is missing 200 of 1600 samples, the first at 1.495 s")
    assert untouched.run(only="pulse-01").failed


def test_a_test_that_people_excluded_is_not_read(untouched):
    entry = 'test = "pulse-01"\nwho = "N. N."\nwhen = 2013-04-26\nwhy = "touched by hand"\n'
    (untouched.folder / "review.toml").write_text(f"schema = 1\n[[exclude]]\n{entry}", encoding="utf-8")
    untouched.raw("pulse-01").unlink()
    found = checked(untouched)
    assert not found.failed
    ((finding, _),) = found.findings["pulse-01"]
    assert finding.kind == "excluded"
    assert "touched by hand. This test is not run." in finding.text


def test_a_copy_of_a_raw_file_is_a_warning_of_the_campaign(untouched):
    untouched.raw("pulse-02").write_bytes(untouched.raw("pulse-01").read_bytes())
    found = checked(untouched)
    assert found.has_warnings
    assert not found.failed
    assert any("pulse-02.csv" in each.text for each, _ in found.findings["campaign file"])


def test_ground_motions_and_hazard_of_assessments_are_read(assessed_copy):
    found = check(load(assessed_copy))
    assert not found.failed
    assert [each.text.split(":")[0] for each, _ in found.findings["assessment site"]] == ["broken.csv is left out"]
    shutil.rmtree(assessed_copy / "records")
    (missing,) = problems(check(load(assessed_copy)), "site")
    assert "records" in missing
    (assessed_copy / "hazard.csv").write_text("pga [g], rate [1/year]\n0.1,0.01\n", encoding="utf-8")
    (hazard,) = problems(check(load(assessed_copy)), "site")
    assert '"pga"' in hazard
