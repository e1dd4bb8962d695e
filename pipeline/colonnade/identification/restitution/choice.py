"""Which estimate of e is recommended, or why none is."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from math import hypot

import scipy

from colonnade.identification.restitution.estimators.estimator import Fit
from colonnade.identification.restitution.estimators.history import UNLIKELY, NonlinearHistory
from colonnade.identification.restitution.estimators.history_scatter import ScatteredHistory
from colonnade.identification.restitution.estimators.peaks import PeakDecay
from colonnade.identification.restitution.result import Estimate, Restitution
from colonnade.units import format_percent

LARGEST_ERROR = 0.003
"""Standard error of e above which no value is given."""

DISAGREEMENT = 3.0
"""Standard errors, of both together, beyond which whole history and peaks disagree, ..."""

NEGLIGIBLE = 0.01
"""... if the difference is more than this share of the loss 1 − e: a smaller one changes no prediction."""

MISFIT = 0.02
"""Share of the loss 1 − e that is added to the error of a whole history whose residual is more than noise."""

RULE = (
    "The whole history with an e of its own at each impact is recommended if noise and scatter alone explain its "
    f"residual (arc by arc, probability at least {UNLIKELY:g}); else the peaks, which do not need p, unless the "
    f"whole history with {format_percent(MISFIT)} of the loss 1 − e added to its error agrees with them and says more. "
    f"No value is given if its standard error is over {LARGEST_ERROR:g}, if its interval reaches 1, or if a departure "
    "from plane rocking with one e leaves too little."
)


def choose(fits: Sequence[Fit]) -> tuple[Estimate | None, str]:
    """
    Choose the estimate that is recommended (see `RULE`).

    Parameters
    ----------
    fits : sequence of Fit
        Of the estimators that may be recommended, the preferred one first.

    Returns
    -------
    estimate : Estimate or None
        None if no value is recommended.
    reason : str
        Why; empty if a value is.
    """
    *preferred, last = fits
    chosen = last.estimate
    for fit in reversed(preferred):
        chosen = _of_two(fit.estimate, chosen) if fit.objection else fit.estimate
    if chosen.value is None or chosen.high is None or chosen.standard_error is None or chosen.low is None:
        return None, " ".join([chosen.reason, *(fit.objection for fit in preferred)])
    if chosen.high >= 1:
        return None, (
            f"The motion does not decay: e would be {chosen.value:.4f}, between {chosen.low:.4f} and "
            f"{chosen.high:.4f}; below 1 was expected. A free vibration on a table at rest is needed."
        )
    if chosen.standard_error > LARGEST_ERROR:
        return None, (
            f"e would be {chosen.value:.3f} with a standard error of {chosen.standard_error:.1g}; at most "
            f"{LARGEST_ERROR:g} was expected. The amplitude is too low for this noise, or the impacts are too few or "
            "too unlike each other; release from a larger angle."
        )
    return chosen, ""


def _of_two(preferred: Estimate, other: Estimate) -> Estimate:
    """Return the other, or the preferred one, widened for its misfit, if the two agree and it says more."""
    value, error = preferred.value, preferred.standard_error
    if other.value is None or other.standard_error is None or value is None or error is None:
        return other
    widened = hypot(error, MISFIT * (1 - value))
    close = abs(value - other.value) <= DISAGREEMENT * hypot(widened, other.standard_error)
    if not close or other.standard_error <= widened:
        return other
    half = float(scipy.stats.norm.ppf((1 + other.level) / 2)) * widened
    return replace(preferred, low=value - half, high=value + half, standard_error=widened)


def disagreement(result: Restitution) -> str:
    """Say by how much the whole history is off the peaks, where this is beyond their errors; else nothing."""
    by_name = {estimate.name: estimate for estimate in result.estimates}
    # An e of its own at each impact takes up what a wrong block does; where that shows, one e for all shows it best.
    misfits = result.history is not None and result.history.probability < UNLIKELY
    peaks = by_name[PeakDecay.name]
    history = by_name[NonlinearHistory.name if misfits else ScatteredHistory.name]
    if peaks.value is None or history.value is None:
        return ""
    difference = history.value - peaks.value
    error = hypot(history.standard_error or 0.0, peaks.standard_error or 0.0)
    if abs(difference) <= max(DISAGREEMENT * error, NEGLIGIBLE * (1 - peaks.value)):
        return ""
    return (
        f"The whole history gives e = {history.value:.5f}, the peaks {peaks.value:.5f}: "
        f"{abs(difference) / error:.2g} standard errors apart; at most {DISAGREEMENT:g} were expected. The times of "
        "impact are not quite those of this block: check the sampling rate, its dimensions and mass, and for slide or "
        "rotation out of plane. The value of the "
        f"{'peaks' if result.recommended == PeakDecay.name else 'whole history'} is used."
    )
