"""The study of forecasts: what its numbers promise, and that it gives them again."""

import numpy as np
import pytest

import forecast_study
from colonnade.dynamics.block import Block
from colonnade.identification.calibration import randomised_pit
from forecast_study import MAIN, page
from forecast_trial import WRONG, draw_motion, draw_specimen, run_campaign
from study import HERE


def check_promises(judged):
    """Reliability and coverage are within what chance allows; a wrong e is found both ways by the main score."""
    shown, bands = judged["reliability"]["identified"], judged["coverage"]["identified"]
    for low, frequency, high in zip(shown["low"], shown["frequency"], shown["high"], strict=True):
        assert low <= frequency <= high
    for low, share, high in zip(bands["low"], bands["share"], bands["high"], strict=True):
        assert low <= share <= high
    for name in ("too high", "too low"):
        assert judged["difference"][name][MAIN]["low"] > 0.0
    assert min(judged["skill"][name][MAIN] for name in ("rigid", "base rate")) > 0.0


def test_the_stored_study_keeps_its_promises(found):
    assert (found["campaigns"] >= 20, found["judged"]["tests"]["count"] >= 200, WRONG) == (True, True, 0.01)
    check_promises(found["judged"])


def test_its_page_is_made_from_its_numbers(found):
    assert (HERE / "forecast-study.md").read_text(encoding="utf-8") == page(found, "forecast-study.svg")
    assert (HERE / "forecast-study.svg").read_text(encoding="utf-8").startswith("<svg")


def test_its_first_tests_come_out_as_stored(found):
    campaign = run_campaign(found["seed"], 0, 2, found["members"])
    for name, values in found["judged"]["pit"].items():
        pit = randomised_pit(
            [test.forecasts[name] for test in campaign.tests], [test.observed for test in campaign.tests]
        )
        np.testing.assert_allclose(pit, values[:2], atol=2.5 / found["members"])


@pytest.mark.whole
def test_a_small_study_finds_skill_over_the_base_rate_and_writes_its_page(tmp_path):
    found = forecast_study.study(6, 7, 1, tests=2, members=10)
    assert found["judged"]["tests"]["count"] == sum(found["judged"]["tests"]["outcomes"]) == 12
    assert found["judged"]["skill"]["base rate"][MAIN] > 0.3
    forecast_study.STUDY.write(found, tmp_path)
    assert "12 tests:" in (tmp_path / "forecast-study.md").read_text(encoding="utf-8")
    assert "6 virtual campaigns with 2 tests each" in (tmp_path / "forecast-study.md").read_text(encoding="utf-8")


def test_e_is_identified_to_its_own_interval_of_the_truth():
    specimen = draw_specimen(np.random.default_rng(3))
    half = (specimen.identified.high - specimen.identified.low) / 2
    assert abs(specimen.identified.value - specimen.true_restitution) < 2 * half < 0.05


@pytest.mark.parametrize("kind", ["sine", "earthquake", "El Centro"])
def test_motions_have_a_largest_acceleration_of_one_and_begin_at_rest(kind):
    block = Block.prism(width=0.1, depth=0.1, height=0.6, mass=100.0)
    motion = draw_motion(kind, block, np.random.default_rng(1))
    assert motion.peak == pytest.approx(1.0)
    assert np.abs(motion.acceleration[:90]).max() < 0.01


@pytest.mark.slow
def test_the_whole_study_gives_its_numbers_again(found):
    again = forecast_study.study(found["campaigns"], found["seed"], forecast_study.WORKERS)
    check_promises(again["judged"])
    for name, row in found["judged"]["scores"].items():
        assert again["judged"]["scores"][name] == pytest.approx(row, abs=0.01)
