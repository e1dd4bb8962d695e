"""Features, end and outcome of a record."""

import numpy as np
import pytest

from colonnade.dynamics.motion import Motion
from colonnade.dynamics.rock import rock
from colonnade.identification.response.outcome import DRIFT_FACTOR, NOISE_FACTOR, angle_features, ending, judge
from prism import PRISM

ALPHA = PRISM.critical_angle
TIME = np.arange(0, 10, 0.002)
ROCKING = np.where((TIME > 2) & (TIME < 6), 0.4 * ALPHA * np.sin(2 * np.pi * (TIME - 2)), 0.0)
ERROR = 1e-4


def features(angle, **changed):
    return angle_features(
        TIME, angle, **{"error": ERROR, "block": PRISM, "rest_duration": 1.0, "catch": None} | changed
    )


def noise(size=ERROR):
    return size * np.random.default_rng(2).standard_normal(TIME.size)


def test_rocking_has_its_peak_and_an_impact_at_each_passage():
    found = features(ROCKING + noise())
    assert found.verdict.outcome == "rocking"
    np.testing.assert_allclose(found.impact_times, np.arange(2.5, 6.0, 0.5), atol=2e-3)
    assert found.peak_ratio == pytest.approx(0.4, abs=0.01)
    assert abs(found.peak_angle) == pytest.approx(0.4 * ALPHA, abs=5 * ERROR)
    assert (found.peak_time - 2.25) % 0.5 == pytest.approx(0.0, abs=0.03) or (found.peak_time - 2.25) % 0.5 > 0.47


def test_noise_alone_is_not_rocking():
    found = features(noise())
    assert found.verdict.outcome == "no-rocking"
    assert found.threshold == pytest.approx(NOISE_FACTOR * ERROR, rel=0.05)
    assert found.impact_times.size == 0


def test_a_drift_between_the_rests_raises_the_threshold_and_the_error():
    drift = 3e-3 * np.clip((TIME - 2) / 4, 0, 1)
    found = features(drift + noise())
    assert found.drift == pytest.approx(3e-3, rel=0.02)
    assert found.threshold == pytest.approx(NOISE_FACTOR * ERROR + DRIFT_FACTOR * found.drift)
    assert found.standard_error == pytest.approx(np.hypot(ERROR, found.drift / np.sqrt(3)))
    assert found.verdict.outcome == "no-rocking"


def test_a_specimen_held_tilted_at_one_end_does_not_drift():
    held = np.where(TIME < 2, 0.3 * ALPHA, 0.0)
    assert features(held + noise()).drift == 0.0


def test_after_overturning_nothing_counts():
    fallen = np.where(TIME > 5, 2.0, ROCKING)
    found = features(fallen + noise())
    assert found.verdict.outcome == "overturned"
    assert np.isnan(found.peak_ratio)
    assert found.impact_times.max() < found.verdict.overturning_time


def test_missing_samples_are_passed_over():
    broken = ROCKING + noise()
    broken[1200:1210] = np.nan
    assert features(broken).peak_ratio == pytest.approx(0.4, abs=0.01)


FALL_TIME = np.arange(0, 6, 0.002)
CATCH = 0.28


def _falls(start=2.0, catch=CATCH):
    """Angle that passes α within a fraction of a second and then lies on the frame."""
    return np.minimum(1e-3 * np.expm1(PRISM.p * np.clip(FALL_TIME - start, 0, None)), catch)


def _outcome(angle, catch=None):
    return judge(FALL_TIME[: angle.size], angle, PRISM, threshold=1e-4, catch=catch).outcome


def test_a_specimen_caught_by_its_frame_has_overturned_when_it_passed_the_critical_angle():
    verdict = judge(FALL_TIME, _falls(), PRISM, threshold=1e-4, catch=CATCH)
    assert verdict.outcome == "overturned"
    assert verdict.overturning_time == pytest.approx(2.0 + np.log1p(ALPHA / 1e-3) / PRISM.p, abs=0.005)


def test_a_frame_that_bounces_a_little_still_catches():
    angle = _falls()
    angle = np.where(angle == CATCH, CATCH * (1 + 0.03 * np.sin(40 * FALL_TIME)), angle)
    assert _outcome(-angle, CATCH) == "overturned"


