"""The figure of a stability map shows limits, shares of cells and measured points."""

import numpy as np
import pytest

from colonnade.dynamics.maps import stability_map as computed
from colonnade.figures.maps.stability_map import stability_map
from colonnade.identification.response.boundaries import MapPoint
from prism import PRISM

OPTIONS = {"frequency_ratio": [2.0, 4.0, 6.0], "amplitude_ratio": np.linspace(0.5, 6.0, 12), "restitution": 0.9}
OPTIONS |= {"width": 0.1, "edge": 0.01, "cycles": 4}
POINTS = [MapPoint("a", 3.35, 0.9, "no-rocking"), MapPoint("b", 3.35, 1.5, "overturned")]


@pytest.fixture(scope="module")
def charts():
    return [computed(PRISM, model=model, **OPTIONS) for model in ("linear", "nonlinear")]


def test_limits_of_every_model_are_drawn_in_its_own_colour(charts):
    axes = stability_map(charts).axes[0]
    lines = {line.get_label(): line for line in axes.lines}
    for chart, model in zip(charts, ("linear", "nonlinear"), strict=True):
        np.testing.assert_array_equal(lines[f"{model}: lower limit"].get_ydata(), chart.lower)
        np.testing.assert_array_equal(lines[f"{model}: upper limit"].get_ydata(), chart.upper)
    assert lines["linear: lower limit"].get_color() != lines["nonlinear: lower limit"].get_color()


def test_measured_points_lie_on_the_map_by_their_outcome(charts):
    axes = stability_map(charts[:1], POINTS).axes[0]
    drawn = {group.get_label(): group.get_offsets().tolist() for group in axes.collections}
    assert drawn["measured: no rocking"] == [[3.35, 0.9]]
    assert drawn["measured: overturned"] == [[3.35, 1.5]]


def test_cells_are_shaded_by_the_share_that_overturns(charts):
    mesh = stability_map(charts[:1]).axes[0].collections[0]
    np.testing.assert_array_equal(mesh.get_array().reshape(12, 3), charts[0].overturning_fraction.T)


def test_ramps_are_told_above():
    title = stability_map([computed(PRISM, **OPTIONS, ramp=2)]).axes[0].get_title(loc="left")
    assert "linear ramps of 2" in title


def test_measured_points_beyond_the_map_widen_it(charts):
    axes = stability_map(charts[:1], [MapPoint("z", 5.0, 11.0, "rocking")]).axes[0]
    assert axes.get_ylim()[1] >= 11.0
