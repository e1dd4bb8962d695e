"""The rule of choice, case by case."""

from dataclasses import replace

import pytest

from colonnade.identification.restitution.choice import choose
from colonnade.identification.restitution.estimators.history_scatter import ScatteredFit
from colonnade.identification.restitution.estimators.peaks import PeakFit
from colonnade.identification.restitution.fitting.free_decay import Decay
from colonnade.identification.restitution.result import Estimate
from prism import PRISM

DECAY = Decay({}, 1, 10, PRISM, linearised=False)
PEAKS = Estimate("peaks", 0.951, 0.949, 0.953, 0.001, 0.95, "")
WHOLE = Estimate("history-scatter", 0.95, 0.9498, 0.9502, 1e-4, 0.95, "")


def history(estimate=WHOLE, probability=0.4):
    return ScatteredFit(estimate, None, DECAY, probability)


def chosen_of(history, peaks):
    return choose([history, PeakFit(peaks)])


def test_a_consistent_whole_history_is_recommended():
    assert chosen_of(history(), PEAKS) == (WHOLE, "")


def test_an_inconsistent_one_gives_way_to_the_peaks():
    assert chosen_of(history(probability=1e-4), replace(PEAKS, standard_error=5e-4))[0].name == "peaks"
    assert chosen_of(history(replace(WHOLE, value=0.9), 1e-4), PEAKS)[0].name == "peaks"


def test_an_inconsistent_one_that_agrees_with_poor_peaks_is_widened():
    chosen, _ = chosen_of(history(probability=1e-4), replace(PEAKS, standard_error=0.004))
    assert chosen.name == "history-scatter"
    assert chosen.standard_error > 0.02 * (1 - 0.95)
    assert chosen.low < WHOLE.low


@pytest.mark.parametrize(
    ("whole", "words"),
    [
        (replace(WHOLE, high=1.001), "does not decay"),
        (replace(WHOLE, standard_error=0.004), "standard error of 0.004"),
    ],
    ids=["no decay", "too uncertain"],
)
def test_what_gives_no_value_has_a_reason(whole, words):
    chosen, reason = chosen_of(history(whole), PEAKS)
    assert chosen is None
    assert words in reason


def test_neither_history_nor_peaks_is_a_refusal_with_both_reasons():
    without = Estimate("peaks", None, None, None, None, 0.95, "", "3 peaks are too few.")
    refused = ScatteredFit(replace(without, name="history-scatter", reason="No arcs."))
    chosen, reason = chosen_of(refused, without)
    assert chosen is None
    assert "3 peaks are too few." in reason
    assert "No arcs." in reason
