import json
import os

import pytest

from colonnade.campaign.forms.forecast import ForecastFile
from colonnade.errors import StoreError
from colonnade.store.forecasts import LARGEST, read_forecasts, write_forecast
from colonnade.store.layout import Layout
from colonnade.store.provenance import hash_of

SIDE = {"critical_angle": 0.2, "pole_distance": 0.3, "inertia": 2.0}
PEAKS = {"peak_ratio": [0.4, None], "rigid_body_peak_ratio": [0.3, None]}
BANDS = 3 * [{"probability": 0.5, "low": 0.4, "high": 1.0}]
MODEL = PEAKS | {"no_rocking": 0.0, "rocking": 0.5, "overturned": 0.5, "bands": BANDS, "required_friction": 0.3}
SAMPLES = {"interval": 0.01, "samples": 9, "time_scale": 1.0}
KNOWN = {"value": [0.9, 0.9], "low": None, "high": None, "level": 0.95, "source": "given", "rigid_body": [0.8, 0.8]}
CONTENT = {
    "schema": 1,
    "made": "2026-01-02T03:04:05Z",
    "colonnade": "0.1.0",
    "code": "a" * 64,
    "test": "span-2",
    "specimen": "prism",
    "level": "0.3 g",
    "motion": {"name": "../El Centro", "source": "", "sha256": "b" * 64} | SAMPLES,
    "table": {"peak_acceleration": 3.0, "peak_velocity": None, "peak_displacement": None, "drift": 1.5},
    "inputs": {
        "block": {"mass": 26.0, "gravity": 9.81, "negative": SIDE, "positive": SIDE},
        "restitution": KNOWN,
        "spread": dict.fromkeys(("restitution", "critical_angle", "p", "gain", "clock"), 0.01),
        "table_tilt": 0.0,
        "rest_angle": 1e-6,
        "members": 2,
        "seed": 0,
    },
    "models": {"linear": MODEL},
    "raw_files": {"raw/a.csv": "c" * 64},
}


def signed(content):
    return json.dumps(content | {"sha256": hash_of(content)})


def changed(**change):
    return signed(CONTENT | change)


def test_what_is_written_is_read(tmp_path):
    layout, forecast = Layout(tmp_path), ForecastFile.model_validate(CONTENT)
    paths = [write_forecast(layout, forecast) for _ in range(2)]
    stem = "20260102T030405Z-prism-.._El_Centro-0.3_g"
    assert [path.name for path in paths] == [f"{stem}.json", f"{stem}-2.json"]
    found = read_forecasts(layout)
    assert [each.forecast for each in found.known] == [forecast, forecast]
    assert not found.refused


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "damaged"),
        ("[1]", "damaged"),
        ("[" * 100_000, "damaged"),
        (signed(CONTENT)[:-40], "damaged"),
        (json.dumps(CONTENT), "altered"),
        (signed(CONTENT).replace("0.3 g", "0.4 g"), "altered"),
        (signed(CONTENT).replace("0.4, null", "NaN, null"), "altered"),
        ('{"test": "\\ud800"}', "damaged"),
        (changed(schema=2), "schema"),
        (changed(more=1), "more"),
        (changed(made="2026-01-02T03:04:05"), "time zone"),
        (changed(models={}), "models"),
        (changed(models={"contact": MODEL}), "no model in the plane"),
        (changed(models={"linear": MODEL | {"peak_ratio": [0.1, 0.2, 0.3]}}), "2 members"),
        (changed(models={"linear": MODEL | {"peak_ratio": [0.1, -0.2]}}), "greater than"),
        (changed(inputs=CONTENT["inputs"] | {"block": {**CONTENT["inputs"]["block"], "mass": 1e300}}), "mass"),
    ],
)
def test_a_file_that_is_no_forecast_is_refused_alone(tmp_path, text, said):
    layout = Layout(tmp_path)
    write_forecast(layout, ForecastFile.model_validate(CONTENT))
    (layout.forecasts / "odd.json").write_text(text, encoding="utf-8")
    found = read_forecasts(layout)
    assert len(found.known) == 1
    assert [each.name for each in found.refused] == ["odd.json"]
    assert said in found.refused[0].reason


def test_links_pipes_and_huge_files_are_not_opened(tmp_path):
    layout = Layout(tmp_path)
    path = write_forecast(layout, ForecastFile.model_validate(CONTENT))
    (layout.forecasts / "a.json").symlink_to(path)
    os.mkfifo(layout.forecasts / "b.json")
    with (layout.forecasts / "c.json").open("wb") as stream:
        stream.truncate(LARGEST + 1)
    (layout.forecasts / "d.json").mkdir()
    found = read_forecasts(layout)
    assert [each.name for each in found.known] == [path.name]
    assert [each.name for each in found.refused] == ["a.json", "b.json", "c.json", "d.json"]


def test_a_folder_that_is_a_link_is_neither_read_nor_written(tmp_path):
    (tmp_path / "elsewhere").mkdir()
    layout = Layout(tmp_path / "home")
    layout.home.mkdir()
    layout.forecasts.symlink_to(tmp_path / "elsewhere")
    with pytest.raises(StoreError, match="link"):
        write_forecast(layout, ForecastFile.model_validate(CONTENT))
    assert len(read_forecasts(layout).refused) == 1
    assert not list((tmp_path / "elsewhere").iterdir())
