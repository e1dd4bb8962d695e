"""The study of Span 2.5: its members are what they say, its page is made from its numbers, its numbers come again."""

from __future__ import annotations

import json
from dataclasses import replace
from math import tan
from pathlib import Path

import numpy as np
import pytest

import span_study
from colonnade.dynamics.contact.nodes import rigid_body
from span_two_and_a_half import controls, telling
from span_two_and_a_half.counting import SCOPES, Strata, best_and_worst, decided, interval, likelihoods
from span_two_and_a_half.criterion import AS_FIXED, Criterion, agrees, place_of_growth
from span_two_and_a_half.design import (
    BOTH,
    CAUSES,
    EVERY,
    MODELS,
    ONLY,
    OTHERS,
    SPACE,
    SPACE_MEMBERS,
    STRANGE,
    Cell,
    cells,
    intensities,
    nominal,
    table_motion,
)
from span_two_and_a_half.drawings import example_responses
from span_two_and_a_half.members import RUN_ALL, VARIANTS, run_members
from span_two_and_a_half.running import STANDARD, Runner, run_cells
from span_two_and_a_half.space import across, raised
from span_two_and_a_half.trial import (
    MIDDLE_SPEED,
    Wrong,
    draw,
    predict,
    recorded,
    restitution,
    table,
    truth,
)

PAGES = Path(__file__).resolve().parents[2] / "reports" / "manos"
BLOCK, E = nominal()
MOTION = table(table_motion(), 1.5, STRANGE)


@pytest.fixture(scope="module")
def found():
    return json.loads((PAGES / "span-2.5.json").read_text(encoding="utf-8"))


def randoms():
    return np.random.default_rng(1)


def test_a_tilted_table_is_an_offset_of_the_acceleration():
    tilted = truth(Wrong(tilt=0.01), MOTION, randoms())
    offset = recorded(Wrong(offset=(0.0, 1e3 * tan(0.01), 0.0)), MOTION, 1, randoms())
    np.testing.assert_allclose(tilted.angle, predict(offset)["nonlinear"].angle, atol=1e-9)


def test_what_is_wrong_with_the_record_is_what_the_size_says():
    seen = recorded(Wrong(gain=0.01, clock=-0.003), MOTION, 1, randoms())
    assert seen.dt == pytest.approx(0.997 * MOTION.dt)
    np.testing.assert_allclose(seen.acceleration, 1.01 * MOTION.acceleration)
    drifted = recorded(Wrong(drift=(0.0, 10.0, 0.0)), MOTION, 1, randoms())
    end = int(np.flatnonzero(MOTION.acceleration)[-1]) + 1
    assert (drifted.acceleration - MOTION.acceleration)[end] == pytest.approx(0.01 * BLOCK.gravity, rel=0.01)
    noisy = recorded(Wrong(noise=3.0), MOTION, 1, randoms())
    assert np.std(noisy.acceleration - MOTION.acceleration) == pytest.approx(0.003 * BLOCK.gravity, rel=0.1)
    smooth = recorded(Wrong(filter=10.0), MOTION, 1, randoms())
    assert np.abs(np.diff(smooth.acceleration)).max() < 0.7 * np.abs(np.diff(MOTION.acceleration)).max()


def test_e_that_depends_on_the_speed_is_right_in_the_middle():
    fastest = BLOCK.p * BLOCK.critical_angle
    law = restitution(Wrong(speed=0.03), randoms())
    low, middle, high = law(np.array([0.0, MIDDLE_SPEED, 1.0]) * fastest)
    assert (middle, high - low) == (pytest.approx(E, abs=1e-4), pytest.approx(0.03, abs=1e-4))


def test_e_that_scatters_is_another_one_at_each_impact():
    history = truth(Wrong(scatter=0.01), MOTION, randoms())
    fast = np.abs(history.impact_velocities) > 0.01
    ratios = history.rebound_velocities[fast] / history.impact_velocities[fast]
    assert np.std(ratios) == pytest.approx(0.01, rel=0.4)
    assert np.unique(ratios).size > 0.9 * ratios.size


@pytest.mark.parametrize("cell", [Cell("e", 1), Cell("filter", 3), Cell("tilt", 0), Cell("scatter", 2)], ids=str)
def test_sizes_are_within_the_spread_of_their_cell(cell):
    sizes = [abs(getattr(draw(cell, number), cell.cause)) for number in range(50)]
    spread = CAUSES[cell.cause].spread
    assert cell.size / spread <= min(sizes) < max(sizes) <= cell.size * spread
    assert draw(cell, 7) == draw(cell, 7) != draw(cell, 8)


