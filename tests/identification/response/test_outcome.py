import numpy as np
import pytest

from colonnade.dynamics.motion import Motion
from colonnade.dynamics.rock import rock
from colonnade.identification.response.outcome import judge
from prism import PRISM

ALPHA = PRISM.critical_angle
TIME = np.arange(0, 6, 0.002)
CATCH = 0.28


def _falls(start=2.0, catch=CATCH):
    """Angle that passes α within a fraction of a second and then lies on the frame."""
    return np.minimum(1e-3 * np.expm1(PRISM.p * np.clip(TIME - start, 0, None)), catch)


def test_a_quiet_record_has_not_rocked():
    noise = np.random.default_rng(0).normal(0, 1e-5, TIME.size)
    assert judge(TIME, noise, PRISM, threshold=1e-4).outcome == "no-rocking"


def test_a_specimen_caught_by_its_frame_has_overturned_when_it_passed_the_critical_angle():
    verdict = judge(TIME, _falls(), PRISM, threshold=1e-4, catch=CATCH)
    assert verdict.outcome == "overturned"
    assert verdict.overturning_time == pytest.approx(2.0 + np.log1p(ALPHA / 1e-3) / PRISM.p, abs=0.005)


def test_a_frame_that_bounces_a_little_still_catches():
    angle = _falls()
    angle = np.where(angle == CATCH, CATCH * (1 + 0.03 * np.sin(40 * TIME)), angle)
    assert judge(TIME, -angle, PRISM, threshold=1e-4, catch=CATCH).outcome == "overturned"


def test_a_specimen_that_was_righted_after_its_fall_has_overturned():
    angle = np.where(TIME > 5, 0.0, _falls())
    assert judge(TIME, angle, PRISM, threshold=1e-4, catch=CATCH).outcome == "overturned"
    assert judge(TIME, angle, PRISM, threshold=1e-4).outcome == "overturned"


def test_a_frame_inside_the_critical_angle_is_told_by_its_plateau():
    angle = _falls(catch=0.8 * ALPHA)
    assert judge(TIME, angle, PRISM, threshold=1e-4, catch=0.8 * ALPHA).outcome == "overturned"
    assert judge(TIME, angle, PRISM, threshold=1e-4).outcome == "rocking"


def test_a_return_from_beyond_the_critical_angle_is_rocking():
    history = rock(
        PRISM, Motion(np.zeros(3000), 0.002), theta0=1.05 * ALPHA, omega0=-0.06 * ALPHA * PRISM.p, restitution=0.95
    )
    assert judge(history.time, history.angle, PRISM, threshold=1e-4).outcome == "rocking"


def test_a_record_that_ends_beyond_the_critical_angle_moving_outwards_has_overturned():
    falling = _falls(catch=np.inf)
    end = int(np.argmax(falling > 1.2 * ALPHA))
    assert judge(TIME[:end], falling[:end], PRISM, threshold=1e-4).outcome == "overturned"


def test_samples_that_are_missing_are_passed_over():
    angle = _falls()
    angle[100:200] = np.nan
    assert judge(TIME, angle, PRISM, threshold=1e-4, catch=CATCH).outcome == "overturned"
    assert judge(TIME, np.full(TIME.size, np.nan), PRISM, threshold=1e-4).outcome == "no-rocking"


@pytest.mark.parametrize("share", [0.5, 0.7, 0.9])
@pytest.mark.parametrize("excess", [-0.05, 0.05])
def test_a_record_that_ends_in_motion_is_continued_on_a_table_at_rest(share, excess):
    # The model continues it: outwards it passes α if ω > p (α − θ).
    velocity = (1 + excess) * PRISM.p * (1 - share) * ALPHA
    time = np.arange(-0.1, 0.0005, 0.001)
    back = (share - 1) * ALPHA
    angle = ALPHA + back * np.cosh(PRISM.p * time) + velocity / PRISM.p * np.sinh(PRISM.p * time)
    on = rock(
        PRISM, Motion(np.zeros(4000), 0.002), theta0=share * ALPHA, omega0=velocity, restitution=0.5, model="linear"
    )
    assert on.outcome == ("overturned" if excess > 0 else "rocking")
    assert judge(time, angle, PRISM, threshold=1e-4).outcome == on.outcome
