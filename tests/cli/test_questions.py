"""Questions as a person asks them: with a campaign and without, what is written, and each refusal."""

import csv
import json
import math
import re
from pathlib import Path

import numpy as np
import pytest

from every import every
from foreseeing import TEST
from short_campaign import write_columns

PRISM = ("--shape", "prism", "--width", "1 m", "--height", "5 m")
COLUMN = ("--critical-angle", "0.2 rad", "--p", "2 rad/s")

PULSE = ("--pulse", "sine", *COLUMN)
SHAKEN = ("--motion", "record.csv", *COLUMN)


@pytest.fixture
def record(tmp_path):
    time = np.arange(0, 4, 0.01)
    values = 0.4 * np.sin(2 * np.pi * time) * np.exp(-(((time - 2) / 0.8) ** 2))
    values *= 0.4 / np.abs(values).max()
    write_columns(tmp_path / "record.csv", {"time (s)": time, "acceleration": values})
    return tmp_path / "record.csv"


@pytest.fixture
def told(colonnade):
    """Run a command that ends well; return what it says."""

    def run(*arguments):
        found = colonnade(*arguments)
        assert found.returncode == 0
        return found.stdout

    return run


@pytest.fixture
def refused(colonnade):
    """Run a command that is refused; return its exit code and why, in one line."""

    def run(*arguments):
        found = colonnade(*arguments)
        assert "Traceback" not in found.stderr
        return found.returncode, " ".join(found.stderr.replace("│", " ").split())

    return run


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
    assert "peak ground acceleration" in said
    assert "0.95 (given)" in said
    found = json.loads(told(*asked, "--slenderness", "0.3 rad", "--json"))
    peak = found["measures"]["values"]["pga"]
    assert peak == pytest.approx(0.4 * 9.80665, rel=1e-5)
    assert found["spectrum"]["critical_angle"] == [0.2, 0.3]
    assert [len(row) for row in found["spectrum"]["peak_ratio"]] == [4, 4]
    assert found["column"]["restitution"] == [0.95, 0.95]


def test_a_specimen_of_a_campaign_is_taken_at_its_scale(campaign, record, refused, told):
    with (campaign / "campaign.toml").open("a", encoding="utf-8") as stream:
        stream.write('\n[motions]\nswinging = "record.csv"\n')
    asked = ["spectrum", str(campaign), "--motion", "swinging", "--points", "2", "--json"]
    assert '--peak "0.3 g"' in refused(*asked)[1]
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
        ([*PULSE, "--points", "1"], "--points: 1 was found."),
        ([*PULSE, "--largest", "-1"], "largest is -1.0"),
        ([*PULSE, "--out", "x.txt"], "unknown ending"),
        (["--motion", "nowhere.csv", *COLUMN], 'There is no motion "nowhere.csv".'),
        ([*SHAKEN, "--unit", "g", "--baseline", "cubic"], "--baseline: Unknown baseline"),
        ([*SHAKEN, "--unit", "g", "--peak", "strong"], "--peak: "),
        ([*SHAKEN, "--unit", "g", "--drift", "-1"], "drift is -1.0"),
        ([*SHAKEN, "--unit", "g", "--slenderness", "1 m"], "--slenderness: "),
    ],
)
def test_a_wrong_use_says_what_was_expected(record, arguments, message, refused):
    code, said = refused("spectrum", *arguments)
    assert (code, message in said) == (2, True), said


def test_a_file_without_a_unit_is_named(record, refused):
    code, said = refused("spectrum", "--motion", str(record), *COLUMN)
    assert (code, "does not give the unit" in said) == (1, True)


def test_the_verdict_is_the_first_line(record, told):
    asked = ["spectrum", "--motion", str(record), *PRISM, "--unit", "g", "--points", "2"]
    assert re.match(r"The column (overturns|rocks to .* and stands|does not rock) \(nonlinear", told(*asked))
    weak = told(*asked, "--peak", "0.1 g")  # g tan α is 0.2 g
    assert weak.startswith("The column does not rock (nonlinear model).")
    pulse = ["spectrum", "--pulse", "half-sine", *COLUMN, "--points", "2", "--omega", "1", "2", "--model", "linear"]
    said = told(*pulse, "--largest", "1.01")
    assert said.startswith("No half-sine pulse up to A = 1.01 overturns the column (linear model).")


def test_what_a_campaign_recorded_is_in_the_time_of_the_column(foreseen_copy, refused, told):
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
    assert "how many times larger the column is, is not known" in refused(*asked, *given)[1]


def test_what_was_run_gives_advice(colonnade, campaign):
    assert colonnade("run", "--until", "restitution", "--workers", "1").returncode == 0
    (advice,) = json.loads(colonnade("next", "--json").stdout)["advice"]
    assert {"specimen", "kind", "test", "reason", "risk", "left", "demand", "beyond"} <= advice.keys()
    assert advice["kind"] == "free-vibration"
    told = colonnade("next")
    assert told.returncode == 0
    assert told.stdout.startswith(f"Do this next: free-vibration of prism: {advice['test']}")
    assert f"Because {advice['reason']}." in told.stdout


