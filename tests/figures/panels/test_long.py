"""Long curves and bands keep every sample and are drawn with as many points as can be seen."""

from __future__ import annotations

import numpy as np
import pytest
from matplotlib.figure import Figure

from colonnade.figures.files.output import to_png, to_svg
from colonnade.figures.panels.curve import Curve
from colonnade.figures.panels.long import draw_band, draw_curve

TIME = np.arange(50_000) / 1000
NOISE = np.random.default_rng(1).normal(size=TIME.size)


def panel():
    figure = Figure(figsize=(4.0, 2.0))
    return figure, figure.subplots()


def svg_size(figure: Figure) -> int:
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
    axes.set_xlim(19.99, 20.01)
    axes.set_ylim(-0.05, 1.05)
    assert zoomed == to_png(figure)


def test_a_fall_far_beyond_the_axis_lengthens_no_file():
    sizes = []
    for height in (1.0, 1e9):
        figure, axes = panel()
        draw_curve(axes, Curve(TIME, height * NOISE))
        axes.set_ylim(-1.0, 1.0)
        sizes.append(svg_size(figure))
    assert sizes[1] < 1.5 * sizes[0]


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


def test_a_band_scales_its_axis():
    _, axes = panel()
    draw_band(axes, TIME, np.full(TIME.size, -3.0), np.full(TIME.size, 7.0))
    low, high = axes.get_ylim()
    assert low <= -3.0
    assert high >= 7.0


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
