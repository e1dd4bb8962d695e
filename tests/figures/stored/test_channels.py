"""Recorded channels as they are stored: units, the recorder's scale, spikes, and bounds."""

import numpy as np
import pytest
import xarray as xr

from colonnade.figures import channels
from colonnade.signals.quality import Flag
from colonnade.store.records.stored import Stored

TIME = np.arange(0, 4, 0.005)


def stored(number=1, spikes=()):
    noise = np.random.default_rng(1).standard_normal(TIME.size)
    flags = np.full(TIME.size, Flag.GOOD, np.int8)
    flags[list(spikes)] = Flag.FAIL
    variables, attributes = {}, {}
    for index in range(number):
        name = f"laser{index}"
        variables[name] = ("elapsed", 1e-3 * (2.0 * noise + 0.5), {"channel": name})
        variables[f"{name}_recorded"] = ("elapsed", noise)
        variables[f"{name}_quality"] = ("elapsed", flags)
        attributes[name] = {"quantity": "displacement", "recorded_unit": "V", "cutoff_hz": 25.0}
    found = Stored(datasets={("ingest", None): xr.Dataset(variables, {"elapsed": TIME})})
    found.channels = attributes
    return found


@pytest.fixture(scope="module")
def test(filled_campaign):
    return filled_campaign[0].tests["span-2.0"]


def test_the_recorders_scale_follows_from_the_samples(test):
    history = channels.picture(test, stored()).figure.axes[0]
    assert history.get_ylabel() == "mm"
    heights = {text.get_text(): text.get_position()[1] for text in history.texts}
    assert heights["2"] == pytest.approx(4.5)  # 2 mm/V and 0.5 mm


def test_each_spike_is_drawn_and_a_long_failed_stretch_is_none(test):
    found = channels.picture(test, stored(spikes=[100, 300, 301, *range(500, 560)]))
    assert [axes.get_title(loc="left") for axes in found.figure.axes[2:]] == ["laser0\n0.500 s", "laser0\n1.500 s"]
    assert "63 failed or missing samples" in found.description


def test_many_channels_and_spikes_are_summarised(test):
    found = channels.picture(test, stored(number=30, spikes=range(10, 700, 10)))
    assert "12 of 30 channels are drawn." in found.note
    assert "spikes are enlarged" in found.note
    assert len(found.figure.axes) < 40


def test_without_samples_there_is_nothing_to_draw(test):
    assert channels.picture(test, Stored()) is None
    assert channels.picture(test, Stored(datasets={("ingest", None): xr.Dataset()})) is None