def test_all_causes_are_drawn_together():
    wrong = draw(Cell("all", 1), 0)
    names = [name for name, cause in CAUSES.items() if len(cause.sizes) > 1 and name != "all"]
    assert len(names) == 12
    assert all(np.any(getattr(wrong, name.replace(" ", "_"))) for name in names)


def test_other_spans_are_run_where_something_shows_and_in_every_tenth_member():
    judged = run_members(Cell("all", 2), intensities()[::40], 0, 2, *STANDARD)
    assert judged.grown.shape == (24, len(VARIANTS), 2, len(MODELS))
    assert not judged.agree[~judged.known][:, SCOPES.index(EVERY)].any()
    assert judged.known[judged.number % RUN_ALL == 0].all()
    shown = judged.grown.any(axis=(1, 2, 3))
    assert np.isnan(judged.place[~shown]).all()


def test_nothing_wrong_is_never_wrong_for_the_true_model():
    judged = run_members(Cell("none", 0), intensities()[::60], 0, 1, *STANDARD)
    assert not judged.grown[..., MODELS.index("nonlinear")].any()


def test_a_share_over_two_parts_weighs_each_intensity_alike():
    strata = Strata(np.arange(1.0, 5.0), np.array([True, False, False, False]))
    intensity = np.array([1.0, 1.0, 1.0, 1.0, 2.0, 3.0, 4.0])
    counts = strata.counts(np.array([True, True, False, False, False, False, True]), intensity)
    assert counts == [2, 4, 1, 3]
    share, low, high = strata.share(counts)
    assert share == pytest.approx(0.25 * 0.5 + 0.75 / 3)
    assert low < share < high
    assert interval(0, 100)[1] == pytest.approx(1 - 0.025 ** (1 / 100))


def test_a_cause_is_preferred_only_beyond_the_rule():
    limits = {"one": {"low": 0.1, "high": 0.2}, "two": {"low": 0.0, "high": 0.01}, "three": {"low": 0.0, "high": 0.02}}
    assert decided(limits) == [("one", "two")]


def test_results_are_kept_and_not_run_again(tmp_path, monkeypatch):
    few = {"e": CAUSES["e"]}
    monkeypatch.setattr("span_two_and_a_half.running.cells", lambda: cells(few)[2:3])
    first, agree = run_cells(Runner(tmp_path, 1), steps=4, sweeps=1, more=1)
    monkeypatch.setattr("colonnade.dynamics.rock.rock", None)
    monkeypatch.setattr("span_two_and_a_half.trial.rock", None)
    again, _ = run_cells(Runner(tmp_path, 1), steps=4, sweeps=1, more=1)
    assert agree.shape == (4,)
    np.testing.assert_array_equal(first[Cell("e", 2)].grown, again[Cell("e", 2)].grown)


def test_a_raised_corner_is_one_corner():
    body = rigid_body(BLOCK)
    lifted = raised(body, 1e-5).nodes[:, 2] - body.nodes[:, 2]
    assert lifted.max() == pytest.approx(1e-5)
    assert np.count_nonzero(lifted == lifted.max()) == 1
    assert np.count_nonzero(lifted) == 4


def test_motion_across_is_as_long_as_the_table_moves():
    values = across(MOTION)
    assert (values.size, np.abs(values).max()) == (MOTION.acceleration.size, pytest.approx(1.0, abs=0.05))


def test_the_same_motion_on_a_finer_clock():
    finer = controls.refined(MOTION)
    np.testing.assert_allclose(finer.acceleration[:: controls.FINER], MOTION.acceleration)
    assert finer.duration == pytest.approx(MOTION.duration)


def test_engines_see_the_same_in_a_member():
    seen = controls.engines(Cell("e", 2), 3, 1.5)
    assert len({shown for name, shown in seen.items() if name != "linear" and "paper" not in name}) == 1
    counted = controls.summarised([seen])
    assert all(each["same"] == each["members"] == 1 for each in counted.values())


def test_a_repeat_of_a_cause_that_stays_is_the_same_test():
    told = telling.tell(Cell("e", 0), 1, 1.2)
    assert told["repeats 0.001"]
    assert telling.information(np.array([[1.0, 0.0], [0.0, 1.0], [1.0, 0.0]])) == pytest.approx(0.918, abs=1e-3)


