"""Lean axes draw what matplotlib's own do: the same numbers at the same places, grid and marks; and make no ticks."""

from __future__ import annotations

import re

import numpy as np
import pytest
from matplotlib.figure import Figure

from colonnade.figures.files.output import to_svg
from colonnade.figures.panels.lean import LeanAxes, add_panel
from colonnade.figures.style import styled

WRITTEN = re.compile(r"<text[^>]*?(?:x=\"([-\d.]+)\" y=\"([-\d.]+)\"|translate\(([-\d.]+) ([-\d.]+)\))[^>]*>([^<]*)")


def drawn(lean: bool, shape) -> dict[str, tuple[float, float]]:
    """Where each text of a figure is, points."""
    with styled():
        figure = Figure(figsize=(4.0, 3.0))
        panel = add_panel(figure, 1.0, 0.5, 2.5, 2.0) if lean else figure.add_axes((1 / 4, 0.5 / 3, 2.5 / 4, 2 / 3))
        shape(panel)
        text = to_svg(figure, identity="one", title="", description="")
    return {said: (float(a or c), float(b or d)) for a, b, c, d, said in WRITTEN.findall(text)}


def linear(panel):
    panel.set_xlim(0.0, 7.3)
    panel.set_ylim(-0.52, 0.47)


def logarithmic(panel):
    panel.set_xscale("log")
    panel.set_xlim(0.02, 30)
    panel.set_ylim(0.0, 3.0)


def tiny(panel):
    panel.set_xlim(0, 1)
    panel.set_ylim(-3e-7, 5e-7)


@pytest.mark.parametrize("shape", [linear, tiny], ids=["linear", "with a power of ten"])
def test_the_same_numbers_are_at_the_same_places(shape):
    lean, usual = drawn(True, shape), drawn(False, shape)
    assert lean.keys() == usual.keys()
    assert len(lean) > 8
    for said, place in lean.items():
        assert place == pytest.approx(usual[said], abs=3.0), said


def test_no_tick_is_made_for_drawing():
    with styled():
        figure = Figure()
        panel = add_panel(figure, 1.0, 0.5, 2.5, 2.0)
        panel.plot([0, 1], [0, 1])
        to_svg(figure, identity="one", title="", description="")
    assert isinstance(panel, LeanAxes)
    assert (panel.xaxis.majorTicks, panel.yaxis.majorTicks) == ([], [])


def test_ticks_beyond_the_view_are_not_drawn():
    with styled():
        panel = add_panel(Figure(), 1.0, 0.5, 2.5, 2.0)
        logarithmic(panel)
        assert panel.xaxis.shown_ticks() == pytest.approx([0.1, 1.0, 10.0])


def test_labels_that_are_turned_off_are_not_drawn():
    def unlabelled(panel):
        linear(panel)
        panel.tick_params(labelleft=False)

    assert drawn(True, unlabelled).keys() == drawn(True, linear).keys() - {"−0.4", "−0.2", "0.0", "0.2", "0.4"}


def test_a_panel_is_where_it_was_asked_for():
    figure = Figure(figsize=(4.0, 3.0))
    box = add_panel(figure, 1.0, 0.5, 2.5, 2.0).get_position()
    assert np.array(box.bounds) == pytest.approx([1 / 4, 0.5 / 3, 2.5 / 4, 2 / 3])
