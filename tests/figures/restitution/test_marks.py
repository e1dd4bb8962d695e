"""Marks of what was measured: those used are filled, those left out are open, each with its bar."""

from __future__ import annotations

import numpy as np
from matplotlib.colors import to_hex
from matplotlib.container import ErrorbarContainer
from matplotlib.figure import Figure

from colonnade.figures.restitution.marks import draw_marks

X, Y = np.arange(4.0), np.arange(4.0) + 10.0
ALL = np.ones(4, dtype=bool)
LABELS = ("used", "left out")


def drawn(bars, shown=ALL, used=ALL):
    axes = Figure().subplots()
    draw_marks(axes, X, Y, bars, shown, used, LABELS, mark="s")
    return [each for each in axes.containers if isinstance(each, ErrorbarContainer)]


def ends(container):
    (bars,) = container.lines[2]
    return [tuple(segment[:, 1]) for segment in bars.get_segments()]


def test_bars_go_as_far_down_and_up_as_they_say():
    (both,) = drawn(np.array([[1.0, 2.0, 3.0, 4.0], [0.1, 0.2, 0.3, 0.4]]))
    assert ends(both) == [(9.0, 10.1), (9.0, 11.2), (9.0, 12.3), (9.0, 13.4)]
    (even,) = drawn(np.full(4, 0.5))
    assert ends(even)[0] == (9.5, 10.5)


def test_an_unknown_error_has_no_bar():
    (container,) = drawn(np.array([np.nan, 1.0, 1.0, 1.0]))
    assert ends(container)[0] == (10.0, 10.0)


def test_the_two_kinds_have_their_own_face_and_label():
    used = np.array([True, True, False, False])
    first, second = drawn(np.zeros(4), used=used)
    assert [first.get_label(), second.get_label()] == list(LABELS)
    assert list(first.lines[0].get_xdata()) == [0.0, 1.0]
    assert to_hex(second.lines[0].get_markerfacecolor()) == "#ffffff"
    assert first.lines[0].get_markerfacecolor() != "white"
    assert {each.lines[0].get_marker() for each in (first, second)} == {"s"}


def test_what_is_not_shown_is_not_there():
    assert drawn(np.zeros(4), shown=~ALL) == []
    (container,) = drawn(np.zeros(4), shown=X > 2)
    assert list(container.lines[0].get_xdata()) == [3.0]