def test_instruments_decide_from_the_size_that_gives_twenty_to_one():
    first, gyroscope = telling.DIRECT["e"]
    assert np.exp(0.5 * (telling.decided_from(first) / first.deviation) ** 2) == pytest.approx(20.0, rel=0.01)
    assert telling.resolved(gyroscope.instrument) == ["e"]
    assert telling.resolved(gyroscope.instrument, grade=2) == ["e", "speed", "scatter"]
    assert telling.instrument_information("level on the table") == pytest.approx(np.log2(12) - 11 / 12 * np.log2(11))


def test_the_page_is_made_from_the_numbers(found):
    from span_two_and_a_half.page import page

    assert (PAGES / "span-2.5.md").read_text(encoding="utf-8") == page(found)
    for name in ("span-2.5-likelihood.svg", "span-2.5-example.svg"):
        assert (PAGES / name).read_text(encoding="utf-8").startswith("<svg")
        assert name in page(found)


def test_every_cause_was_run_at_every_size(found):
    assert found["members"] >= 100_000
    ran = {(row["cause"], row["grade"]) for row in found["rows"] if row["scope"] == EVERY}
    assert len(ran) == len(cells())
    assert {row["cause"] for row in found["rows"]} == set(CAUSES)
    assert {row["cause"] for row in found["space"]} == set(SPACE)
    assert {row["members"] for row in found["space"]} == {SPACE_MEMBERS}


def test_likelihoods_are_those_of_the_counts(found):
    agreeing, of = found["agreeing"]
    strata = Strata(np.arange(of, dtype=float), np.arange(of) < agreeing)
    for row in found["rows"]:
        for view in (BOTH, *MODELS):
            counts = row[view]["pattern"][AS_FIXED]
            assert counts[1] + counts[3] == row["members"]
            assert row[view]["likelihood"] == pytest.approx(strata.share(counts), abs=1e-6)
            assert set(row[view]["pattern"]) == set(VARIANTS)
        assert row[BOTH]["likelihood"][0] <= min(row[model]["likelihood"][0] for model in MODELS) + 1e-9


def test_the_true_model_never_shows_the_pattern_if_nothing_is_wrong(found):
    (none,) = (row for row in found["rows"] if row["cause"] == "none")
    assert none["nonlinear"]["likelihood"][0] == 0.0


def test_the_example_shows_the_pattern_again(found):
    example = found["example"]
    responses = example_responses(example)
    views = MODELS if example["view"] == BOTH else (example["view"],)
    for model in views:
        measured, predictions = responses[STRANGE]
        assert np.isfinite(place_of_growth(measured, predictions[model], Criterion()))
        for span in OTHERS:
            assert agrees(responses[span][0], responses[span][1][model], Criterion())


def test_some_members_come_again(found):
    sample = found["sample"]
    some, number = intensities()[sample["first"] :], sample["first"] * sample["sweeps"]
    judged = run_members(Cell(sample["cause"], sample["grade"]), some, number, sample["sweeps"], *STANDARD)
    assert sample["grown"] == span_study.numbers_that_grow(judged)
    assert sample["grown"]


def test_limits_of_the_rule_are_those_of_the_rows(found):
    limits = best_and_worst(found["rows"], BOTH, EVERY)
    assert set(limits) == set(CAUSES)
    for row in found["rows"]:
        if row["scope"] == EVERY and row["grade"] in ("small", "usual"):
            assert limits[row["cause"]]["high"] >= row[BOTH]["likelihood"][2]


def test_a_small_study_runs(tmp_path, monkeypatch):
    monkeypatch.setattr("span_two_and_a_half.running.cells", lambda: [Cell("e", 3), Cell("scatter", 3)])
    runner = Runner(tmp_path, 1)
    ran, agree = run_cells(runner, steps=8, sweeps=1, more=1)
    rows = likelihoods(ran, Strata(intensities()[::60], agree))
    assert [(row["cause"], row["scope"]) for row in rows] == [
        (cause, scope) for scope in (EVERY, ONLY) for cause in ("e", "scatter")
    ]
    assert runner.seconds > 0.0
    assert len(span_study.tell(runner, ran)) == 2
    assert replace(span_study.Size(), steps=8).steps == 8
