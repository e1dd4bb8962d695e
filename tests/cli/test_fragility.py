"""`colonnade fragility`: answers as text and JSON, exit codes, drawings."""

from __future__ import annotations

import json

from colonnade.cli import invoke


def test_the_campaigns_assessments_are_shown(assessed_copy, capsys):
    assert invoke(["fragility", str(assessed_copy)]) == 0
    told = capsys.readouterr()
    assert "It starts to rock at 0.189 g" in told.out
    assert "result: " in told.out
    assert "warning: Left out: broken.csv" in told.err


def test_a_column_without_a_campaign_is_answered_and_drawn(assessed, tmp_path, capsys):
    column = ["--critical-angle", "0.18 rad", "--p", "1.26 rad/s", "--restitution", "0.95"]
    levels = ["--level", "1 m/s", "--level", "2 m/s", "--level", "4 m/s", "--draws", "1", "--resamples", "100"]
    out = tmp_path / "curve.svg"
    asked = ["fragility", *column, *levels, "--records", str(assessed / "records"), "--out", str(out), "--json"]
    assert invoke(asked) == 0
    [found] = json.loads(capsys.readouterr().out)
    assert (found["specimen"], found["status"], found["critical_angle"]) == ("column", "done", 0.18)
    assert out.read_text(encoding="utf-8").startswith("<?xml")
    sized = ["--shape", "prism", "--width", "1 m", "--height", "5 m", "--restitution", "0.95"]
    assert invoke(["fragility", *sized, *levels, "--records", str(assessed / "records")]) == 0
    said = capsys.readouterr().out
    assert said.startswith("column: It overturns with a probability of")
    assert "Assumed: α 0.197 rad, p 1.7 rad/s" in said


def test_what_cannot_be_answered_says_why(assessed, tmp_path, capsys):
    missing = tmp_path / "nowhere"
    assert invoke(["fragility", str(assessed), "--records", str(missing)]) == 1
    assert "nowhere" in capsys.readouterr().out
    assert invoke(["fragility", str(assessed), "--measure", "pvg"]) == 2
    assert 'Did you mean "pgv"?' in capsys.readouterr().err
