"""First cycles that turn out of the plane: measured, or by what they lose and how long they last."""

import numpy as np
import pytest

from colonnade.identification.restitution.departures.first_cycles import NAME, out_of_plane_share, signature


@pytest.fixture(scope="module")
def arcs(rocked):
    return rocked()


def across(arcs, shares, time):
    """Rotation of a share of each arc's peak in the middle third of the arc, about 1 rad at rest."""
    values = np.full(time.size, 1.0)
    for n, share in shares.items():
        start, end = arcs.impacts[n : n + 2]
        inside = np.abs(time - (start + end) / 2) < (end - start) / 6
        values[inside] += share * abs(arcs.peak[n])
    return values


def shared(arcs, shares, series=None, noise=0.0):
    time = np.arange(arcs.impacts[0], arcs.impacts[-1], 0.001)
    values = across(arcs, shares, time) + noise * np.random.default_rng(0).normal(size=time.size)
    return out_of_plane_share(time, values, series or arcs.series)


def test_the_largest_share_is_the_size_and_the_last_spoilt_arc_the_end(arcs):
    departure = shared(arcs, {0: 0.15, 2: -0.3, 4: 0.12, 7: 0.09})
    assert (departure.name, departure.unit) == (NAME, "1")
    assert departure.size == pytest.approx(0.3, rel=1e-9)
    assert (departure.left_out, departure.refuses) == (5, False)
    assert "up to 30\u00a0% of the rocking angle" in departure.sentence
    assert "the first 5 of 20 arcs" in departure.sentence


def test_a_single_arc_is_written_as_one(arcs):
    assert "left out: the first of 20 arcs, above " in shared(arcs, {0: 0.15}).sentence


def test_a_share_of_a_tenth_is_let_pass(arcs):
    assert shared(arcs, dict.fromkeys(range(20), 0.099)) is None
    assert shared(arcs, {3: 0.101}) is not None


def test_a_share_within_the_noise_is_let_pass(arcs):
    assert shared(arcs, {}, noise=0.05) is None


@pytest.mark.parametrize(("last", "refuses"), [(13, False), (14, True)], ids=["six arcs left", "five arcs left"])
def test_too_few_later_arcs_are_a_refusal(arcs, last, refuses):
    departure = shared(arcs, {last: 0.2})
    assert departure.refuses is refuses
    assert departure.left_out == last + 1


def test_arcs_that_are_not_used_count_among_those_left_out(rocked):
    arcs = rocked(first=2)
    departure = shared(arcs, {0: 0.5, 4: 0.2})
    assert departure.size == pytest.approx(0.2, rel=1e-9)  # arc 0 is not looked at
    assert departure.left_out == 5
    assert "the first 3 of 18 arcs" in departure.sentence


def test_a_rotation_of_which_every_sample_is_missing_says_nothing(arcs):
    time = np.arange(arcs.impacts[0], arcs.impacts[-1], 0.001)
    assert out_of_plane_share(time, np.full(time.size, np.nan), arcs.series) is None


@pytest.mark.parametrize("count", [2, 3, 6])
@pytest.mark.parametrize(("first", "later"), [(0.90, 0.95), (0.96, 0.98)])
def test_first_impacts_that_lose_more_are_counted_with_their_difference(rocked, count, first, later):
    departure = signature(rocked([*[first] * count, later]).series)
    assert departure.size == pytest.approx(later - first, abs=1e-4)
    assert (departure.left_out, departure.refuses) == (count, False)
    assert f"e is {first:.4f} for them and {later:.4f} later" in departure.sentence


@pytest.mark.parametrize(("first", "found"), [(0.9430, False), (0.9415, True), (0.96, False)])
def test_a_loss_counts_from_a_share_of_the_loss_on_and_a_smaller_loss_never(rocked, first, found):
    # 0.15 of 1 − 0.95 is 0.0075.
    departure = signature(rocked([first] * 3 + [0.95]).series)
    assert (departure is not None and "lose more" in departure.sentence) is found


@pytest.mark.parametrize(("factor", "word"), [(1.05, "longer"), (0.95, "shorter")])
def test_first_arcs_that_last_otherwise_are_counted_with_their_difference(rocked, factor, word):
    departure = signature(rocked(stretched=dict.fromkeys(range(4), factor)).series)
    assert departure.size == pytest.approx(np.log(factor), rel=0.01)
    assert departure.left_out == 4
    assert word in departure.sentence


def test_durations_that_differ_by_little_are_let_pass(rocked):
    assert signature(rocked(stretched=dict.fromkeys(range(4), 1.019)).series) is None


@pytest.mark.parametrize(
    "restitution",
    [0.95, 0.85, (0.94, 0.96), lambda speed: 0.97 - 0.03 * speed],
    ids=["one e", "a low e", "one for each side", "falling with speed"],
)
def test_a_block_of_a_plane_model_has_no_spoilt_cycles(rocked, restitution):
    assert signature(rocked(restitution).series) is None


@pytest.mark.parametrize(("count", "found"), [(7, False), (8, True)])
def test_fewer_than_six_later_arcs_say_nothing(rocked, count, found):
    departure = signature(rocked([0.8, 0.8, 0.95], count=count).series)
    assert (departure is not None) is found
