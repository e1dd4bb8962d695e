"""The phase portrait: what is drawn."""

import numpy as np

from colonnade.figures.closer import Phase, closer_look

TURN = np.linspace(0, 2 * np.pi, 60)
MEASURED = Phase(0.4 * np.sin(TURN), 0.3 * np.cos(TURN))
SEPARATRIX = Phase(np.array([-1.0, 0.0, 1.0]), np.array([0.0, 1.0, 0.0]))


def test_the_separatrix_has_two_branches_and_one_name():
    axes = closer_look({"measured": MEASURED, "linear": MEASURED}, SEPARATRIX, None).axes[0]
    named = [line for line in axes.lines if not line.get_label().startswith("_")]
    assert [line.get_label() for line in named] == ["measured", "linear model", "separatrix"]
    assert np.array([line.get_ydata() for line in axes.lines[-2:]]).tolist() == [[0, 1, 0], [0, -1, 0]]
