"""Without contact a body falls on its parabola, turns with its angular momentum kept, and its modes swing."""

import numpy as np
import pytest

from colonnade.dynamics.contact.engine import flight

STEP = 0.01
PULL = np.array([0.7, -0.4, 0.0])


def test_it_falls_on_its_parabola_and_the_table_is_paid_for_what_it_does(engine):
    body, state, _ = engine(velocity=(0.3, 0.0, 2.0))
    for _ in range(50):
        flight.drift(body, state, PULL, STEP)
    time = 50 * STEP
    acceleration = PULL - [0.0, 0.0, body.gravity]
    moved = np.array([0.3, 0.0, 2.0]) * time + 0.5 * acceleration * time**2
    np.testing.assert_allclose(state.rigid[:3], np.add(moved, [0.0, 0.0, body.height]), rtol=1e-12)
    np.testing.assert_allclose(state.rigid[3:6], [0.3, 0.0, 2.0] + acceleration * time, rtol=1e-12)
    assert state.ledger[0] == pytest.approx(body.mass * PULL @ moved, rel=1e-12)


@pytest.mark.parametrize("axis", [0, 1, 2])
def test_about_a_principal_axis_it_turns_evenly(engine, axis):
    spin = np.zeros(3)
    spin[axis] = 3.0
    body, state, _ = engine(spin=spin)
    for _ in range(40):
        flight.drift(body, state, np.zeros(3), STEP)
    half = 0.5 * 3.0 * 40 * STEP
    expected = np.zeros(4)
    expected[0], expected[1 + axis] = np.cos(half), np.sin(half)
    np.testing.assert_allclose(state.rigid[6:10], expected, atol=1e-14)


def test_the_angular_momentum_stays_in_space_however_it_tumbles(engine):
    body, state, _ = engine(spin=(2.0, -5.0, 3.0))
    before = state.matrix @ state.rigid[10:13]
    for _ in range(200):
        flight.drift(body, state, np.zeros(3), STEP)
    assert np.abs(state.matrix - np.eye(3)).max() > 0.5
    np.testing.assert_allclose(state.matrix @ state.rigid[10:13], before, rtol=1e-12)
    np.testing.assert_allclose(state.matrix @ state.matrix.T, np.eye(3), atol=1e-14)


def test_its_energy_errs_by_the_square_of_the_step(engine):
    errors = []
    for step in (0.02, 0.01):
        body, state, _ = engine(spin=(2.0, -5.0, 3.0))
        energies = [(state.rigid[10:13] ** 2 / body.inertia).sum()]
        for _ in range(round(1.0 / step)):
            flight.drift(body, state, np.zeros(3), step)
            energies.append((state.rigid[10:13] ** 2 / body.inertia).sum())
        errors.append(np.ptp(energies) / energies[0])
    assert errors[0] == pytest.approx(4.0 * errors[1], rel=0.1)
    assert 0.0 < errors[0] < 1e-2


@pytest.mark.parametrize("kept", [1.0, 0.9], ids=["undamped", "damped"])
def test_a_mode_swings_and_what_it_loses_is_booked(engine, kept):
    frequency = 40.0
    cosine, sine = np.cos(frequency * STEP), np.sin(frequency * STEP)
    turn = [kept * cosine, kept * sine / frequency, -kept * sine * frequency, kept * cosine]
    body, state, _ = engine(frequency=frequency, propagators=turn)
    state.strain[:, 0] = 2.0, 0.0
    flight.drift(body, state, np.zeros(3), STEP)
    np.testing.assert_allclose(state.strain[:, 0], [2.0 * kept * cosine, -2.0 * kept * sine * frequency])
    assert state.ledger[3] == pytest.approx(0.5 * (2.0 * frequency) ** 2 * (1.0 - kept**2), abs=1e-9)