def test_a_forecast_is_shown_and_kept(foreseen_copy, told):
    asked = ["foresee", str(foreseen_copy), "--motion", TEST, "--specimen", "prism"]
    said = told(*asked, "--level", "0.01 g").replace("\xa0", " ")
    assert "100 %" in said
    assert max(map(len, said.partition("forecast: ")[0].splitlines())) <= 80
    assert "forecast: " in said
    (made,) = json.loads(told(*asked, "--level", "1x", "--json"))
    assert made["level"] == "1x"
    assert made["models"]["linear"]["bands"][2]["probability"] == 0.95


@pytest.mark.whole
def test_the_campaigns_assessments_are_shown(assessed_copy, colonnade):
    told = colonnade("fragility", str(assessed_copy))
    assert "It starts to rock at 0.189 g" in told.stdout
    assert "result: " in told.stdout
    assert "warning: Left out: broken.csv" in told.stderr


@pytest.mark.whole
def test_a_column_without_a_campaign_is_answered_and_drawn(assessed, tmp_path, told):
    column = ["--critical-angle", "0.18 rad", "--p", "1.26 rad/s", "--restitution", "0.95"]
    levels = ["--level", "1 m/s", "--level", "2 m/s", "--level", "4 m/s", "--draws", "1", "--resamples", "100"]
    out = tmp_path / "curve.svg"
    asked = ["fragility", *levels, "--records", str(assessed / "records")]
    [found] = json.loads(told(*asked, *column, "--out", str(out), "--json"))
    assert (found["specimen"], found["status"], found["critical_angle"]) == ("column", "done", 0.18)
    assert out.read_text(encoding="utf-8").startswith("<?xml")
    said = told(*asked, *PRISM, "--restitution", "0.95")
    assert said.startswith("column: It overturns with a probability of")
    assert "Assumed: α 0.197 rad, p 1.7 rad/s" in said


def test_what_cannot_be_answered_says_why(assessed, colonnade, refused):
    told = colonnade("fragility", str(assessed), "--records", "nowhere")
    assert (told.returncode, "nowhere" in told.stderr) == (1, True)
    code, said = refused("fragility", str(assessed), "--measure", "pvg")
    assert (code, 'Did you mean "pgv"?' in said) == (2, True)


SMALL = ("--omega", "2", "4", "--amplitude", "0.8", "2", "--points", "3", "5", "--cycles", "3", "--workers", "1")


def test_a_map_is_written_with_its_picture(colonnade, campaign):
    told = colonnade("map", *SMALL, "--phase", "90", "--ramp", "1")
    assert (told.returncode, told.stderr) == (0, "")
    paths = dict(line.split(": ") for line in told.stdout.splitlines()[1:])
    assert Path(paths["map"]) == campaign / "processed" / "maps" / "prism-nonlinear.nc"
    assert "<svg" in Path(paths["figure"]).read_text(encoding="utf-8")
    assert told.stdout.startswith("prism, nonlinear model: no measured point, e rigid-body; computed\n")


@pytest.mark.whole
def test_several_models_and_their_responses_are_written_with_a_picture_together(colonnade, campaign):
    models = ("--model", "linear", "--model", "nonlinear")
    told = colonnade("map", *SMALL, *models, "--ramp", "1", "--responses")
    assert (told.returncode, told.stderr) == (0, "")
    maps = campaign / "processed" / "maps"
    written = {path.name for path in maps.iterdir()}
    kinds = (".nc", "-response.nc", "-response.svg")
    each = {f"prism-{model}{kind}" for model in ("linear", "nonlinear") for kind in kinds}
    assert written == each | {"prism-linear+nonlinear.svg"}
    assert f"figure: {maps / 'prism-linear+nonlinear.svg'}" in told.stdout
    together = (maps / "prism-linear+nonlinear.svg").read_text(encoding="utf-8")
    assert all(f"{model}: lower limit" in together for model in ("linear", "nonlinear"))
    made = json.loads(colonnade("map", *SMALL, *models, "--ramp", "1", "--json").stdout)
    said = [(each["model"], each["kind"], each["because"]) for each in made]
    assert said == [(model, "map", "") for model in ("linear", "nonlinear")]


def test_the_law_is_shown_and_stored(colonnade, campaign, changed):
    contact = '[processing.predict]\ncontact = {step = "30 us", damping_fraction = 0.3}\n'
    changed("campaign.toml", "\n[setups.frame.ch", f"\n{contact}\n[setups.frame.ch")
    unknown = colonnade("calibrate")
    assert (unknown.returncode, "Run `colonnade identify` first" in unknown.stderr) == (2, True)
    assert colonnade("identify", "--workers", "1").returncode == 0
    told = colonnade("calibrate", "--workers", "1")
    assert (told.returncode, told.stderr) == (0, "")
    assert "29.6 µs" in told.stdout  # what divides an interval of the free vibration
    assert f"law: {campaign / 'processed' / 'contact' / 'prism.nc'}" in told.stdout
    (made,) = json.loads(colonnade("calibrate", "--workers", "1", "--json").stdout)
    assert (made["specimen"], made["damping_fraction"], made["reason"]) == ("prism", 0.3, "")
    assert "velocity ratio" in told.stdout
    assert "identified" in told.stdout
    assert made["source"] == "identified"
    assert 1e-4 < abs(made["contact_restitution"] - made["contact_velocity_ratio"]) < 2e-3