@pytest.mark.parametrize("catch", [CATCH, None])
def test_a_specimen_that_was_righted_after_its_fall_has_overturned(catch):
    assert _outcome(np.where(FALL_TIME > 5, 0.0, _falls()), catch) == "overturned"


@pytest.mark.parametrize(("catch", "outcome"), [(0.8 * ALPHA, "overturned"), (None, "rocking")])
def test_a_frame_inside_the_critical_angle_is_told_by_its_plateau(catch, outcome):
    assert _outcome(_falls(catch=0.8 * ALPHA), catch) == outcome


def test_a_return_from_beyond_the_critical_angle_is_rocking():
    history = rock(
        PRISM, Motion(np.zeros(3000), 0.002), theta0=1.05 * ALPHA, omega0=-0.06 * ALPHA * PRISM.p, restitution=0.95
    )
    assert judge(history.time, history.angle, PRISM, threshold=1e-4).outcome == "rocking"


def test_a_record_that_ends_beyond_the_critical_angle_moving_outwards_has_overturned():
    falling = _falls(catch=np.inf)
    assert _outcome(falling[: int(np.argmax(falling > 1.2 * ALPHA))]) == "overturned"


def test_samples_that_are_missing_are_passed_over():
    angle = _falls()
    angle[100:200] = np.nan
    assert _outcome(angle, CATCH) == "overturned"
    assert _outcome(np.full(FALL_TIME.size, np.nan)) == "no-rocking"


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


DECAY_TIME = np.arange(0, 9, 0.002)
NOISE = 1e-4


@pytest.fixture(scope="module")
def decay():
    history = rock(PRISM, restitution=0.92, theta0=0.5 * ALPHA, duration=9.0)
    return np.interp(DECAY_TIME, history.time, history.angle)


def _ending(angle, *, base=None):
    noisy = angle + np.random.default_rng(0).normal(0, NOISE, angle.size)
    time = DECAY_TIME[: angle.size]
    verdict = judge(time, noisy, PRISM, threshold=6 * NOISE, catch=0.28)
    return ending(time, noisy, base, verdict, PRISM, error=NOISE, duration=0.5)


def test_a_block_that_comes_to_rest_upright_has_nothing_to_say(decay):
    assert _ending(decay) is None


@pytest.mark.parametrize(("share", "severity"), [(0.03, "warning"), (0.06, "serious"), (0.3, "serious")])
def test_one_that_rocks_about_and_rests_at_a_leaning_zero_says_so(share, severity, decay):
    found = _ending(decay + share * ALPHA)
    assert found.severity == severity
    assert f"is at {share:.2g} α" in found.text
    assert "its zero was taken while it leaned" in found.text


@pytest.mark.parametrize("share", [0.3, 0.66, 0.8])
def test_one_at_rest_where_no_block_rests_may_have_overturned(share):
    found = _ending(np.minimum(1e-3 * np.expm1(PRISM.p * np.clip(DECAY_TIME - 2, 0, None)), share * ALPHA))
    assert found.severity == "serious"
    assert "may have overturned" in found.text


def test_one_that_lies_on_its_frame_has_nothing_to_say():
    assert _ending(np.minimum(1e-3 * np.expm1(PRISM.p * np.clip(DECAY_TIME - 2, 0, None)), 0.28)) is None


def test_a_record_that_ends_while_the_table_shakes_is_told_and_free_decay_is_not(decay):
    cut = decay[:1000]
    found = _ending(cut, base=np.sin(20 * DECAY_TIME[:1000]))
    assert found.severity == "warning"
    assert "The record ends too early" in found.text
    stopped = np.sin(20 * DECAY_TIME[:1000]) * (DECAY_TIME[:1000] < 1)
    assert _ending(cut, base=stopped) is None
    # As of a base derived from displacement: too fast to rock the block.
    derived = np.diff(np.random.default_rng(1).normal(size=1002), 2)
    assert _ending(cut, base=stopped + 0.1 * derived) is None


def test_the_last_cycles_of_a_decay_that_is_not_over_are_about_their_zero(decay):
    assert [end for end in range(700, 2000, 25) if _ending(decay[:end]) is not None] == []


@pytest.mark.parametrize("factor", [57.3, 4.0])
def test_an_angle_that_no_block_comes_back_from_is_refused_as_such(factor, decay):
    found = _ending(factor * decay)
    assert found.kind == "impossible angle"
    assert "degrees read as radians" in found.text
