"""The contact model beside the analytical one with its own restitution, and its outcomes and refusals."""

import numpy as np
import pytest

from colonnade.dynamics.block import Block
from colonnade.dynamics.contact.body import ContactBody, ContactLaw, rigid_body
from colonnade.dynamics.contact.simulate import simulate
from colonnade.dynamics.contact.start import Start
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.rock import rock
from on_contact import peaks
from prism import PRISM

GRAVITY = 9.81
SLENDER = Block.prism(width=0.1, depth=0.1, height=1.0, mass=20.0)
ALPHA = PRISM.critical_angle
REST = Motion(np.zeros(3), 0.01)


@pytest.mark.parametrize("released", [0.3, 0.6])
@pytest.mark.parametrize("block", [SLENDER, PRISM], ids=["slenderness 10", "prism of the paper"])
def test_free_rocking_is_the_analytical_one_with_the_runs_own_restitution(block, released):
    """Two edges of nodes and strong damping: the block does not bounce."""
    body = rigid_body(block, grid=2)
    law = ContactLaw(damping_fraction=2.0, friction=2.0, penetration=1e-6).bearing(body, GRAVITY)
    theta0 = released * block.critical_angle
    history = simulate(body, law=law, theta0=theta0, duration=11.0 / block.p)
    own = history.impact_restitution
    assert (history.base_force[1:, 2] > 0.0).all()
    assert own.size >= 3
    assert np.ptp(own) < 1e-3
    analytical = rock(block, model="nonlinear", restitution=float(own.mean()), theta0=theta0, duration=11.0 / block.p)
    found, expected = peaks(history.angle), peaks(analytical.angle)
    assert found.size == expected.size >= 3
    np.testing.assert_allclose(found, expected, rtol=5e-3)
    # Two edges without bounce: the rigid-body value.
    np.testing.assert_allclose(own, block.restitution, atol=1e-3)


def test_forced_rocking_is_the_analytical_one_with_the_runs_own_restitution():
    body = rigid_body(PRISM, grid=2)
    law = ContactLaw(damping_fraction=2.0, friction=2.0, penetration=3e-7).bearing(body, GRAVITY)
    time = np.arange(301) * 0.005
    base = np.where(time < 1.0, 1.6 * PRISM.uplift_acceleration * np.sin(2 * np.pi * 3.0 * time), 0.0)
    history = simulate(body, Motion(base, 0.005), law=law)
    own = float(np.median(history.impact_restitution[:4]))
    analytical = rock(PRISM, Motion(base, 0.005), model="nonlinear", restitution=own)
    found, expected = peaks(history.angle), peaks(analytical.angle)
    assert found.size >= 3
    np.testing.assert_allclose(found[:4], expected[:4], rtol=5e-3)


def test_the_mirror_image_of_a_motion_gives_the_mirror_image():
    body = rigid_body(PRISM)
    law = ContactLaw().bearing(body, GRAVITY)
    base = 2.5 * np.sin(2 * np.pi * 2.5 * np.arange(101) * 0.005)
    there, back = (simulate(body, Motion(sign * base, 0.005), law=law) for sign in (1.0, -1.0))
    assert np.abs(there.angle).max() > 0.05 * ALPHA
    np.testing.assert_allclose(there.angle, -back.angle, atol=1e-9 * ALPHA)


def test_shaking_across_rocks_a_square_block_as_shaking_along_does():
    body = rigid_body(PRISM)
    law = ContactLaw().bearing(body, GRAVITY)
    base = 2.5 * np.sin(2 * np.pi * 2.5 * np.arange(81) * 0.005)
    along = simulate(body, Motion(base, 0.005), law=law)
    across = simulate(body, Motion(np.zeros(81), 0.005, transverse=base), law=law)
    # A right-handed turn about x takes the top to −y.
    np.testing.assert_allclose(across.out_of_plane_angle, -along.angle, atol=1e-9 * ALPHA)
    np.testing.assert_allclose(across.angle, 0.0, atol=1e-9 * ALPHA)


@pytest.mark.parametrize(
    ("theta0", "duration", "outcome"),
    [(0.97, 0.8, "rocking"), (1.03, 1.5, "overturned"), (-1.03, 1.5, "overturned"), (0.0, 0.2, "no-rocking")],
)
def test_outcomes(theta0, duration, outcome):
    history = rock(PRISM, model="contact", theta0=theta0 * ALPHA, duration=duration)
    assert history.outcome == outcome
    if outcome == "overturned":
        assert history.overturning_time == 0.0
        assert history.angle[-1] == pytest.approx(np.copysign(np.pi / 2, theta0))
        assert history.peak_ratio is None
        assert history.time.size == history.angle.size == history.uplift.size


