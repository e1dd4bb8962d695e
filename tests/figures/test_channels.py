"""Channels as recorded: both scales, flags, spectra; and that nothing grows without bound."""

import numpy as np
import pytest
import xarray as xr

from colonnade.campaign import Test
from colonnade.figures import channels
from colonnade.figures.channels import Channel, Scale, channels_as_recorded
from colonnade.figures.panels.curve import Curve
from colonnade.figures.stored.subject import OfTest
from colonnade.signals.metrics import Density
from colonnade.signals.quality import Flag
from colonnade.store.records.stored import Stored

TIME = np.arange(0, 2, 0.01)
FREQUENCY = np.geomspace(1, 50, 20)


def channel(**changed):
    given = {
        "name": "top",
        "unit": "mm",
        "curve": Curve(TIME, 10 * np.sin(TIME)),
        "recorded": Scale("V", -5.0, 1.0),
        "flags": np.full(TIME.size, Flag.GOOD),
        "before": Density(FREQUENCY, 1 / FREQUENCY),
        "after": Density(FREQUENCY, FREQUENCY**-3),
        "cutoff": 25.0,
    }
    return Channel(**given | changed)


def test_flagged_samples_are_marked_where_they_are_and_missing_ones_at_the_foot():
    values, flags = 10 * np.sin(TIME), np.full(TIME.size, Flag.GOOD)
    values[50:61:10], flags[50], flags[60] = [90.0, np.nan], Flag.FAIL, Flag.MISSING
    history = channels_as_recorded([channel(curve=Curve(TIME, values), flags=flags)]).axes[0]
    marked = next(line for line in history.lines if line.get_label() == "failed or missing")
    assert marked.get_xdata().tolist() == [0.5, 0.6]
    assert marked.get_ydata().tolist() == [90.0, pytest.approx(0.0)]


def test_a_channel_without_samples_enough_has_no_spectrum():
    figure = channels_as_recorded([channel(before=None, after=None)])
    assert [text.get_text() for text in figure.axes[1].texts] == ["no spectrum"]


SAMPLED = np.arange(0, 4, 0.005)


def stored(number=1, spikes=()):
    noise = np.random.default_rng(1).standard_normal(SAMPLED.size)
    flags = np.full(SAMPLED.size, Flag.GOOD, np.int8)
    flags[list(spikes)] = Flag.FAIL
    variables, attributes = {}, {}
    for index in range(number):
        name = f"laser{index}"
        variables[name] = ("elapsed", 1e-3 * (2.0 * noise + 0.5), {"channel": name})
        variables[f"{name}_recorded"] = ("elapsed", noise)
        variables[f"{name}_quality"] = ("elapsed", flags)
        attributes[name] = {"quantity": "displacement", "recorded_unit": "V", "cutoff_hz": 25.0}
    found = Stored(datasets={("ingest", None): xr.Dataset(variables, {"elapsed": SAMPLED})})
    found.channels = attributes
    return picture_of(found)


def picture_of(found):
    return channels.picture(OfTest(None, Test.model_construct(id="a"), None, found))


def test_the_recorders_scale_follows_from_the_samples():
    history = stored().figure.axes[0]
    assert history.get_ylabel() == "mm"
    heights = {text.get_text(): text.xy[1] for text in history.texts}
    assert heights["2"] == pytest.approx(4.5)  # 2 mm/V and 0.5 mm


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
