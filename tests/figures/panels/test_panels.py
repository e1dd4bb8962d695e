"""Panels: stacked or side by side, curves thinned to what can be seen and long ones whole."""

import numpy as np
import pytest
from matplotlib.figure import Figure

from colonnade.figures.files.output import to_png, to_svg
from colonnade.figures.panels.curve import Curve, draw_band, draw_curve, envelope
from colonnade.figures.panels.layout import legend_above
from colonnade.figures.style import styled, width


def noisy(samples=60_000):
    return Curve(np.arange(samples) / 1000, np.random.default_rng(3).normal(size=samples))


def test_a_long_curve_is_thinned_and_keeps_its_ends_and_extremes():
    curve = noisy()
    thinned = envelope(curve, intervals=300)
    assert thinned.time.size <= 602
    assert thinned.values.max() == curve.values.max()
    assert thinned.values.min() == curve.values.min()
    assert (thinned.time[0], thinned.time[-1]) == (curve.time[0], curve.time[-1])
    assert (np.diff(thinned.time) > 0).all()


TIME = np.arange(50_000) / 1000
NOISE = np.random.default_rng(1).normal(size=TIME.size)


def panel():
    figure = Figure(figsize=(4.0, 2.0))
    return figure, figure.subplots()


def svg_size(figure):
    return len(to_svg(figure, identity="one", title="", description=""))


def test_a_long_curve_keeps_every_sample_and_gives_a_short_file():
    figure, axes = panel()
    line = draw_curve(axes, Curve(TIME, NOISE), label="noise")
    assert svg_size(figure) < 60_000
    time, values = line.get_data()
    np.testing.assert_array_equal(time, TIME)
    np.testing.assert_array_equal(values, NOISE)
    assert not line.stale


def test_a_part_of_a_long_curve_is_drawn_with_its_own_samples():
    """Of 50 s in 4 inches a spike of one sample has neighbours in one pixel; zoomed in it stands alone."""
    figure, axes = panel()
    values = np.zeros(TIME.size)
    values[20_000] = 1.0
    draw_curve(axes, Curve(TIME, values))
    axes.set_xlim(19.99, 20.01)
    zoomed = to_png(figure)
    figure, axes = panel()
    axes.plot(TIME[19_980:20_021], values[19_980:20_021])
    axes.set(xlim=(19.99, 20.01), ylim=(-0.05, 1.05))
    assert zoomed == to_png(figure)


def test_a_band_keeps_every_sample_and_breaks_where_nothing_is_known():
    figure, axes = panel()
    above = np.where((TIME > 20) & (TIME < 30), np.nan, NOISE + 1.0)
    band = draw_band(axes, TIME, NOISE - 1.0, above, label="95 %")
    assert svg_size(figure) < 80_000
    np.testing.assert_array_equal(band.time, TIME)
    np.testing.assert_array_equal(band.above, above)
    outlines = [path.vertices for path in band.get_paths()]
    assert len(outlines) == 2
    assert max(map(len, outlines)) < 1500
    assert outlines[0][:, 1].max() == pytest.approx(np.nanmax(above[TIME <= 20]))
    assert outlines[0][:, 0].max() == pytest.approx(20.0, abs=0.1)


@pytest.mark.parametrize(
    "values",
    [NOISE[:100], np.where(np.arange(100) % 99 < 10, np.nan, NOISE[:100]), np.full(100, np.nan)],
    ids=["whole", "with gaps at both ends", "without a value"],
)
def test_axes_scale_themselves_to_a_curve_as_to_a_line_of_matplotlib(values):
    (_, ours), (_, theirs) = panel(), panel()
    draw_curve(ours, Curve(TIME[:100], values))
    theirs.plot(TIME[:100], values)
    assert (ours.get_xlim(), ours.get_ylim()) == (theirs.get_xlim(), theirs.get_ylim())


@pytest.mark.parametrize("name", ["free", "cylinder-free", "a-long-name-of-a-free-vibration"])
@styled()
def test_a_legend_is_within_the_figure_however_long_its_names(name):
    figure = Figure(figsize=(width(), 3.0))
    axes = figure.add_axes((0.1, 0.2, 0.8, 0.6))
    for number in range(5):
        axes.plot([0, 1], [number, 1], label=f"{name}-{number}")
    legend_above(figure, [axes])
    box, whole = figure.legends[0].get_window_extent(), figure.bbox
    assert whole.x0 <= box.x0 < box.x1 <= whole.x1
    assert axes.get_window_extent().y1 < box.y0
