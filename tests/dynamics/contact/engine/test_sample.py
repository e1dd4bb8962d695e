"""A row of the result holds the state and the energies that belong to it."""

from __future__ import annotations

import numpy as np
import pytest

from colonnade.dynamics.contact.engine import sample
from colonnade.dynamics.contact.engine.state import COLUMNS


def row_of(made):
    row = np.zeros(COLUMNS)
    sample.fill_sample(*made, row)
    return row


def test_the_state_is_in_it(engine):
    row = row_of(engine(velocity=(1.0, 2.0, 3.0), spin=(0.4, 0.5, 0.6)))
    np.testing.assert_allclose(row[:10], [0, 0, 1, 1, 2, 3, 1, 0, 0, 0])
    np.testing.assert_allclose(row[10:13], [0.4, 0.5, 0.6])
    assert not row[14:17].any()


def test_the_energies_are_those_of_the_formulas(engine):
    made = engine(velocity=(1.0, 2.0, 3.0), spin=(0.4, 0.5, 0.6), sunk=0.02, frequency=7.0)
    made.state.strain[:, 0] = 0.0, 0.3
    made.state.slip[1], made.state.touched[1] = (0.01, 0.02), 1
    made.state.slip[2] = 1.0, 1.0  # of a corner that is off the table
    turning = 0.5 * np.array([2.0, 3.0, 0.5]) @ np.array([0.4, 0.5, 0.6]) ** 2
    row = row_of(made)
    assert row[17] == pytest.approx(0.5 * 8.0 * 14.0 + turning + 0.5 * 0.3**2)
    assert row[18] == pytest.approx(8.0 * 10.0 * 0.98)
    assert row[20] == pytest.approx(4 * 0.5 * 1000.0 * 0.02**2 + 0.5 * 400.0 * (0.01**2 + 0.02**2))
    assert row[13] == pytest.approx(-0.02)


def test_a_strained_mode_holds_energy_and_lifts_the_base(engine):
    made = engine(frequency=7.0)
    made.state.strain[0, 0] = 0.2
    row = row_of(made)
    assert row[19] == pytest.approx(0.5 * (7.0 * 0.2) ** 2)
    assert row[13] == pytest.approx(0.25 * 0.2)
    assert row[20] == 0.0
