"""Which estimate of e is recommended, or why none is."""

from __future__ import annotations

from dataclasses import replace
from math import hypot, sqrt

from scipy import stats

from colonnade.identification.restitution import history as whole
from colonnade.identification.restitution.result import Constancy, Estimate, Restitution

LARGEST_ERROR = 0.003
"""Standard error of e above which no value is given."""

LARGEST_CHANGE = 0.02
"""Change of e over the impact velocities seen, ..."""

SURE_CHANGE = 5.0
"""... by at least so many of its standard errors, with which e is no constant."""

DISAGREEMENT = 3.0
"""Standard errors, of both together, beyond which whole history and peaks disagree, ..."""

NEGLIGIBLE = 0.01
"""... if the difference is more than this share of the loss 1 − e: a smaller one changes no prediction."""

MISFIT = 0.02
"""Share of the loss 1 − e that is added to the error of a whole history that leaves over more than noise."""

METHODS = {
    "history-nonlinear": "whole history: exact nonlinear rocking, least squares, errors with the noise's own spectrum",
    "peaks": "peaks: log-energy against impact number, weighted, common zero offset, random-walk scatter (REML)",
}

RULE = (
    "The whole history by the nonlinear model is recommended where noise alone explains what it leaves over (arc by "
    f"arc, probability at least {whole.UNLIKELY:g}); else the peaks, which need neither p nor one e for all impacts, "
    f"unless the whole history with {MISFIT:.0%} of the loss 1 − e added to its error agrees with them and says more. "
    f"No value is given where its standard error is over {LARGEST_ERROR:g}, where its interval reaches 1, where e "
    f"changes with velocity by over {LARGEST_CHANGE:g}, or where a departure from plane rocking leaves too little."
)


def choose(history: whole.HistoryFit, peaks: Estimate, constancy: Constancy) -> tuple[Estimate | None, str]:
    """
    Choose between the whole history and the peaks (see `RULE`).

    Parameters
    ----------
    history : HistoryFit
        By the nonlinear model.
    peaks : Estimate
    constancy : Constancy

    Returns
    -------
    estimate : Estimate or None
        None where none is recommended.
    reason : str
        Why; empty where there is one.
    """
    if constancy.freedom > 0 and abs(constancy.change) > max(
        LARGEST_CHANGE, SURE_CHANGE * constancy.slope_standard_error * abs(constancy.change / constancy.slope)
    ):
        return None, (
            f"e is not constant: it changes by {constancy.change:+.3f} over the impact velocities seen, "
            f"{abs(constancy.slope / constancy.slope_standard_error):.2g} standard errors; one value would mislead."
        )
    chosen = history.estimate if history.is_consistent else _of_two(history, peaks, constancy)
    if chosen.value is None or chosen.high is None or chosen.standard_error is None or chosen.low is None:
        left = "" if history.decay is None else " What the whole history leaves over is more than noise."
        return None, chosen.reason + (left or f" {history.estimate.reason}")
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


def _of_two(history: whole.HistoryFit, peaks: Estimate, constancy: Constancy) -> Estimate:
    """Return the peaks, or the whole history, widened for its misfit, where that agrees with them and says more."""
    value, error = history.estimate.value, history.estimate.standard_error
    if peaks.value is None or peaks.standard_error is None or value is None or error is None:
        return peaks
    # The times of all later impacts carry each impact's own e along, so that its scatter averages out more slowly.
    scattered = 2 * constancy.scatter / sqrt(constancy.freedom) if constancy.freedom > 0 else 0.0
    widened = hypot(error, MISFIT * (1 - value), scattered)
    close = abs(value - peaks.value) <= DISAGREEMENT * hypot(widened, peaks.standard_error)
    if not close or peaks.standard_error <= widened:
        return peaks
    half = float(stats.norm.ppf((1 + peaks.level) / 2)) * widened
    return replace(history.estimate, low=value - half, high=value + half, standard_error=widened)


def disagreement(result: Restitution) -> str:
    """Say by how much the nonlinear history is off the peaks, where this is beyond their errors; else nothing."""
    by_name = {estimate.name: estimate for estimate in result.estimates}
    peaks, history = by_name.get("peaks"), by_name.get("history-nonlinear")
    if peaks is None or history is None or peaks.value is None or history.value is None:
        return ""
    difference = history.value - peaks.value
    error = hypot(history.standard_error or 0.0, peaks.standard_error or 0.0)
    if abs(difference) <= max(DISAGREEMENT * error, NEGLIGIBLE * (1 - peaks.value)):
        return ""
    return (
        f"The whole history gives e = {history.value:.5f} (nonlinear model), the peaks {peaks.value:.5f}: "
        f"{abs(difference) / error:.2g} standard errors apart; at most {DISAGREEMENT:g} were expected. The times of "
        "impact are not quite those of this block: look at its dimensions and mass, and for slide or rotation out of "
        f"plane. The value of the {'peaks' if result.recommended == 'peaks' else 'whole history'} is used."
    )
