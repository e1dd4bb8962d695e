"""A short study gives what the whole one is held to, on a truth in closed form; the whole one is within its goals."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import least_squares

import restitution_study
from colonnade.dynamics.block import Block
from colonnade.laboratory.truth import simulate
from monte_carlo.bound import cramer_rao_error
from monte_carlo.design import draw, pink_noise
from monte_carlo.integration import integrated_angle
from monte_carlo.naive import naive_restitution
from monte_carlo.page import WORDS, page
from monte_carlo.truth import FreeRocking
from study import HERE

FACTORS = ("restitution", "slenderness", "height", "release", "rate", "noise", "offset", "impacts", "low-pass")


@pytest.fixture(scope="module")
def short():
    """Numbers of sixty records, of six beyond the design, and of three of each kind that is not as assumed."""
    return restitution_study.numbers(restitution_study.run_trials(60, 7, 1), 7)


@pytest.mark.whole
def test_a_short_study_keeps_the_goals_as_far_as_sixty_records_can_tell(short):
    everything = short["levels"][0]
    assert everything["records"] == 60
    assert everything["refused"] <= 0.05
    assert abs(everything["bias"]) < 1e-4
    assert everything["coverage"] >= 0.85
    assert everything["width"] < 2 * everything["best_width"]
    assert everything["margin"] > 10
    steady = next(each for each in short["levels"] if (each["factor"], each["level"]) == ("scatter", "0"))
    assert abs(steady["bias"]) < 1e-4
    assert steady["margin"] > 10


@pytest.mark.whole
def test_the_short_studys_page_names_what_misses_a_goal(short):
    text = page(short, "figure.svg")
    assert "| scatter of e | 0.002–0.005 |" in text
    assert "Goals that are missed" in text or "No goal is missed." in text


def test_the_mean_e_is_that_of_all_impacts_and_each_record_has_its_own():
    drawn = replace(draw(5, 1), scatter=0.004, restitution=0.9)
    own = drawn.restitutions()
    np.testing.assert_array_equal(own, drawn.restitutions())
    assert own.std() == pytest.approx(0.004, rel=0.15)
    assert own.mean() == pytest.approx(0.9, abs=4 * 0.004 / 20)
    _, impacts, used = drawn.motion(drawn.clock())
    np.testing.assert_array_equal(used, own[: used.size])
    assert impacts.size == used.size


def test_e_that_depends_on_the_speed_changes_by_what_the_page_says():
    for number in range(40):
        drawn = replace(restitution_study.changing(draw(5, number)), scatter=0.0)
        _, _, used = drawn.motion(drawn.clock())
        # The last impacts of a block that hardly loses anything are more than the mean e has in the same time.
        assert np.ptp(used) == pytest.approx(abs(restitution_study.BY_SPEED), rel=0.25), number
        assert used.mean() == pytest.approx(drawn.restitution, abs=0.007)
        assert used.max() < 1


def test_pink_noise_has_its_power_and_its_variance():
    random = np.random.default_rng(1)
    noise = [pink_noise(2000, random) for _ in range(200)]
    assert np.mean(np.square(noise)) == pytest.approx(1, rel=0.1)
    power = np.mean([np.abs(np.fft.rfft(each * np.hanning(2000))) ** 2 for each in noise], axis=0)
    assert power[10:20].mean() / power[100:200].mean() == pytest.approx(10, rel=0.25)


def test_a_records_draw_is_the_same_however_many_are_drawn():
    first, again = draw(3, 17), draw(3, 17)
    assert first == again
    np.testing.assert_array_equal(first.record()[1], again.record()[1])
    assert draw(3, 18) != first


def test_records_have_the_impacts_that_were_asked_for_or_end_at_rest():
    for number in range(40):
        drawn = draw(11, number)
        time = drawn.clock()
        impacts = drawn.rocking.impact_times()
        # The record ends at most two samples before the instant that was drawn.
        fewest, most = ((impacts < time[-1] + late).sum() for late in (0.0, 2 / drawn.rate))
        angle = drawn.rocking.angle(time) - drawn.rocking.zero_offset
        assert most >= drawn.impacts or np.abs(angle[-1]) < 1e-6 * drawn.rocking.critical_angle
        assert fewest <= drawn.impacts or np.abs(angle[-1]) < 1e-6 * drawn.rocking.critical_angle


@pytest.mark.parametrize("number", [0, 5])
def test_the_bound_is_reached_by_least_squares_with_the_truths_own_model(number):
    drawn = replace(draw(21, number), filtered=False, rate=200.0, noise=1e-3, impacts=12, scatter=0.0, pink=0.0)
    truth = drawn.rocking
    start = np.array([truth.restitution, truth.release_angle, truth.release_time, truth.zero_offset])
    names = ("restitution", "release_angle", "release_time", "zero_offset")
    estimates = []
    for seed in range(40):
        time, angle = replace(drawn, seed=(99, seed)).record()
        fit = least_squares(
            lambda x, time=time, angle=angle: replace(truth, **dict(zip(names, x, strict=True))).angle(time) - angle,
            start,
            x_scale=[1e-4, 1e-4, 1e-4, 1e-4],
            diff_step=1e-7,
        )
        estimates.append(fit.x[0])
    # A standard deviation of 40 values is known to 11 %.
    assert np.std(estimates) == pytest.approx(cramer_rao_error(drawn), rel=0.35)


def test_the_naive_way_finds_e_where_there_is_neither_noise_nor_offset():
    rocking = FreeRocking(0.02, 3.0, 0.93, 0.012, 0.0)
    angle = rocking.angle(np.arange(0.0, rocking.impact_times()[15], 1e-3))
    assert naive_restitution(angle, 0.02) == pytest.approx(0.93, abs=2e-4)


def test_every_level_of_the_whole_study_is_within_the_goals(found):
    levels = [each for each in found["levels"] if each["factor"] in FACTORS]
    assert {each["factor"] for each in levels} == set(FACTORS)
    for each in levels:
        name = (each["factor"], each["level"])
        assert each["recommended"] >= 1000, name
        assert abs(each["bias"]) < 1e-3, name
        assert 0.92 <= each["coverage"] <= 0.97, name
        assert each["margin"] > 1, name


def test_where_e_scatters_or_noise_is_pink_the_goals_are_kept_or_the_page_names_them(found):
    text = (HERE / "restitution-study.md").read_text(encoding="utf-8")
    assert found["records"] == 5000
    assert found["levels"][0]["refused_of_eight"] <= 0.05
    levels = [each for each in found["levels"] if each["factor"] in ("scatter", "colour")]
    assert [each["level"] for each in levels] == ["0", "0–0.001", "0.001–0.002", "0.002–0.005", "white", "1/f"]
    for each in levels:
        named = f"- {WORDS[each['factor']]}, {each['level']}: "
        assert each["recommended"] >= 1000
        assert each["refused_of_eight"] <= 0.05
        # Scatter that is too small to see, but not too small to matter: the one level that misses, by 0.3 %.
        assert each["coverage"] >= (0.915 if each["level"] == "0–0.001" else 0.92)
        assert each["coverage"] <= 0.97
        if each["coverage"] < 0.92:
            assert f"{named}{each['coverage']:.1%}" in text
        if each["width"] > 1.5 * each["best_width"]:
            assert f"{named}{each['width'] / each['best_width']:.2f} times the best width" in text


def test_an_e_that_depends_on_the_speed_is_named_and_its_interval_holds(found):
    by_speed, drifting = found["departures"]
    assert by_speed["coverage"] >= 0.92
    assert drifting["coverage"] >= 0.92
    # Of 312; the others have too few impacts, or too much scatter, for a change of 0.02 to show.
    assert found["named"]["speed"]["speed-dependent restitution"] >= 235
    assert found["named"]["drift"]["zero drift"] > 10 * found["named"]["drift"]["unequal sides"]


def test_records_that_hold_e_are_answered_and_those_that_do_not_are_refused(found):
    below, *_, above = found["bounds"]
    assert (below["factor"], below["level"]) == ("in the design", "below 0.001")
    assert below["refused"] <= 0.05
    assert (above["factor"], above["level"]) == ("beyond it", "above 0.003")
    assert above["records"] > 100
    assert above["refused"] > 0.95


def test_the_page_tells_the_numbers_of_the_study(found):
    text = (HERE / "restitution-study.md").read_text(encoding="utf-8")
    for each in found["levels"]:
        assert f"| {each['level']} | {each['records']} | {each['refused']:.1%} |" in text
    assert (HERE / "restitution-study.svg").read_text(encoding="utf-8").startswith("<svg")


@pytest.mark.parametrize("slenderness", [3.0, 12.0])
@pytest.mark.parametrize(("restitution", "released"), [(0.8, 0.9), (0.95, -0.5), (0.995, 0.2)])
def test_closed_form_and_adaptive_integration_agree_arc_for_arc(slenderness, restitution, released):
    block = Block.prism(width=1.0 / slenderness, depth=0.3, height=1.0, mass=100.0)
    time = np.linspace(0.0, 12.0, 3001)
    rocking = FreeRocking(block.critical_angle, block.p, restitution, released * block.critical_angle, 0.3)
    integrated = simulate(block, time, restitution=restitution, theta0=rocking.release_angle, release=0.3)
    shared = min(integrated.impact_times.size, 25)
    np.testing.assert_allclose(rocking.impact_times()[:shared], integrated.impact_times[:shared], atol=1e-9)
    compared = time < integrated.impact_times[shared - 1]
    np.testing.assert_allclose(rocking.angle(time)[compared], integrated.angle[compared], atol=1e-9)


@pytest.mark.parametrize("slenderness", [3.0, 12.0])
@pytest.mark.parametrize(("restitution", "released"), [(0.8, 0.9), (0.95, -0.5), (0.995, 0.2)])
def test_the_records_integration_and_the_closed_form_agree_to_the_end(slenderness, restitution, released):
    block = Block.prism(width=1.0 / slenderness, depth=0.3, height=1.0, mass=100.0)
    alpha = block.critical_angle
    rocking = FreeRocking(alpha, block.p, restitution, released * alpha, 0.3, zero_offset=0.01 * alpha)
    time = np.linspace(0.0, 40.0, 20001)
    np.testing.assert_allclose(integrated_angle(rocking, time)[0], rocking.angle(time), rtol=0, atol=1e-8 * alpha)


def test_peaks_are_the_highest_angles_and_the_offset_is_common_to_all():
    rocking = FreeRocking(0.2, 3.0, 0.9, 0.1, 0.1, zero_offset=1e-3)
    edges = np.concatenate(([0.0], rocking.impact_times()[:6]))
    for start, end, peak in zip(edges[:-1], edges[1:], rocking.peak_angles(), strict=False):
        angle = rocking.angle(np.linspace(start + 1e-9, end - 1e-9, 20001)) - 1e-3
        assert angle[np.argmax(np.abs(angle))] == pytest.approx(peak, abs=1e-9)


def test_the_record_ends_at_rest():
    rocking = FreeRocking(0.2, 3.0, 0.8, 0.1, 0.0, zero_offset=1e-3)
    assert rocking.angle(np.array([100.0])) == pytest.approx(1e-3, abs=0)
