"""The table of a figure holds what was drawn, whatever the figure."""

import csv
import io

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays
from matplotlib.figure import Figure

from colonnade.figures.files.output import to_csv
from colonnade.figures.files.table import columns_of
from colonnade.figures.panels.curve import Curve, draw_band, draw_curve

NUMBERS = st.floats(-1e6, 1e6, width=32)


def table_of(figure):
    """What a figure shows, as lists that compare equal."""
    return {heading: list(column) for heading, column in columns_of(figure).items()}


def panel():
    axes = Figure().subplots()
    axes.set(xlabel="time (s)", ylabel="slide\n(mm)")
    return axes


@settings(max_examples=50, deadline=None)
@given(
    curves=st.lists(arrays.arrays(np.float64, st.integers(2, 40), elements=NUMBERS), min_size=1, max_size=4),
    names=st.lists(st.text(min_size=1, max_size=12), min_size=4, max_size=4),
)
def test_every_drawn_line_is_in_the_table_with_all_its_samples(curves, names):
    """Whatever they are called: also alike, or like what a spreadsheet would calculate."""
    axes = panel()
    for values, name in zip(curves, names, strict=False):
        draw_curve(axes, Curve(np.arange(values.size) / 8, values), label=name)
    table = table_of(axes.figure)
    columns = {tuple(column) for heading, column in table.items() if heading.startswith("slide (mm)")}
    assert columns == {tuple(values) for values in curves}
    longest = max(map(np.size, curves))
    written = list(csv.reader(io.StringIO(to_csv(axes.figure))))
    assert len(written) == 1 + longest
    assert {len(row) for row in written} == {len(table)}
    assert not any(cell.startswith(("=", "+", "@")) for cell in written[0])


def test_a_title_above_several_panels_is_of_all_of_them_and_a_curve_in_two_is_there_once():
    figure = Figure()
    for title, time, panels in zip("ab", ([0.0, 1.0], [0.0, 2.0]), figure.subplots(2, 2), strict=True):
        panels[0].set_title(title, loc="left")
        for axes, model in zip(panels, ("linear", "nonlinear"), strict=True):
            axes.set(xlabel="time (s)", ylabel="angle")
            axes.plot(time, [1.0, 2.0], label="measured")
            axes.plot(time, [3.0, 4.0], label=model)
    assert list(table_of(figure)) == [
        "time (s)",
        *(f"a, angle, {name}" for name in ("measured", "linear", "nonlinear")),
        "time (s), b",
        *(f"b, angle, {name}" for name in ("measured", "linear", "nonlinear")),
    ]


def test_a_gap_is_an_empty_cell_and_a_shorter_column_ends():
    axes = panel()
    draw_curve(axes, Curve(np.array([0.0, 1.0, 2.0]), np.array([1.0, np.nan, 3.0])), label="a")
    axes.plot([5.0], [6.0], label="b")
    assert to_csv(axes.figure) == ('time (s),"slide (mm), a","time (s), b","slide (mm), b"\n0,1,5,6\n1,,,\n2,3,,\n')


def test_error_bars_give_the_value_and_both_ends():
    axes = panel()
    axes.errorbar([1.0, 2.0], [5.0, 6.0], yerr=[[1.0, 2.0], [3.0, 4.0]], xerr=0.5, fmt="o", label="peaks", capsize=2)
    table = table_of(axes.figure)
    assert table == {
        "time (s)": [1.0, 2.0],
        "time (s), low": [0.5, 1.5],
        "time (s), high": [1.5, 2.5],
        "slide (mm), peaks": [5.0, 6.0],
        "slide (mm), peaks, low": [4.0, 4.0],
        "slide (mm), peaks, high": [8.0, 10.0],
    }


def test_points_bands_marks_and_intervals_are_all_there():
    axes = panel()
    axes.scatter([1.0, 2.0], [3.0, 4.0], label="points")
    draw_band(axes, np.array([0.0, 1.0]), np.array([1.0, 2.0]), np.array([3.0, 4.0]), label="95 %")
    axes.vlines([7.0, 8.0], [1.0, 2.0], [2.0, 3.0], label="bracket")
    axes.axhspan(0.1, 0.2, gid="interval")
    axes.axhline(9.0)
    table = {heading: list(map(float, column)) for heading, column in table_of(axes.figure).items()}
    assert table == {
        "time (s)": [1.0, 2.0],
        "slide (mm), points": [3.0, 4.0],
        "time (s), 95 %": [0.0, 1.0],
        "slide (mm), 95 %, low": [1.0, 2.0],
        "slide (mm), 95 %, high": [3.0, 4.0],
        "time (s), bracket": [7.0, 8.0],
        "slide (mm), bracket, low": [1.0, 2.0],
        "slide (mm), bracket, high": [2.0, 3.0],
        "slide (mm), interval, low": [pytest.approx(0.1)],
        "slide (mm), interval, high": [pytest.approx(0.2)],
    }


def test_a_field_gives_each_cell():
    axes = panel()
    values = np.arange(6.0).reshape(2, 3)
    axes.pcolormesh([1.0, 2.0, 3.0], [10.0, 20.0], values, shading="nearest", gid="share")
    table = table_of(axes.figure)
    assert list(table) == ["time (s)", "slide (mm)", "share"]
    assert list(zip(*table.values(), strict=True))[4] == (2.0, 20.0, 4.0)
