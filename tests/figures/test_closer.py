"""Phase portrait and enlarged part: what is drawn, and that cycles on each other are one line."""

import numpy as np

from colonnade.figures.closer import Enlarged, Phase, closer_look
from colonnade.figures.panels.curve import Curve

TURN = np.linspace(0, 2 * np.pi, 60)
MEASURED = Phase(0.4 * np.sin(TURN), 0.3 * np.cos(TURN))
SEPARATRIX = Phase(np.array([-1.0, 0.0, 1.0]), np.array([0.0, 1.0, 0.0]))


def test_the_separatrix_has_two_branches_and_one_name():
    axes = closer_look(MEASURED, {"linear": MEASURED}, SEPARATRIX, None).axes[0]
    named = [line for line in axes.lines if not line.get_label().startswith("_")]
    assert [line.get_label() for line in named] == ["measured", "linear model", "separatrix"]
    assert np.array([line.get_ydata() for line in axes.lines[-2:]]).tolist() == [[0, 1, 0], [0, -1, 0]]


def test_cycles_on_each_other_are_one_line_with_gaps():
    cycle = Curve(TURN, np.sin(TURN))
    axes = closer_look(MEASURED, {}, SEPARATRIX, Enlarged("phase", [cycle] * 6, {"linear": []}, "last")).axes[1]
    assert len(axes.lines) == 1
    assert np.isnan(axes.lines[0].get_xdata()).sum() == 6
    assert axes.texts[0].get_text() == "last"
