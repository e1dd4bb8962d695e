"""The band figure shades what the runs hold and draws the measured angle over it."""

import numpy as np
import pytest

from colonnade.figures.histories import Spread, bands_over_time
from colonnade.figures.panels.curve import Curve

LEVELS = np.array([0.05, 0.25, 0.5, 0.75, 0.95])
TIME = np.linspace(0.0, 10.0, 5001)
CENTRE = 0.4 * np.sin(4 * TIME)
BANDS = CENTRE + np.array([[-0.1], [-0.05], [0.0], [0.05], [0.1]]) * TIME / 10


def spread(probability=0.0, horizon=10.0):
    return Spread(TIME, LEVELS, BANDS, probability, horizon)


def shades(axes):
    """Outlines of the bands, the widest first."""
    return [collection.get_paths()[0].vertices for collection in axes.collections]


def test_each_model_has_a_panel_with_its_bands_and_the_measured_angle():
    figure = bands_over_time(Curve(TIME, CENTRE), {"linear": spread(), "nonlinear": spread()})
    said = [axes.get_title(loc="right") for axes in figure.axes]
    assert said[0] == "measured, and bands of 90\u00a0% and 50\u00a0% of the linear model's runs"
    assert "of the nonlinear model's runs" in said[1]
    for axes in figure.axes:
        assert len(shades(axes)) == 2
        assert [line.get_label() for line in axes.lines] == ["measured"]
    assert figure.axes[0].collections[0].get_facecolor()[0, :3] != pytest.approx(
        figure.axes[1].collections[0].get_facecolor()[0, :3]
    )


def test_the_widest_band_holds_the_inner_one():
    (axes,) = bands_over_time(None, {"linear": spread()}).axes
    assert [band.get_label() for band in axes.collections] == ["linear 90\u00a0% band", "linear 50\u00a0% band"]
    wide, narrow = (np.ptp(outline[:, 1]) for outline in shades(axes))
    assert wide > narrow
    assert narrow == pytest.approx(0.8 + 0.1, abs=0.02)


def test_the_probability_of_overturning_is_written_where_there_is_one():
    def said(probability):
        return bands_over_time(None, {"linear": spread(probability)}).axes[0].get_title(loc="right")

    assert "12\u00a0% overturn" in said(0.12)
    assert "overturn" not in said(0.0)


def test_each_model_has_its_horizon_marked_unless_it_is_the_records_end():
    figure = bands_over_time(
        None, {"linear": spread(horizon=4.0), "nonlinear": spread(horizon=7.0), "contact": spread()}
    )
    marks = [[line.get_xdata()[0] for line in axes.lines if len(line.get_xdata()) == 2] for axes in figure.axes]
    assert marks == [[4.0], [7.0], []]
    assert ["horizon" in [text.get_text() for text in axes.texts] for axes in figure.axes] == [True, True, False]


def test_no_model_or_unpaired_levels_are_refused():
    with pytest.raises(ValueError, match="at least one model"):
        bands_over_time(None, {})
    with pytest.raises(ValueError, match="not paired"):
        bands_over_time(None, {"linear": Spread(TIME, np.array([0.05, 0.5]), BANDS[:2], 0.0, 10.0)})
