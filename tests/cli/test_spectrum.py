"""`colonnade spectrum`: with a campaign and without, and what it says where it cannot."""

import csv
import json
import math
import re

import numpy as np
import pytest

from colonnade.cli import invoke
from every import every
from foreseeing import TEST

PRISM = ("--shape", "prism", "--width", "1 m", "--height", "5 m")
COLUMN = ("--critical-angle", "0.2 rad", "--p", "2 rad/s")

PULSE = ("--pulse", "sine", *COLUMN)
SHAKEN = ("--motion", "record.csv", *COLUMN)


@pytest.fixture
def record(tmp_path):
    time = np.arange(0, 4, 0.01)
    values = 0.4 * np.sin(2 * np.pi * time) * np.exp(-(((time - 2) / 0.8) ** 2))
    values *= 0.4 / np.abs(values).max()
    path = tmp_path / "record.csv"
    rows = "\n".join(f"{each:.2f},{value:.6f}" for each, value in zip(time, values, strict=True))
    path.write_text(f"time (s),acceleration\n{rows}\n")
    return path


@pytest.fixture
def told(capsys):
    """Run a command that ends well; return what it says."""

    def run(*arguments):
        assert invoke(arguments) == 0
        return capsys.readouterr().out

    return run


@pytest.fixture(autouse=True)
def _elsewhere(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def test_the_overturning_spectrum_of_a_pulse_needs_no_campaign(tmp_path, told):
    out, data = tmp_path / "spectrum.svg", tmp_path / "spectrum.csv"
    asked = ["spectrum", "--pulse", "half-sine", *COLUMN, "--points", "3", "--omega", "1", "3", "--model", "linear"]
    said = told(*asked, "--largest", "3", "--out", str(out), "--data", str(data))
    # a/(gα) = 1.800724 at Ω = 2.
    level = 1.800724 * 0.2 / math.tan(0.2)
    row = next(line for line in said.splitlines() if line.startswith("2 "))
    assert f"{level:.5g}" in row
    assert "m/s²" in row
    assert "half-sine: sin φ for 0 < φ < π, φ = ω t (Housner 1963)" in said
    assert "restitution e     0.9408 (rigid-body)" in said
    assert out.read_text(encoding="utf-8").startswith("<?xml")
    with data.open(encoding="utf-8", newline="") as stream:
        rows = list(csv.DictReader(stream))
    assert float(rows[1]["A = a / (g tan α), lower limit"]) == pytest.approx(level, abs=1e-6)
    assert float(rows[1]["A = a / (g tan α), edges of the intervals that overturn"]) > 1.0


def test_the_rocking_spectrum_of_a_file_comes_with_its_measures(record, told):
    asked = ["spectrum", "--motion", str(record), *COLUMN, "--unit", "g", "--points", "4", "--restitution", "0.95"]
    said = told(*asked)
    assert "PGA/(g tan α)" in said
    assert "0.95 (given)" in said
    found = json.loads(told(*asked, "--slenderness", "0.3 rad", "--json"))
    peak = found["measures"]["values"]["pga"]
    assert peak == pytest.approx(0.4 * 9.80665, rel=1e-5)
    assert found["measures"]["values"]["pga_ratio"] == pytest.approx(peak / (9.81 * math.tan(0.2)))
    assert found["spectrum"]["critical_angle"] == [0.2, 0.3]
    assert [len(row) for row in found["spectrum"]["peak_ratio"]] == [4, 4]
    assert found["column"]["restitution"] == [0.95, 0.95]


def test_a_specimen_of_a_campaign_is_taken_at_its_scale(campaign, record, capsys, told):
    with (campaign / "campaign.toml").open("a", encoding="utf-8") as stream:
        stream.write('\n[motions]\nswinging = "record.csv"\n')
    asked = ["spectrum", str(campaign), "--motion", "swinging", "--points", "2", "--json"]
    assert invoke(asked) == 2
    assert '--peak "0.3 g"' in capsys.readouterr().err
    real = ["--scale", "4", "--restitution", "identified", "--baseline", "linear"]
    model, real = (json.loads(told(*asked, "--peak", "0.1 g", *options)) for options in ([], real))
    assert model["column"]["restitution_source"] == "rigid-body"
    assert real["column"]["p"] == pytest.approx(model["column"]["p"] / 2)
    assert real["column"]["critical_angle"] == model["column"]["critical_angle"]
    assert model["measures"]["values"]["pga"] == pytest.approx(0.1 * 9.80665)
    assert "brought to a peak of 0.1 g, baseline corrected: linear" in real["motion"]["source"]


@every(
    ("arguments", "message"),
    [
        ([], "Give either --motion or --pulse"),
        ([*PULSE, "--peak", "1 g"], "--peak is only for --motion"),
        ([*SHAKEN, "--omega", "1", "2"], "--omega is only for --pulse"),
        ([*PULSE, "--cycles", "3"], "--cycles is only for --pulse mavroeidis-papageorgiou"),
        (["--pulse", "sine"], "The column is not known"),
        ([*PULSE, "--restitution", "2"], "--restitution: 2.0 was found. A number above 0"),
        ([*PULSE, "--omega", "3", "1"], "--omega: 3 and 1 (SI) were found. The second has to be the larger one."),
        ([*PULSE, "--points", "1"], "--points: 1 was found."),
        ([*SHAKEN, "--least-width", "1"], "--least-width is only for --pulse"),
        ([*PULSE, "--largest", "-1"], "largest is -1.0"),
        ([*PULSE, "--out", "x.txt"], "unknown ending"),
        (["--motion", "nowhere.csv", *COLUMN], "there is no such file and no campaign"),
        ([*SHAKEN, "--unit", "g", "--baseline", "cubic"], "--baseline: Unknown baseline"),
        ([*SHAKEN, "--unit", "g", "--peak", "strong"], "--peak: "),
        ([*SHAKEN, "--unit", "g", "--drift", "-1"], "drift is -1.0"),
        ([*SHAKEN, "--unit", "g", "--slenderness", "1 m"], "--slenderness: "),
    ],
)
def test_a_wrong_use_says_what_was_expected(record, arguments, message, capsys):
    assert invoke(["spectrum", *arguments]) == 2
    said = " ".join(capsys.readouterr().err.replace("│", " ").split())
    assert message in said


def test_a_file_without_a_unit_is_named(record, capsys):
    assert invoke(["spectrum", "--motion", str(record), *COLUMN]) == 1
    assert "does not give the unit" in capsys.readouterr().err


def test_the_verdict_is_the_first_line(record, told):
    asked = ["spectrum", "--motion", str(record), *PRISM, "--unit", "g", "--points", "2"]
    assert re.match(r"The column (overturns|rocks to .* and stands|does not rock) \(nonlinear", told(*asked))
    weak = told(*asked, "--peak", "0.1 g")  # g tan α is 0.2 g
    assert weak.startswith("The column does not rock (nonlinear model).")
    pulse = ["spectrum", "--pulse", "half-sine", *COLUMN, "--points", "2", "--omega", "1", "2", "--model", "linear"]
    said = told(*pulse, "--largest", "1.01")
    assert said.startswith("No half-sine pulse up to A = 1.01 overturns the column (linear model).")


def test_what_a_campaign_recorded_is_in_the_time_of_the_column(foreseen_copy, capsys, told):
    """Similitude: a column 20 times larger does in √20 times the time what its model does on the table."""
    asked = ["spectrum", str(foreseen_copy), "--motion", TEST, "--points", "2", "--json"]
    own = [*asked, "--specimen", "prism", "--restitution", "0.95"]
    model, real = (json.loads(told(*own, *options)) for options in ((), ("--scale", "20")))
    assert model["peak_ratio"] > 0.01
    assert real["peak_ratio"] == pytest.approx(model["peak_ratio"], rel=1e-6)
    assert real["motion"]["interval"] == pytest.approx(model["motion"]["interval"] * 20**0.5)
    assert "4.47 times slower for a column 20 times larger" in real["motion"]["source"]
    column = model["column"]
    given = ["--critical-angle", f"{column['critical_angle']} rad", "--restitution", "0.95"]
    given += ["--p", f"{column['p'] / 20**0.5} rad/s"]
    found = json.loads(told(*asked, *given))  # the campaign says that the prism is 1:20
    assert found["peak_ratio"] == pytest.approx(model["peak_ratio"], rel=1e-4)
    file = foreseen_copy / "campaign.toml"
    file.write_text(re.sub(r"(, )?\bscale = 20(\.0)?\n?", "", file.read_text()))
    assert invoke([*asked, *given]) == 2
    assert "how many times larger the column is, is not known" in capsys.readouterr().err
