"""Start of rocking over intensity: a curve, or the threshold that replaces it."""

from __future__ import annotations

from dataclasses import dataclass

from colonnade.assessment.fragility.curves.lognormal import LognormalFit, fit_lognormal
from colonnade.assessment.fragility.outcomes import Outcomes
from colonnade.assessment.fragility.resampling import LEVEL, RESAMPLES


@dataclass(frozen=True)
class Uplift:
    """
    When the block starts to rock: one of the two is None.

    Attributes
    ----------
    threshold : tuple of float or None
        Lowest and highest intensity, over the draws, at which it starts. They differ only as the draws of α do.
    curve : LognormalFit or None
    """

    threshold: tuple[float, float] | None
    curve: LognormalFit | None


def uplift(
    outcomes: Outcomes,
    *,
    threshold: tuple[float, float] | None = None,
    level: float = LEVEL,
    resamples: int = RESAMPLES,
    seed: int = 0,
) -> Uplift:
    """
    Describe the start of rocking.

    Parameters
    ----------
    outcomes : Outcomes
        A history with a peak of 0 did not rock.
    threshold : tuple of float, optional
        Smallest and largest g tan α of the draws, if the intensity is the peak acceleration and no motion is vertical:
        the block then rocks exactly if it exceeds g tan α, and no probability is fitted.
    level, resamples, seed : optional
        As of `fit_lognormal`.

    Returns
    -------
    uplift : Uplift

    Raises
    ------
    ValueError
        If the threshold is not a rising pair of positive numbers.
    """
    if threshold is None:
        curve = fit_lognormal(outcomes, event=outcomes.peak > 0, level=level, resamples=resamples, seed=seed)
        return Uplift(None, curve)
    low, high = threshold
    if not 0 < low <= high:
        raise ValueError(f"threshold is {low:g} to {high:g}; a rising pair of positive accelerations was expected")
    return Uplift((float(low), float(high)), None)
