"""The two sides of a block compared on arcs of closed form."""

import numpy as np
import pytest

from colonnade.dynamics.block import Block
from colonnade.identification.restitution.departures.two_sides import (
    FEWEST_ARCS,
    LOSS,
    OFFSET,
    TILT,
    UNEQUAL,
    compare_sides,
    sides_problem,
    zero_drift,
)


def found(series):
    return {departure.name: departure for departure in compare_sides(series)}


def tilted(prism, tilt):
    """The prism on a table that is tilted by so much (rad), down towards −x."""
    alpha = prism.critical_angle
    return Block.measured(
        mass=prism.mass,
        pole_distance=prism.pole_distance,
        critical_angle=(alpha - tilt, alpha + tilt),
        inertia=prism.inertia,
    )


@pytest.mark.parametrize("restitution", [0.8, 0.95, 0.99])
def test_equal_sides_differ_in_nothing_and_have_the_e_that_made_them(rocked, restitution):
    arcs = rocked(restitution)
    assert found(arcs.series) == {}
    coefficients = sides_problem(arcs.series).fit().coefficients
    assert coefficients[0] == pytest.approx(2 * np.log(arcs.series.speed[0]), abs=1e-6)
    assert coefficients[LOSS] == pytest.approx(2 * np.log(restitution), abs=1e-7)
    assert np.abs(coefficients[[UNEQUAL, OFFSET, TILT]]).max() < 1e-6


@pytest.mark.parametrize(("negative", "positive"), [(0.94, 0.96), (0.96, 0.94), (0.9, 0.93)])
def test_unequal_e_is_positive_less_negative(rocked, negative, positive):
    departures = found(rocked((negative, positive)).series)
    assert list(departures) == ["unequal restitution"]
    departure = departures["unequal restitution"]
    assert departure.size == pytest.approx(positive - negative, abs=1e-5)
    assert f"{positive:.4f} of impacts from θ > 0, {negative:.4f} from θ < 0" in departure.sentence
    assert (departure.left_out, departure.refuses) == (0, False)


def test_unequal_e_is_the_same_where_the_first_arc_is_on_the_other_side(rocked):
    departure = found(rocked((0.94, 0.96), first=1).series)["unequal restitution"]
    assert departure.size == pytest.approx(0.02, abs=1e-5)


@pytest.mark.parametrize(
    ("mean", "difference", "named"),
    [(0.95, 0.0078, False), (0.95, 0.0082, True), (0.75, 0.0120, False), (0.75, 0.0130, True)],
    ids=["as much as a scale", "more than a scale", "little of the loss", "more of the loss"],
)
def test_a_difference_counts_from_its_thresholds_on(rocked, mean, difference, named):
    series = rocked((mean - difference / 2, mean + difference / 2), count=12).series
    assert ("unequal restitution" in found(series)) is named


@pytest.mark.parametrize("share", [-0.03, 0.006, 0.03])
def test_a_tilted_table_is_found_with_its_angle_and_sign(rocked, prism, share):
    tilt = share * prism.critical_angle
    departures = found(rocked(block=tilted(prism, tilt)).series)
    assert list(departures) == ["unequal sides"]
    assert departures["unequal sides"].size == pytest.approx(tilt, rel=0.03)
    assert departures["unequal sides"].unit == "rad"


def test_a_small_tilt_and_one_that_is_known_are_not_told(rocked, prism):
    assert found(rocked(block=tilted(prism, 0.004 * prism.critical_angle)).series) == {}
    known = tilted(prism, 0.03 * prism.critical_angle)
    assert found(rocked(block=known, seen_as=known).series) == {}


@pytest.mark.parametrize("zero", [-2e-4, 2e-4])
def test_a_zero_that_is_off_is_the_offset_and_no_departure(rocked, zero):
    series = rocked(zero=np.full(20, zero)).series
    assert sides_problem(series).fit().coefficients[OFFSET] == pytest.approx(zero, rel=0.05)
    assert found(series) == {}


@pytest.mark.parametrize("drift", [-0.004, 0.004])
def test_a_zero_that_drifts_is_named_with_its_way(rocked, drift):
    middle = rocked().series
    along = (middle.start + middle.end) / 2
    along = (along - along[0]) / (along[-1] - along[0]) - 0.5
    departures = found(rocked(zero=drift * along).series)
    assert departures["zero drift"].size == pytest.approx(drift, rel=0.1)


def test_the_column_of_a_drift_is_that_of_an_offset_growing_from_minus_to_plus_a_half(rocked):
    series = rocked().series
    count = series.number.size
    column, offset = zero_drift(series), sides_problem(series).design[:, OFFSET]
    assert column.shape == (2 * count,)
    ratio = (column / offset).reshape(2, count)
    middle = (series.start + series.end) / 2
    assert ratio[:, [0, -1]].tolist() == [pytest.approx([-0.5, 0.5])] * 2
    assert ratio[0] == pytest.approx(ratio[1])
    assert np.diff(ratio[0]) == pytest.approx(np.diff(middle) / (middle[-1] - middle[0]))


def test_a_problem_has_energies_then_durations(rocked):
    series = rocked().series
    problem = sides_problem(series)
    count = series.number.size
    assert problem.design.shape == (2 * count, 7)
    assert problem.values.tolist() == [*series.energy, *series.period]
    assert not problem.design[count:, : UNEQUAL + 1].any()  # e has no part in durations
    assert not problem.walk[count:].any()
    assert not problem.walk[:, count:].any()
    # Scatter of ln e at each impact adds up: its covariance is that of a random walk.
    assert problem.walk[5, 3] == problem.walk[3, 3] == 3.0


@pytest.mark.parametrize(("count", "compared"), [(FEWEST_ARCS - 1, False), (FEWEST_ARCS, True)])
def test_few_arcs_are_not_compared(rocked, count, compared):
    assert bool(found(rocked((0.9, 0.96), count=count).series)) is compared
