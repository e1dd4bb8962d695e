"""Numbers and outcomes of a record in words; a dash if unknown. What a test gave, and the verdict on a prediction."""

from __future__ import annotations

from collections.abc import Sequence
from math import isfinite, nan

from colonnade.campaign.forms.summary import (
    IdentifiedSummary,
    Order,
    PredictionSummary,
    RestitutionSummary,
    TestSummary,
)
from colonnade.dynamics.models.registry import MODELS
from colonnade.errors import count
from colonnade.identification.response.rank import is_within
from colonnade.units import PERCENT, format_percent, format_quantity, format_uncertain, from_si, with_minus

NOTHING = "–"

LEAST_RATIO = 1e-3
"""Angles below this share of the critical angle are noise: 0.1 mm at the top of a block of half a metre."""

USUAL_LEVEL = 0.95
"""± is half of the interval of this level; another level is named."""

WITHIN, DIFFERS = "✓", "≠"
"""Verdicts on a prediction, see `verdict`."""

LEGEND = "✓ history inside the 95 % band of the model's runs; ≠ outside or another outcome"
"""What they mean; 80 columns."""

CHANNEL_UNITS = {
    "displacement": "mm",
    "velocity": "mm/s",
    "acceleration": "m/s²",
    "angle": "mrad",
    "angular_velocity": "rad/s",
    "force": "N",
}
"""Units in which a channel is written and drawn, by its quantity."""


def number(value: float | None, digits: int = 3) -> str:
    """
    Write a plain number with significant digits.

    Examples
    --------
    >>> number(0.41234), number(float("nan")), number(None), number(12345.6)
    ('0.412', '–', '–', '12300')
    """
    if value is None or not isfinite(value):
        return NOTHING
    text = f"{value:.{digits}g}"
    return with_minus(text if "e" not in text or abs(value) < 1e-4 else f"{float(text):.0f}")


def ratio(value: float | None, digits: int = 3) -> str:
    """
    Write an angle or a misfit over the critical angle; of less than `LEAST_RATIO` nothing more is said.

    Examples
    --------
    >>> ratio(0.41234), ratio(4e-6), ratio(0.0), ratio(None)
    ('0.412', '< 0.001', '0', '–')
    """
    return f"< {LEAST_RATIO:g}" if value and abs(value) < LEAST_RATIO else number(value, digits)


def signed_ratio(value: float) -> str:
    """
    Write a difference of angles over the critical angle with its sign, as `ratio` does.

    Examples
    --------
    >>> signed_ratio(0.0123), signed_ratio(-0.5), signed_ratio(-4e-6), signed_ratio(float("nan"))
    ('+0.012', '−0.5', '< 0.001', '–')
    """
    if abs(value) < LEAST_RATIO or not isfinite(value):
        return ratio(value)
    return with_minus(f"{value:+.2g}")


def quantity(value: float | None, unit: str, digits: int = 3) -> str:
    """
    Write an SI value in a unit.

    Examples
    --------
    >>> quantity(0.23202, "mm", 4), quantity(None, "mm")
    ('232 mm', '–')
    """
    if value is None or not isfinite(value):
        return NOTHING
    if "e" in f"{from_si(value, unit):.{digits}g}":
        return f"{number(from_si(value, unit), digits)} {unit}"
    return with_minus(format_quantity(value, unit, digits))


def acceleration(value: float | None) -> str:
    """
    Write an acceleration in both units of the field.

    Examples
    --------
    >>> acceleration(2.3)
    '2.3 m/s² (0.235 g)'
    """
    if value is None or not isfinite(value):
        return NOTHING
    return f"{quantity(value, 'm/s²')} ({quantity(value, 'g')})"


def interval(value: float | None, low: float | None, high: float | None, level: float | None = None) -> str:
    r"""
    Write a coefficient of restitution with the half-width of its interval; its level is named if it is not 95 %.

    Examples
    --------
    >>> interval(0.97608, 0.97528, 0.97688, 0.95), interval(0.97608, 0.97548, 0.97668, 0.9)
    ('0.9761 ± 0.0008', '0.9761 ± 0.0006 (90\xa0% interval)')
    >>> interval(0.976, float("nan"), float("nan"))
    '0.976'
    """
    if value is None or not isfinite(value):
        return NOTHING
    if low is None or high is None or not isfinite(high - low):
        return number(value, 4)
    named = (
        "" if level is None or not isfinite(level) or level == USUAL_LEVEL else f" ({format_percent(level)} interval)"
    )
    return format_uncertain(value, (high - low) / 2) + named


def pooled(found: RestitutionSummary) -> str:
    """
    Write the e of a specimen that predictions use, and where it comes from.

    Examples
    --------
    >>> pooled(RestitutionSummary(value=0.976, low=0.9756, high=0.9764, source="identified", tests=("a", "b")))
    'e 0.9760 ± 0.0004, identified from 2 free vibrations'
    >>> pooled(RestitutionSummary(value=(0.95, 0.96), source="given"))
    'e 0.95 and 0.96, given'
    """
    values = found.value if isinstance(found.value, tuple) else (found.value,)
    told = " and ".join(interval(value, found.low, found.high, found.level) for value in values)
    source = f" from {count(len(found.tests), 'free vibration')}" if found.tests else ""
    return f"e {told}, {found.source}{source}"


