from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import pytest
from scipy.linalg import eigvalsh
from scipy.signal import butter, sosfiltfilt
from scipy.spatial.transform import Rotation

from colonnade.arrays import Array
from colonnade.dynamics.contact.elastic.assembly import ElasticBody, assemble
from colonnade.dynamics.contact.elastic.mesh import prism_mesh
from colonnade.dynamics.contact.elastic.reduction import reduce_body
from colonnade.dynamics.contact.law import ContactLaw
from colonnade.dynamics.contact.modes import keep_modes
from colonnade.dynamics.contact.simulate import simulate
from colonnade.dynamics.contact.start import Start
from colonnade.dynamics.motion import Motion
from unreduced import (
    NO_VISCOSITY,
    BulkViscosity,
    ExplicitRun,
    explicit_step,
    highest_frequency,
    quadratic_coefficients,
    run_explicit,
    stable_step,
)

PRISM = assemble(prism_mesh(0.086, 0.086, 0.456, (2, 2, 6)), 26.10)
SOFT = ContactLaw(1e11)

BAR_SIDE, BAR_LENGTH, BAR_MASS, BAR_SPEED = 0.2**0.5, 2.0, 7800 * 0.4, 1.5
BAR_LAYERS = 40
BAR = assemble(prism_mesh(BAR_SIDE, BAR_SIDE, BAR_LENGTH, (1, 1, BAR_LAYERS)), BAR_MASS, poisson_ratio=0.0)


def lumped_inertia(body: ElasticBody) -> Array:
    """Moments of the lumped masses about the three axes, kg m²; above `inertia` by a share that falls with h²."""
    squares = body.node_mass @ body.points**2
    return np.asarray(squares.sum() - squares)


def strike(viscosity: BulkViscosity, damping_fraction: float) -> ExplicitRun:
    """The bar on the wall: a contact as stiff as one element, no gravity, no friction, ν = 0."""
    law = ContactLaw(200e9 * BAR_LAYERS / BAR_LENGTH, damping_fraction=damping_fraction, friction=0.0)
    return run_explicit(
        BAR,
        law,
        Start(np.array([0.0, 0.0, BAR_LENGTH / 2]), np.array([0.0, 0.0, -BAR_SPEED])),
        duration=1.2e-3,
        gravity=0.0,
        viscosity=viscosity,
    )


def test_an_undamped_bar_leaves_the_wall_after_its_wave_has_come_back() -> None:
    # Abaqus benchmark: 2 L/c = 7.9e-4 s, 2 m v = 9360 N s, ρ c A v = 11.85 MN.
    run = strike(NO_VISCOSITY, 0.0)
    touching = run.force[:, 2] > 0.0
    assert np.ptp(run.time[touching]) == pytest.approx(7.9e-4, rel=0.04)
    assert run.step * run.force[:, 2].sum() == pytest.approx(9360.0, rel=5e-3)
    assert run.velocity[-1, 2] == pytest.approx(BAR_SPEED, rel=1e-2)
    plateau = run.force[(run.time > 1e-4) & (run.time < 7e-4), 2]
    assert plateau.mean() == pytest.approx(7800 * np.sqrt(200e9 / 7800) * 0.2 * BAR_SPEED, rel=5e-3)
    assert abs(run.residual).max() < 2e-3 * run.kinetic[0]
    assert run.contact_loss[-1] == run.bulk_loss[-1] == run.friction_loss[-1] == 0.0


@pytest.mark.parametrize(
    ("viscosity", "damping_fraction", "rebound"),
    # 40 elements of one layer, contact stiffness E/L of an element, half the stable step.
    [(BulkViscosity(), 0.0, 0.973), (BulkViscosity(0.06, 0.0), 0.0, 0.974), (BulkViscosity(), 0.03, 0.972)],
    ids=["bulk viscosity", "linear bulk viscosity", "bulk and contact damping"],
)
def test_a_damped_bar_rebounds_slower_by_what_its_ledger_says(
    viscosity: BulkViscosity, damping_fraction: float, rebound: float
) -> None:
    run = strike(viscosity, damping_fraction)
    assert run.velocity[-1, 2] / BAR_SPEED == pytest.approx(rebound, abs=2e-3)
    translation = 0.5 * BAR_MASS * run.velocity[-1, 2] ** 2
    vibration = run.kinetic[-1] - translation + run.strain[-1]
    lost = run.bulk_loss[-1] + run.contact_loss[-1]
    assert translation + vibration + lost == pytest.approx(run.kinetic[0], rel=2e-3)
    assert (run.contact_loss[-1] > 0.0) == (damping_fraction > 0.0)
    assert 0.03 < run.bulk_loss[-1] / run.kinetic[0] < 0.06


