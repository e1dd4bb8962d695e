"""The measures of one motion, each with its value or the reason why it has none: the one place that decides PGV."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from colonnade.arrays import Array
from colonnade.assessment.intensity.baselines import NONE, corrected
from colonnade.assessment.intensity.ground import LARGEST_DRIFT, LARGEST_DRIFT_AT_REST, Ground
from colonnade.assessment.intensity.registry import MEASURES, Measure, measure_of
from colonnade.digest import Digested, written
from colonnade.dynamics.block import STANDARD_GRAVITY, Block
from colonnade.dynamics.motion import Motion
from colonnade.validation import described, instance, number

PERIODS = (0.2, 0.5, 1.0, 2.0)
"""s, of the spectral accelerations that are given if no measures are asked for."""


@dataclass(frozen=True, repr=False)
class IntensityMeasures(Digested):
    """
    Measures of a motion.

    Attributes
    ----------
    values : dict of str to float
        SI, by id; NaN where there is a reason.
    reasons : dict of str to str
        Why a measure has no value, by id.
    drift : float
        Ratio of the velocity at the end to the largest one, after the correction.
    largest_drift : float
        Ratio up to which the motion counts as one without drift.
    baseline : str
        Name of the correction that was asked for.

    Examples
    --------
    >>> import numpy as np
    >>> import colonnade
    >>> wave = 3.0 * np.sin(np.pi * np.arange(101) / 50)
    >>> found = colonnade.intensity_measures(colonnade.Motion(wave, 0.01))
    >>> round(found.values["pgv"], 3), found.drift < found.largest_drift, found.baseline
    (0.955, True, 'none')
    >>> found.digest()["PGA"]
    '3 m/s²'
    """

    values: dict[str, float]
    reasons: dict[str, str]
    drift: float
    largest_drift: float
    baseline: str

    def digest(self) -> dict[str, str]:
        """
        Return all measures with their units.

        Returns
        -------
        digest : dict of str to str
            Names and values with their units, as a notebook shows them.
        """
        measures = [measure_of(name) for name in self.values]
        return {each.symbol: written(self.values[each.id], each.unit) for each in measures}


def intensity_measures(
    motion: Motion,
    block: Block | None = None,
    *,
    measures: Sequence[str] | None = None,
    drift: float | None = None,
    baseline: str = NONE,
    gravity: float | None = None,
    at_rest: bool = False,
) -> IntensityMeasures:
    """
    Measure how strong a ground motion is.

    Parameters
    ----------
    motion : Motion
        Its acceleration along x counts.
    block : Block, optional
        For the measures over those of a block.
    measures : sequence of str, optional
        Ids, such as "pgv" or "sa(0.5 s)". Default: all that the motion and the block allow, with spectral
        accelerations at `PERIODS`.
    drift : float, optional
        Largest ratio of the velocity at the end to the largest one, of a record whose velocity and displacement count.
        Default 0.1; 0.25 with `at_rest`, where it is the ratio of what the line subtracts.
    baseline : str, optional
        Name of a correction of the baseline, done before anything is measured: "linear", "quadratic" or
        "highpass(0.1 Hz)". Default: none.
    gravity : float, optional
        m/s², of the Arias intensity; default that of the block, else 9.81.
    at_rest : bool, optional
        Whether it is the motion of a table, which begins and ends at rest: a line through the ends is subtracted from
        the velocity and from the displacement.

    Returns
    -------
    measured : IntensityMeasures

    Raises
    ------
    ValueError
        If a measure or a correction is not known, or an argument is out of its range.

    Examples
    --------
    >>> time = np.arange(2001) * 0.001
    >>> sine = Motion(3.0 * np.sin(2 * np.pi * time), 0.001)
    >>> found = intensity_measures(sine, measures=["pga", "pgv", "arias", "d5_95"])
    >>> {name: round(value, 3) for name, value in found.values.items()}
    {'pga': 3.0, 'pgv': 0.955, 'arias': 1.441, 'd5_95': 1.664}
    """
    instance("motion", motion, Motion)
    if block is not None:
        instance("block", block, Block)
    instance("at_rest", at_rest, bool)
    usual = LARGEST_DRIFT_AT_REST if at_rest else LARGEST_DRIFT
    drift = number("drift", usual if drift is None else drift, "a positive share of the peak velocity", above=0.0)
    if gravity is None:
        gravity = STANDARD_GRAVITY if block is None else block.gravity
    gravity = number("gravity", gravity, "a positive acceleration in m/s²", above=0.0)
    asked = _default(block) if measures is None else measures_of(measures)
    ground = corrected(Ground(motion.acceleration, motion.dt, gravity, at_rest), baseline)
    values, reasons = {}, {}
    for each in asked:
        values[each.id], reason = measured(each, ground, block, drift=drift)
        if reason:
            reasons[each.id] = reason
    return IntensityMeasures(values, reasons, ground.drift, drift, baseline)


def measured(
    measure: Measure, ground: Ground, block: Block | None = None, *, drift: float = LARGEST_DRIFT
) -> tuple[float, str]:
    """
    Evaluate one measure.

    Returns
    -------
    value : float
        SI; NaN where there is a reason.
    reason : str
        Why it has no value; empty if it has one.
    """
    if measure.needs_block and block is None:
        return float("nan"), "a block is needed"
    drifted = ground.drift_of_displacement if measure.id == "pgd" else ground.drift
    if measure.is_integrated and not drifted <= drift:
        return float("nan"), f"the record drifts, by {drifted:.2g} of its peak; at most {drift:g} was expected"
    with np.errstate(over="ignore", invalid="ignore"):
        value = measure.value(ground, block)
    if not np.isfinite(value):
        return float("nan"), "the motion is at rest, too short or beyond what can be computed"
    return value, ""


def table_measures(
    acceleration: Array, interval: float, gravity: float = STANDARD_GRAVITY
) -> tuple[dict[str, float], float]:
    """
    Measure pgv, pgd and arias of the motion of a table, SI, NaN if it drifts; and the share by which it does.

    A gap of the acceleration (m/s²) counts as zero.
    """
    ground = Ground(np.nan_to_num(acceleration), interval, gravity, at_rest=True)
    found = {name: measured(MEASURES[name], ground, drift=LARGEST_DRIFT_AT_REST)[0] for name in ("pgv", "pgd", "arias")}
    return found, ground.drift if ground.drift > LARGEST_DRIFT_AT_REST else ground.drift_of_displacement


def measures_of(names: Sequence[str]) -> list[Measure]:
    """Find measures by their ids; raises ValueError about `measures` if they are none."""
    if isinstance(names, str) or not isinstance(names, Sequence):
        raise ValueError(f'measures is {described(names)}; a list of ids was expected, such as ["pgv"]')
    try:
        return [measure_of(name) for name in names]
    except ValueError as error:
        raise ValueError(f"measures: {error}") from None


def _default(block: Block | None) -> list[Measure]:
    usual = [each for each in MEASURES.values() if block is not None or not each.needs_block]
    spectral = [measure_of(f"sa({period:g} s)") for period in PERIODS]
    return [*usual, *spectral]