def share(part: int, whole: int) -> str:
    r"""
    Write a part of a whole in per cent; what is there is never rounded to nothing.

    Examples
    --------
    >>> share(3, 40), share(3, 60000), share(0, 10)
    ('7.5\xa0%', '< 0.01\xa0%', '0\xa0%')
    """
    if part == 0:
        return f"0{PERCENT}"
    percent = 100 * part / whole
    return f"< 0.01{PERCENT}" if percent < 0.01 else f"{percent:.2g}{PERCENT}"


def probability(value: float) -> str:
    """
    Write a probability in per cent; what is not certain is never rounded to certainty.

    Examples
    --------
    >>> probability(0.432), probability(5e-17), probability(0.998), probability(1.0)
    ('43 %', '< 1 %', '> 99 %', '100 %')
    """
    if value in (0.0, 1.0):
        return f"{100 * value:.0f} %"
    return "< 1 %" if value < 0.01 else "> 99 %" if value > 0.99 else f"{100 * value:.0f} %"


def listed(names: Sequence[str], longest: int = 8) -> str:
    """
    List names, the first few of them where they are many.

    Examples
    --------
    >>> listed(["a", "b"]), listed(list("abcdefgh"), longest=3)
    ('a, b', 'a, b, c and 5 more')
    """
    if len(names) <= longest:
        return ", ".join(names)
    return f"{', '.join(names[:longest])} and {len(names) - longest} more"


def order(known: Order) -> str:
    """
    Write the order of a response.

    Examples
    --------
    >>> order(1), order(3), order("irregular"), order(None)
    ('harmonic', '1/3', 'irregular', '')
    """
    if known is None or isinstance(known, str):
        return known or ""
    return "harmonic" if known == 1 else f"1/{known}"


def agree(measured: str, predicted: str) -> bool | None:
    """
    Return whether a predicted outcome is the measured (or observed) one; None where either is not known.

    Examples
    --------
    >>> agree("rocking", "rocking"), agree("not-overturned", "overturned"), agree("", "rocking")
    (True, False, None)
    """
    if not measured or not predicted:
        return None
    if measured == "not-overturned":
        return predicted != "overturned"
    return measured == predicted


def verdict(test: TestSummary, model: str) -> str:
    """
    Judge a prediction: the one rule of terminal and pages.

    Returns
    -------
    mark : str
        ``≠`` if the model predicts another outcome than the measured (or observed) one, or if the measured angle is
        outside the 95 % band of the model's runs; ``✓`` if it is inside; empty without an ensemble.
    """
    found = test.predicted.get(model, PredictionSummary())
    within = is_within(nan if found.within_spread is None else found.within_spread)
    if within is False or _agrees(test, found) is False:
        return DIFFERS
    return WITHIN if within else ""


def measured(test: TestSummary, level: float | None = None) -> str:
    """
    Write what a test gave in a few words: e of a free vibration, else the outcome and the peak over α.

    `level` is that of the interval of e, None for 95 %.

    Examples
    --------
    >>> measured(TestSummary(status="done", kind="earthquake", specimen="a", outcome="rocking", peak_ratio=0.281))
    'rocking 0.281 α'
    """
    if test.status == "failed":
        return "failed"
    e = test.restitution or IdentifiedSummary()
    if e.value is not None:
        return f"e {interval(e.value, e.low, e.high, level)}"
    if not test.outcome:
        return f"{_words(test.observed_outcome)} (seen)" if test.observed_outcome else test.status
    return _with_peak(test.outcome, test.peak_ratio, " α") + (", no e" if test.restitution else "")


def predicted(test: TestSummary) -> dict[str, str]:
    """
    Write what each model predicts of a test with the verdict on it, such as ``0.275 ✓``; the exact models first.

    The outcome is named if it is not that of a block that rocks as measured. A model that has not run is left out.
    """
    exact_first = sorted(test.predicted, key=lambda model: model in MODELS and MODELS[model].is_linearised)
    return {
        model: f"{_prediction(test, test.predicted[model])} {verdict(test, model)}".rstrip()
        for model in exact_first
        if test.predicted[model].outcome
    }


def _agrees(test: TestSummary, found: PredictionSummary) -> bool | None:
    return agree(test.outcome or test.observed_outcome or "", found.outcome or "")


def _prediction(test: TestSummary, found: PredictionSummary) -> str:
    if test.outcome == found.outcome == "rocking":
        return _peak(found.peak_ratio)
    return _with_peak(found.outcome or "", found.peak_ratio)


def _with_peak(outcome: str, peak_ratio: float | None, unit: str = "") -> str:
    """Write an outcome, and the peak of a block that rocks."""
    peak = f" {_peak(peak_ratio)}{unit}" if outcome == "rocking" and peak_ratio is not None else ""
    return _words(outcome) + peak


def _peak(peak_ratio: float | None) -> str:
    """Write a peak over α to the thousandth, the least that counts."""
    return ratio(peak_ratio) if peak_ratio is None or peak_ratio < LEAST_RATIO else f"{peak_ratio:.3f}"


def _words(outcome: str) -> str:
    return outcome.replace("-", " ")