def test_a_spinning_body_keeps_its_momentum_in_free_flight() -> None:
    run = run_explicit(
        PRISM,
        SOFT,
        Start(
            np.array([0.0, 0.0, 2.0]),
            np.array([0.3, -0.2, 1.0]),
            Rotation.from_rotvec([0.4, -0.3, 1.0]).as_quat(scalar_first=True),
            np.array([8.0, 30.0, -15.0]),
        ),
        duration=5e-3,
        gravity=9.81,
        viscosity=NO_VISCOSITY,
    )
    elapsed = run.time[-1]
    assert not run.force.any()
    assert run.velocity[-1] - run.velocity[0] == pytest.approx([0.0, 0.0, -9.81 * elapsed], abs=1e-10)
    assert run.angular_momentum == pytest.approx(np.broadcast_to(run.angular_momentum[0], run.force.shape), rel=1e-5)
    assert abs(run.residual).max() < 1e-5 * run.kinetic[0]
    # The lumped masses' own inertia turns it, with no rotation put in from outside.
    spun = Rotation.from_rotvec([0.4, -0.3, 1.0]).as_matrix()
    own = spun.T @ np.array([8.0, 30.0, -15.0])
    assert spun.T @ run.angular_momentum[0] == pytest.approx(lumped_inertia(PRISM) * own, rel=1e-6)


def test_the_stable_step_is_the_meshs_and_a_longer_one_is_refused() -> None:
    squares = eigvalsh(PRISM.stiffness.toarray(), np.diag(np.repeat(PRISM.node_mass, 3)))
    frequency, _ = highest_frequency(PRISM)
    assert frequency == pytest.approx(np.sqrt(squares[-1]), rel=1e-3)
    largest = explicit_step(PRISM, SOFT, NO_VISCOSITY)
    assert largest < stable_step(frequency)
    at_rest = Start(np.array([0, 0, 0.228]))
    with pytest.raises(ValueError, match="is stable up to"):
        run_explicit(PRISM, SOFT, at_rest, duration=1e-4, gravity=9.81, step=1e-5)


@pytest.mark.parametrize(
    ("divisions", "microseconds"),
    # 2.9 µs is an independent estimate of the coarse prism; the others follow from their thinner bricks.
    [((5, 3, 16), 2.906), ((8, 6, 28), 1.819)],
    ids=["coarse", "medium"],
)
def test_steel_prisms_step_by_microseconds(divisions: tuple[int, int, int], microseconds: float) -> None:
    body: ElasticBody = assemble(prism_mesh(0.086, 0.086, 0.456, divisions), 26.10)
    assert stable_step(highest_frequency(body)[0]) * 1e6 == pytest.approx(microseconds, rel=1e-3)


@dataclass
class Impact:
    """One impact of a prism on its base, by one model: what the two are held against each other by."""

    force: Array
    impulse: Array
    energies: Array
    turn: float


def both_impacts(
    body: ElasticBody, law: ContactLaw, *, step: float, duration: float, highest: float = np.inf
) -> tuple[Impact, Impact]:
    """
    Rock a prism from θ = 0.2 mrad at −0.5 rad/s over its base to the other edge: unreduced, and reduced.

    Force sampled as means over four explicit steps and filtered at 2 kHz (zero phase, fourth order); energies over the
    kinetic one at the start: kinetic, strain, dissipated by contact and by friction. Both with the inertia of the
    lumped masses, so that nothing but the reduction (and the schemes) is compared.
    """
    angle, spin = 2e-4, np.array([0.0, -0.5, 0.0])
    rotation = Rotation.from_rotvec([0.0, angle, 0.0])
    foot = body.points[body.base]
    centre = -rotation.apply([foot[:, 0].max(), 0.0, foot[0, 2]])
    start = Start(centre, np.cross(spin, centre), rotation.as_quat(scalar_first=True), spin)
    run = run_explicit(body, law, start, duration=duration, gravity=9.81)
    interval = 4 * run.step
    count = int(duration / interval)
    grid = interval * np.arange(count + 1)
    impulses = np.vstack((np.zeros(3), np.cumsum(run.step * run.force, axis=0)))
    edges = np.append(0.0, run.time + run.step / 2)
    at_grid = np.column_stack([np.interp(grid, edges, impulses[:, axis]) for axis in range(3)])
    last = round(grid[-1] / run.step)
    scale = run.kinetic[0]
    sections = butter(4, 2000.0, fs=1 / interval, output="sos")
    energies = np.array([run.kinetic[last], run.strain[last], run.contact_loss[last], run.friction_loss[last]]) / scale
    force = sosfiltfilt(sections, np.diff(at_grid, axis=0) / interval, axis=0)
    unreduced = Impact(force, at_grid[-1], energies, float(np.arcsin(run.turn[last, 1])))

    reduced = keep_modes(replace(reduce_body(body), inertia=lumped_inertia(body)), highest)
    history = simulate(
        reduced,
        Motion(np.zeros(count + 1), interval),
        law=law,
        gravity=9.81,
        step=step,
        start=start,
    )
    balance = history.energies
    stored = [balance.kinetic, balance.strain, balance.dissipated_contact, balance.dissipated_friction]
    means = history.base_force[1:]
    return unreduced, Impact(
        sosfiltfilt(sections, means, axis=0),
        interval * means.sum(axis=0),
        np.array([values[-1] for values in stored]) / scale,
        float(history.angle[-1]),
    )


