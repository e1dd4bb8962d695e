"""Channels as recorded: both scales, failed samples, spectra; and that nothing grows without bound."""

import numpy as np
import pytest
import xarray as xr

from colonnade.campaign import Test
from colonnade.figures import channels
from colonnade.figures.stored.subject import OfTest
from colonnade.signals.quality import Flag
from colonnade.store.records.stored import Stored


def stored(number=1, spikes=(), samples=800):
    noise = np.random.default_rng(1).standard_normal(samples)
    flags = np.full(samples, Flag.GOOD, np.int8)
    flags[list(spikes)] = Flag.FAIL
    variables, attributes = {}, {}
    for index in range(number):
        name = f"laser{index}"
        variables[name] = ("elapsed", 1e-3 * (2.0 * noise + 0.5), {"channel": name})
        variables[f"{name}_recorded"] = ("elapsed", noise)
        variables[f"{name}_quality"] = ("elapsed", flags)
        attributes[name] = {"quantity": "displacement", "recorded_unit": "V", "cutoff_hz": 25.0}
    found = Stored(datasets={("ingest", None): xr.Dataset(variables, {"elapsed": 0.005 * np.arange(samples)})})
    found.channels = attributes
    return picture_of(found)


def picture_of(found):
    return channels.picture(OfTest(None, Test.model_construct(id="a"), None, found))


def test_the_recorders_scale_follows_from_the_samples():
    history = stored().figure.axes[0]
    assert history.get_ylabel() == "mm"
    heights = {text.get_text(): text.xy[1] for text in history.texts}
    assert heights["2"] == pytest.approx(4.5)  # 2 mm/V and 0.5 mm


def test_a_channel_without_samples_enough_has_no_spectrum():
    assert [text.get_text() for text in stored(samples=5).figure.axes[1].texts] == ["no spectrum"]


def test_failed_samples_are_counted():
    found = stored(spikes=[100, 300, 301, *range(500, 560)])
    assert "63 failed or missing samples" in found.description


def test_of_many_channels_twelve_are_drawn():
    found = stored(number=30, spikes=range(10, 700, 10))
    assert found.note == "12 of 30 channels are drawn."
    assert len(found.figure.axes) == 24


def test_without_samples_there_is_nothing_to_draw():
    assert picture_of(Stored()) is None
    assert picture_of(Stored(datasets={("ingest", None): xr.Dataset()})) is None
