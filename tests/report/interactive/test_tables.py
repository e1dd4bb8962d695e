"""Tables of the pictures of a page."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from colonnade.figures.files.output import Picture
from colonnade.report.interactive import panels
from colonnade.report.interactive.panels import Samples
from colonnade.report.interactive.tables import LONG, tables_of


def picture(count: int) -> Picture:
    figure = Figure()
    axes = figure.subplots()
    time = 0.01 * np.arange(count)
    axes.plot(time, np.sin(time), label="measured")
    axes.set_xlabel("time (s)")
    axes.set_ylabel("slide (mm)")
    return Picture(figure, f"p-{count}", "", "")


def test_a_short_table_is_text():
    _, tables = tables_of([picture(2)], Samples())
    assert tables == {"p-2": 'time (s),"slide (mm), measured"\n0,0\n0.01,0.00999983333\n'}


def test_a_long_table_names_series_that_the_page_has_already():
    samples = Samples()
    time = 0.01 * np.arange(LONG)
    curve = samples.curve("measured", time, np.sin(time))
    samples, tables = tables_of([picture(LONG)], samples)
    table = tables[f"p-{LONG}"]
    assert table["heads"] == ["time (s)", "slide (mm), measured"]
    assert table["columns"] == [{"clock": curve["clock"]}, {"series": curve["values"]}]
    assert len(samples.series) == 1


def test_a_page_without_pictures_has_no_table():
    assert tables_of([], Samples())[1] == {}


def test_a_table_that_is_too_long_for_a_page_is_left_out(monkeypatch):
    monkeypatch.setattr(panels, "MOST", LONG - 1)
    samples, tables = tables_of([picture(LONG), picture(2)], Samples())
    assert (list(tables), samples.series) == (["p-2"], [])