def check_agreement(unreduced: Impact, reduced: Impact, *, whole: float, force: float) -> None:
    misfit = np.linalg.norm(reduced.impulse - unreduced.impulse) / np.linalg.norm(unreduced.impulse)
    peak = abs(unreduced.force).max()
    print(f"impulse {misfit:.2e}, energies {reduced.energies - unreduced.energies}", end=", ")
    print(f"force {abs(reduced.force - unreduced.force).max() / peak:.2e}, angles {unreduced.turn} {reduced.turn}")
    assert misfit < whole
    assert reduced.energies == pytest.approx(unreduced.energies, abs=whole)
    assert abs(reduced.force - unreduced.force).max() < force * peak
    assert unreduced.turn < -1e-3
    assert reduced.turn == pytest.approx(unreduced.turn, rel=whole)


def test_the_reduced_body_strikes_its_base_as_the_unreduced_one() -> None:
    check_agreement(*both_impacts(PRISM, SOFT, step=2e-7, duration=4e-3), whole=0.002, force=0.005)


def test_the_force_of_an_impact_converges_with_the_modes_that_are_kept() -> None:
    misfits = []
    for highest in (1.0, 1e5, np.inf):
        unreduced, reduced = both_impacts(PRISM, SOFT, step=2e-7, duration=3e-3, highest=highest)
        misfits.append(abs(reduced.force - unreduced.force).max() / abs(unreduced.force).max())
    print(misfits)
    rigid, some, every = misfits
    assert rigid > 0.03
    assert 0.2 * rigid > some > 2 * every


@pytest.mark.slow
@pytest.mark.parametrize("stiffness", [1e11, 1e12], ids=["1e11 N/m³", "1e12 N/m³"])
@pytest.mark.parametrize(
    ("divisions", "whole"),
    [((5, 3, 16), 0.005), ((8, 6, 28), 0.005), ((10, 10, 55), 0.01)],
    ids=["coarse", "medium", "fine"],
)
def test_the_papers_meshes_reduced_strike_as_unreduced(
    divisions: tuple[int, int, int], whole: float, stiffness: float
) -> None:
    body = assemble(prism_mesh(0.086, 0.086, 0.456, divisions), 26.10)
    law = ContactLaw(stiffness, damping_fraction=0.4, friction=0.6)
    check_agreement(*both_impacts(body, law, step=1e-7, duration=4e-3), whole=whole, force=0.01)


def test_the_quadratic_coefficients_are_those_of_the_formula() -> None:
    bar = assemble(prism_mesh(0.1, 0.1, 1.0, (1, 1, 10)), 78.0, poisson_ratio=0.0)
    assert quadratic_coefficients(bar, BulkViscosity()) == pytest.approx(np.full(10, 7800 * 0.12**2))


@pytest.mark.parametrize("damping", [0.0, 0.06, 0.4, 1.5])
def test_a_step_just_below_the_stable_one_decays_and_one_just_above_grows(damping: float) -> None:
    def growth(step: float) -> float:
        # v⁺ = v − h (ω² x + 2 ζ ω v), x⁺ = x + h v⁺ with ω = 1.
        scheme = np.array([[1 - step**2, step * (1 - 2 * damping * step)], [-step, 1 - 2 * damping * step]])
        return float(abs(np.linalg.eigvals(scheme)).max())

    largest = stable_step(1.0, damping)
    assert growth(0.999 * largest) <= 1 + 1e-9
    assert growth(1.001 * largest) > 1 + 1e-4


def test_negative_viscosity_is_refused() -> None:
    with pytest.raises(ValueError, match="numbers from 0 on were expected"):
        BulkViscosity(linear=-0.1)