def test_a_block_past_its_critical_angle_at_the_end_is_followed_until_it_falls():
    history = rock(PRISM, model="contact", theta0=1.02 * ALPHA, duration=0.05)
    assert history.outcome == "overturned"
    assert abs(history.angle[-1]) < 1.2 * ALPHA


@pytest.mark.parametrize("angles", [(0.1, 0.05), (-0.2, 0.1), (0.0, 0.0)], ids=["tilted", "other way", "upright"])
def test_a_body_starts_where_it_was_put(angles):
    body = rigid_body(PRISM)
    law = ContactLaw().bearing(body, GRAVITY)
    history = simulate(body, REST, law=law, theta0=angles[0], out_of_plane=angles[1], step=2e-5)
    assert history.angle[0] == pytest.approx(angles[0], abs=1e-12)
    assert history.out_of_plane_angle[0] == pytest.approx(angles[1], abs=1e-12)
    assert history.yaw[0] == pytest.approx(0.0, abs=0.02)
    assert -1e-4 < history.uplift[0] < 0.0


def test_a_mode_rings_at_its_frequency_and_fades_as_damped():
    """A body in free flight whose only mode was struck by the landing before it: exact propagation."""
    body = rigid_body(PRISM, grid=2)
    modes = np.zeros((4, 3, 1))
    modes[:, 2, 0] = 0.1
    soft = ContactBody(**{**vars(body), "modes": modes, "frequencies": np.array([2000.0]),
                          "modal_damping": np.array([0.02])})  # fmt: skip
    law = ContactLaw(damping_fraction=0.1, penetration=1e-6).bearing(body, GRAVITY)
    start = Start(np.array([0.0, 0.0, soft.height + 1e-6]), np.array([0.0, 0.0, -0.05]))
    history = simulate(soft, Motion(np.zeros(401), 1e-5), law=law, step=1e-6, start=start)
    assert history.energies.relative_residual < 1e-4
    assert history.energies.strain.max() > 0.0
    flying = history.base_force[:, 2] == 0.0
    last = np.flatnonzero(~flying)[-1] + 2
    strain = history.energies.strain[last:]
    peaks = last + 1 + np.flatnonzero((strain[1:-1] > strain[:-2]) & (strain[1:-1] >= strain[2:]))
    # Strain energy peaks twice a period and fades by exp(−2 ζ ω t).
    assert np.diff(history.time[peaks]).mean() == pytest.approx(np.pi / 2000.0, rel=0.02)
    fading = np.log(history.energies.strain[peaks[-1]] / history.energies.strain[peaks[0]])
    elapsed = history.time[peaks[-1]] - history.time[peaks[0]]
    assert fading == pytest.approx(-2 * 0.02 * 2000.0 * elapsed, rel=0.05)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"step": 1e-3}, r"step is 0\.001 s; at most 2\.62e-05 s was expected"),
        ({"step": 0.0}, "step is 0.0; a positive step in s"),
        ({"motion": None}, "duration is None; without a motion"),
    ],
    ids=lambda value: next(iter(value)) if isinstance(value, dict) else "",
)
def test_arguments_out_of_range_are_refused(arguments, message):
    body = rigid_body(PRISM)
    law = ContactLaw().bearing(body, GRAVITY)
    given = {"motion": Motion(np.zeros(3), 0.02), "law": law, **arguments}
    with pytest.raises(ValueError, match=message):
        simulate(body, given.pop("motion"), **given)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"model": "contact", "restitution": 0.9}, "Do not give `restitution` to the contact model"),
        ({"model": "linear", "out_of_plane": 0.01}, 'contact and out_of_plane are for model="contact"'),
    ],
    ids=["restitution", "out of plane"],
)
def test_rock_refuses_what_a_model_cannot_take(arguments, message):
    with pytest.raises(ValueError, match=message):
        rock(PRISM, REST, **arguments)


@pytest.mark.parametrize(("frequency", "amplitude"), [(4.0, 0.97), (5.0, 0.95), (7.0, 0.99), (4.0, 1.02)])
def test_an_undisturbed_block_begins_to_rock_at_the_uplift_acceleration(frequency, amplitude):
    """On springs ten times as soft the lean of the standing block is enough to rock from A = 0.93 to 0.97 on."""
    body = rigid_body(PRISM)
    law = ContactLaw(damping_fraction=0.155).bearing(body, GRAVITY)
    time = np.arange(1501) / (100 * frequency)
    base = amplitude * PRISM.uplift_acceleration * np.sin(2 * np.pi * frequency * time)
    history = simulate(body, Motion(base, time[1]), law=law, step=1e-5)
    rocks = history.peak_ratio > 0.05
    assert rocks == (amplitude > 1.0)
    if not rocks:
        assert history.peak_ratio < 1e-3
        assert history.outcome == "no-rocking"
