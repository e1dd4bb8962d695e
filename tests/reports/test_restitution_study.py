"""The study of the identified e: its records, the bound, its judgement, and what its page says."""

import numpy as np
import pytest

import restitution_study
from monte_carlo.design import Kind, draw, kinds
from monte_carlo.new_test import NewTest

PLAIN = Kind("plain", 0.0, 0.0)


def test_arcs_of_the_truth_join_at_their_impacts_and_lose_e_squared():
    for number in range(6):
        rocking = draw(PLAIN, 1, number).rocking
        impacts, e, turning = rocking.course()
        assert np.abs(rocking.angle(impacts - 1e-9)).max() < 1e-6
        assert np.abs(rocking.angle(impacts + 1e-9)).max() < 1e-6
        sides = (int(rocking.release_angle > 0) + np.arange(turning.size)) % 2
        fallen = np.sin(np.array(rocking.critical_angle)[sides] / 2) ** 2 - turning
        energy = np.array(rocking.p)[sides] ** 2 * fallen
        np.testing.assert_allclose(energy[1:] / energy[:-1], e**2, rtol=1e-9)


def test_the_truth_obeys_the_equation_of_motion():
    rocking = draw(Kind("prism", 0.0, 0.0, {"shape": "prism"}), 1, 3).rocking
    impacts, _, _ = rocking.course()
    time, step = np.linspace(impacts[1], impacts[2], 9)[1:-1], 1e-4
    angle = rocking.angle(time)
    second = (rocking.angle(time + step) - 2 * angle + rocking.angle(time - step)) / step**2
    alpha, p = rocking.critical_angle[0], rocking.p[0]
    np.testing.assert_allclose(second, -(p**2) * np.sin(alpha * np.sign(angle) - angle), rtol=1e-4)


def test_a_kind_that_holds_e_too_seldom_is_complained_of():
    trials = [restitution_study.Trial(0.95, 0.949, 0.951, 0.95, 5e-4, 9, "")] * 90
    off = [restitution_study.Trial(0.95, 0.949, 0.951, 0.96, 5e-4, 9, "")] * 30
    assert restitution_study.judge("sound", trials + off[:5]).complaint == ""
    assert restitution_study.judge("wrong", trials + off).complaint == "holds e too seldom"


def test_the_stored_study_is_of_all_kinds(found):
    assert {each["name"] for each in found["kinds"]} == {kind.name for kind in kinds()}
    assert all(NewTest(**each).campaigns > 0 for each in found["new_test"])


def test_an_e_that_changes_with_the_speed_is_not_taken_for_a_low_pass():
    """Records whose first history, with one e, is off so smoothly that a filter seemed to have passed them."""
    kind = next(each for each in kinds() if each.name == "e changes with speed")
    seed = restitution_study.SEED + kinds().index(kind)
    for number in (111, 136):
        found = restitution_study.run(kind, seed, number)
        assert found.value == pytest.approx(found.truth, abs=2e-4)
        assert found.high - found.low < 1e-3
