"""Quality of channels: of one by itself, and of accelerometers on the specimen against the table's."""

from __future__ import annotations

import numpy as np
import pytest
import xarray as xr

from colonnade.campaign.review import Flagged, Review
from colonnade.campaign.settings import QualitySettings
from colonnade.signals.quality import Flag
from colonnade.stages.ingesting.quality import ChannelInputs, channel_verdicts, flag_dead_on_specimen, reviewed

TIME = np.arange(0.0, 10.0, 0.01)
WAVE = np.sin(2 * np.pi * 2.0 * TIME)


def _channel(on, direction=(1.0, 0.0, 0.0), **changed):
    given = {
        "column": "a",
        "recorder": "main",
        "time": None,
        "quantity": "acceleration",
        "unit": "g",
        "gain": None,
        "factor": 9.80665,
    }
    return ChannelInputs(
        **given
        | {"offset": 0.0, "full_scale": None, "range_recorded": None, "on": on, "direction": direction}
        | changed
    )


def _flagged(scale, **changed):
    noise = np.random.default_rng(0).normal(0.0, 1e-3, TIME.size)
    values = {"table": WAVE, "block": scale * WAVE + noise}
    dataset = xr.Dataset({name: ("elapsed", each) for name, each in values.items()})
    for name in values:
        dataset[f"{name}_quality"] = ("elapsed", np.full(TIME.size, Flag.GOOD, dtype=np.int8))
    warnings = []
    channels = {"table": _channel("table"), "block": _channel("specimen", **changed)}
    return flag_dead_on_specimen(dataset, channels, warnings), warnings


def test_an_accelerometer_that_hardly_moves_with_the_table_is_flagged():
    dataset, (warning,) = _flagged(0.01)
    assert warning.text.startswith("channel block: ")
    assert (dataset["block_quality"] > Flag.GOOD).all()
    assert (dataset["table_quality"] == Flag.GOOD).all()


@pytest.mark.parametrize(
    ("scale", "changed"), [(0.5, {}), (0.01, {"direction": (0.0, 1.0, 0.0)})], ids=["alive", "along another axis"]
)
def test_others_are_not(scale, changed):
    assert _flagged(scale, **changed)[1] == []


def test_clipping_is_judged_by_the_recorded_range_if_it_is_given_so():
    recorded = np.clip(WAVE, -0.5, 0.5)
    channel = _channel("table", range_recorded=0.5, full_scale=100.0)
    verdicts = channel_verdicts(TIME, recorded, 9.80665 * recorded, channel, QualitySettings())
    assert [verdict.finding.kind for verdict in verdicts if verdict.reason] == ["end of the range"]


def test_people_flag_a_stretch_or_a_whole_channel():
    flags = (
        Flagged(channel="top", window=(1.0, 2.0), flag="suspect", reason="knocked"),
        Flagged(channel="top", window=None, flag="fail", reason="loose"),
        Flagged(channel="other", window=None, flag="fail", reason="loose"),
    )
    stretch, whole = reviewed("top", TIME, Review(flags=flags))
    assert (stretch.flag, int(stretch.where.sum())) == (Flag.SUSPECT, 101)
    assert (whole.flag, bool(whole.where.all())) == (Flag.FAIL, True)
