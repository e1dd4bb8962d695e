"""The canvas draws what matplotlib's own draws, and measures a text once."""

from __future__ import annotations

from io import BytesIO

import numpy as np
import pytest
from matplotlib.figure import Figure
from matplotlib.textpath import text_to_path

from colonnade.figures.files import canvas
from colonnade.figures.files.output import to_svg
from colonnade.figures.style import styled


def figure(layout=None):
    drawn = Figure(layout=layout)
    axes = drawn.subplots()
    axes.plot([0.0, 1.0], [2.0, 3.0], label="measured $x^2$")
    axes.pcolormesh(np.arange(6.0).reshape(2, 3), rasterized=True)
    axes.set_title("two\nlines")
    axes.legend()
    return drawn


@pytest.mark.parametrize("layout", [None, "constrained"], ids=["placed by hand", "laid out"])
def test_it_draws_the_same_bytes_as_matplotlibs_own(layout):
    written = []
    for backend in ("svg", canvas.BACKEND):
        stream = BytesIO()
        with styled():
            figure(layout).savefig(stream, format="svg", backend=backend, metadata={"Date": None})
        written.append(stream.getvalue())
    assert written[0] == written[1]
    assert len(written[0]) > 5000


def test_a_text_that_several_figures_show_is_measured_once(monkeypatch):
    canvas._size.cache_clear()
    measured = []
    measure = text_to_path.get_text_width_height_descent

    def noted(text, font, is_math):
        measured.append((text, font.get_size_in_points()))
        return measure(text, font, is_math)

    monkeypatch.setattr(text_to_path, "get_text_width_height_descent", noted)
    for name in ("first", "second"):
        to_svg(figure(), identity=name, title="", description="")
    assert ("0.0", 10.0) in measured
    assert len(set(measured)) == len(measured)
