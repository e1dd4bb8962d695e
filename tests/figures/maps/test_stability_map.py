"""Figures of stability maps and spectra show limits, shares of cells, measured points, peaks and intervals."""

import numpy as np
import pytest

from colonnade.dynamics.maps import stability_map as computed
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.pulses import overturning_spectrum
from colonnade.dynamics.spectra import rocking_spectrum
from colonnade.figures.files.table import columns_of
from colonnade.figures.maps import stability_map as drawing
from colonnade.figures.maps.stability_map import stability_map
from colonnade.identification.response.boundaries import MapPoint
from prism import PRISM

OPTIONS = {"frequency_ratio": [2.0, 4.0, 6.0], "amplitude_ratio": np.linspace(0.5, 6.0, 12), "restitution": 0.9}
OPTIONS |= {"width": 0.1, "edge": 0.01, "cycles": 4}
POINTS = [MapPoint("a", 3.35, 0.9, "no-rocking"), MapPoint("b", 3.35, 11.0, "overturned")]


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


def test_measured_points_lie_on_the_map_by_their_outcome_and_widen_it(charts):
    axes = stability_map(charts[:1], POINTS).axes[0]
    drawn = {group.get_label(): group.get_offsets().tolist() for group in axes.collections}
    assert drawn["measured: no rocking"] == [[3.35, 0.9]]
    assert drawn["measured: overturned"] == [[3.35, 11.0]]
    assert axes.get_ylim()[1] >= 11.0


def test_cells_are_shaded_by_the_share_that_overturns(charts):
    mesh = stability_map(charts[:1]).axes[0].collections[0]
    np.testing.assert_array_equal(mesh.get_array().reshape(12, 3), charts[0].overturning_fraction.T)


def test_ramps_are_told_above():
    title = stability_map([computed(PRISM, **OPTIONS, ramp=2)]).axes[0].get_title(loc="left")
    assert "linear ramps of 2" in title


def test_a_rocking_spectrum_shows_peaks_and_which_blocks_overturn():
    motion = Motion(4.0 * np.sin(4 * np.pi * np.linspace(0, 1, 201)), 0.005)
    spectrum = rocking_spectrum(motion, critical_angle=[0.15, 0.25], period=[0.5, 0.8, 9.0])
    table = columns_of(drawing.rocking_spectrum(spectrum, period=4.0, title=""))
    shown = table["largest |θ|/α, α = 0.25 rad"]
    np.testing.assert_allclose(shown, spectrum.peak_ratio[1])
    fallen = table["size 2π/p (s), α = 0.15 rad: overturned"]
    np.testing.assert_array_equal(fallen, spectrum.period[spectrum.overturned[0]])
    assert len(fallen) >= 2


def test_an_overturning_spectrum_shows_both_limits_and_every_interval():
    spectrum = overturning_spectrum(PRISM, "sine", frequency_ratio=[2.0, 3.0, 4.0], largest=6.0)
    figure = drawing.overturning_spectrum(spectrum)
    table = columns_of(figure)
    np.testing.assert_allclose(table["A = a / (g tan α), lower limit"], spectrum.lower)
    np.testing.assert_allclose(table["A = a / (g tan α), upper limit"], spectrum.upper)
    edges = table["A = a / (g tan α), edges of the intervals that overturn"]
    assert sorted(edges) == pytest.approx(sorted([*spectrum.interval_start, *spectrum.interval_end]))
    assert "sine; linear model; e = 0.9" in figure.axes[0].get_title(loc="left")


TESTED = [
    MapPoint("a", 3.35, 0.9, "no-rocking"),
    MapPoint("b", 3.35, 1.1, "rocking", 2),
    MapPoint("c", 3.35, 1.5, "overturned"),
    MapPoint("d", 4.46, 0.95, "no-rocking"),
    MapPoint("e", 4.46, 1.2, "rocking", "irregular"),
    MapPoint("f", 5.58, 0.95, "no-rocking"),
    MapPoint("g", 5.58, 1.2, "rocking", 1),
    MapPoint("h", 5.58, 2.5, "overturned"),
]


def measured(points):
    axes = drawing.measured_map(points).axes[0]
    return axes, {
        collection.get_label(): collection.get_offsets().tolist()
        for collection in axes.collections
        if not str(collection.get_label()).startswith("_")
    }


def test_each_test_stands_at_its_place_under_its_outcome_sub_harmonic_ones_with_their_order():
    axes, groups = measured(TESTED)
    assert [text.get_text() for text in axes.texts] == ["1/2"]
    assert groups == {
        "no rocking": [[3.35, 0.9], [4.46, 0.95], [5.58, 0.95]],
        "rocking": [[3.35, 1.1], [4.46, 1.2], [5.58, 1.2]],
        "overturned": [[3.35, 1.5], [5.58, 2.5]],
    }


def test_bars_span_the_brackets_and_the_line_breaks_where_there_is_none():
    axes, _ = measured(TESTED)
    lines = {line.get_label(): line for line in axes.lines}
    assert lines["rocking begins"].get_ydata() == pytest.approx([1.0, 1.075, 1.075])
    assert lines["overturning begins"].get_ydata() == pytest.approx([1.3, float("nan"), 1.85], nan_ok=True)
    bars = [bar for group in axes.collections if hasattr(group, "get_segments") for bar in group.get_segments()]
    np.testing.assert_allclose(bars[-2:], [[[3.35, 1.1], [3.35, 1.5]], [[5.58, 1.2], [5.58, 2.5]]])
