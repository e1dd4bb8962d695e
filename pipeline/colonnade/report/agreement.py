"""How far a model agrees with a campaign: right outcomes, and with them always the misfits and the model's spread."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import isfinite, nan
from statistics import median
from typing import Any, NamedTuple

from colonnade.identification.verdict import is_within
from colonnade.report import wording


class Score(NamedTuple):
    """
    One test by one model.

    Attributes
    ----------
    test : str
    agrees : bool or None
        Whether the predicted outcome is the measured or observed one; None if either is not known.
    nrmse : float
        NaN if not known.
    within : bool or None
        Whether the misfit is within the model's own spread; None if that was not computed.
    """

    test: str
    agrees: bool | None
    nrmse: float
    within: bool | None


def sentences(model: str, scores: Sequence[Score]) -> str:
    """
    Say how far a model agrees, empty if there is no test to say it of.

    Examples
    --------
    >>> sentences("linear", [Score("a", True, 0.02, True), Score("b", True, 0.05, False), Score("c", None, 0.1, None)])
    'The linear model predicts the outcome of 2 of 2 tests. Its misfit (nrmse) is 0.05 at the median and 0.1 at most, \
in c. 1 of 2 misfits is within its own spread.'
    """
    known = [score for score in scores if score.agrees is not None]
    misfits = sorted((score.nrmse, score.test) for score in scores if isfinite(score.nrmse))
    judged = [score.within for score in scores if score.within is not None]
    if not known:
        return ""
    right = sum(score.agrees is True for score in known)
    told = [f"The {model} model predicts the outcome of {right} of {wording.count(len(known), 'test')}."]
    if misfits:
        middle, (largest, test) = median(misfit for misfit, _ in misfits), misfits[-1]
        told.append(
            f"Its misfit (nrmse) is {wording.number(middle, 2)} at the median "
            f"and {wording.number(largest, 2)} at most, in {test}."
        )
    if judged:
        verb = "is" if judged.count(True) == 1 else "are"
        told.append(f"{judged.count(True)} of {wording.count(len(judged), 'misfit')} {verb} within its own spread.")
    else:
        told.append("Its own spread was not computed.")
    return " ".join(told)


def of_summary(tests: Mapping[str, Mapping[str, Any]]) -> list[str]:
    """Say the same of tests as summary.json has them, a sentence or more a model."""
    scores: dict[str, list[Score]] = {}
    for name, test in tests.items():
        measured = test["outcome"] or test.get("observed_outcome") or ""
        for model, found in test["predicted"].items():
            nrmse, rank = (nan if found[key] is None else found[key] for key in ("nrmse", "within_spread"))
            score = Score(name, wording.agree(measured, found["outcome"] or ""), nrmse, is_within(rank))
            scores.setdefault(model, []).append(score)
    return [told for model, found in scores.items() if (told := sentences(model, found))]
