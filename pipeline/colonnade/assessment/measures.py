"""The measures of a ground motion by their ids, in one table, and those of one motion or why it has none."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from math import nan, pi

import numpy as np

from colonnade.arrays import Array
from colonnade.assessment.ground import (
    LARGEST_DRIFT,
    LARGEST_DRIFT_AT_REST,
    NONE,
    Ground,
    correction_of,
    integral,
    split_name,
)
from colonnade.dynamics.block import STANDARD_GRAVITY, Block
from colonnade.dynamics.motion import Motion
from colonnade.errors import nearest
from colonnade.units.text import Digested, written
from colonnade.validation import described, instance, number

PERIODS = (0.2, 0.5, 1.0, 2.0)
"""s, of the spectral accelerations that are given if no measures are asked for."""

UNITS = {"acceleration": "m/s²", "velocity": "m/s", "length": "m", "time": "s"}
"""SI units of the measures by their dimension, as they are written for people."""


@dataclass(frozen=True)
class Measure:
    """
    A measure of a ground motion.

    Attributes
    ----------
    id : str
        Its name in files and options.
    symbol, name : str
    dimension : str
        A key of `UNITS`, and of `units.DIMENSIONS`.
    power : int
        A motion n times as strong has n**power times the measure; 0 of one that does not grow with it.
    value : callable
        Of a motion, SI.
    is_integrated : bool
        Whether it needs a record without drift.
    """

    id: str
    symbol: str
    name: str
    dimension: str
    power: int
    value: Callable[[Ground], float]
    is_integrated: bool = False

    @property
    def unit(self) -> str:
        """SI, as it is written for people."""
        return UNITS[self.dimension]


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
    at_rest: bool = False,
) -> IntensityMeasures:
    """
    Measure how strong a ground motion is.

    Parameters
    ----------
    motion : Motion
        Its acceleration along x counts.
    block : Block, optional
        Whose gravity counts in the Arias intensity; without it 9.81 m/s².
    measures : sequence of str, optional
        Ids, such as "pgv" or "sa(0.5 s)". Default: all, with spectral accelerations at `PERIODS`.
    drift : float, optional
        Largest ratio of the velocity at the end to the largest one, of a record whose velocity and displacement count.
        Default 0.1; 0.25 with `at_rest`, where it is the ratio of what the line subtracts.
    baseline : str, optional
        Name of a correction of the baseline, done before anything is measured: "linear", "quadratic" or
        "highpass(0.1 Hz)". Default: none.
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
    instance("at_rest", at_rest, bool)
    if drift is None:
        drift = LARGEST_DRIFT_AT_REST if at_rest else LARGEST_DRIFT
    number("drift", drift, "a positive share of the peak velocity", above=0.0)
    gravity = STANDARD_GRAVITY if block is None else instance("block", block, Block).gravity
    usual = [*MEASURES, *(f"sa({period:g} s)" for period in PERIODS)]
    asked = measures_of(usual if measures is None else measures)
    ground = Ground(correction_of(baseline)(motion.acceleration, motion.dt), motion.dt, gravity, at_rest)
    values, reasons = {}, {}
    for each in asked:
        values[each.id], reason = measured(each, ground, drift)
        if reason:
            reasons[each.id] = reason
    return IntensityMeasures(values, reasons, ground.drift, drift, baseline)


def measured(measure: Measure, ground: Ground, drift: float) -> tuple[float, str]:
    """
    Evaluate one measure.

    Returns
    -------
    value : float
        SI; NaN where there is a reason.
    reason : str
        Why it has no value; empty if it has one.
    """
    drifted = ground.drift_of_displacement if measure.id == "pgd" else ground.drift
    if measure.is_integrated and not drifted <= drift:
        return float("nan"), f"the record drifts, by {drifted:.2g} of its peak; at most {drift:g} was expected"
    with np.errstate(over="ignore", invalid="ignore"):
        value = measure.value(ground)
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
    found = {name: measured(MEASURES[name], ground, LARGEST_DRIFT_AT_REST)[0] for name in ("pgv", "pgd", "arias")}
    return found, ground.drift if ground.drift > LARGEST_DRIFT_AT_REST else ground.drift_of_displacement


def measures_of(names: Sequence[str]) -> list[Measure]:
    """Find measures by their ids; raises ValueError about `measures` if they are none."""
    if isinstance(names, str) or not isinstance(names, Sequence):
        raise ValueError(f'measures is {described(names)}; a list of ids was expected, such as ["pgv"]')
    try:
        return [measure_of(name) for name in names]
    except ValueError as error:
        raise ValueError(f"measures: {error}") from None


def measure_of(name: str) -> Measure:
    """
    Find a measure by its id; a spectral acceleration is "sa(0.5 s)", with its period.

    Raises
    ------
    ValueError
        If it is not known, or its period is not a positive time.

    Examples
    --------
    >>> measure_of("pgv").unit, measure_of("sa(500 ms)").id
    ('m/s', 'sa(0.5 s)')
    """
    bare, period = split_name(instance("measure", name, str, "the id of a measure of intensity"), {"sa": "time"})
    if period is not None:
        of = f"({period:.6g} s)"
        return Measure(f"sa{of}", f"Sa{of}", "spectral acceleration", "acceleration", 1, partial(_spectral, period))
    if bare == "sa":
        raise ValueError('"sa" has no period; one was expected in brackets, such as "sa(0.5 s)"')
    if bare not in MEASURES:
        raise ValueError(f'Unknown measure of intensity "{name}".{nearest(name, (*MEASURES, "sa(0.5 s)"))}')
    return MEASURES[bare]


def _peak_acceleration(ground: Ground) -> float:
    """max |a|."""
    return float(np.abs(ground.acceleration).max())


def _peak_velocity(ground: Ground) -> float:
    """max |v|, v = ∫ a dt."""
    return float(np.abs(ground.velocity).max())


def _peak_displacement(ground: Ground) -> float:
    """max |∫ v dt|."""
    return float(np.abs(ground.displacement).max())


def _arias(ground: Ground) -> float:
    """π/(2g) ∫ a² dt (Arias 1970)."""
    return float(pi / (2 * ground.gravity) * integral(ground.acceleration**2, ground.interval)[-1])


def _significant_duration(ground: Ground) -> float:
    """Time in which ∫ a² dt grows from 5 to 95 % of its final value (Trifunac and Brady 1975)."""
    energy = integral(ground.acceleration**2, ground.interval)
    if not energy[-1] > 0.0:
        return nan
    begin, end = np.interp(energy[-1] * np.array([0.05, 0.95]), energy, ground.interval * np.arange(energy.size))
    return float(end - begin)


def _spectral(period: float, ground: Ground) -> float:
    """Pseudo-acceleration ω² max |u| of an oscillator, damped by 5 % (Nigam and Jennings 1969)."""
    from colonnade.dynamics.spectra import response_spectrum  # it loads scipy

    return float(response_spectrum(ground.acceleration, ground.interval, [period])[0])


_TABLE = (
    Measure("pga", "PGA", "peak ground acceleration", "acceleration", 1, _peak_acceleration),
    Measure("pgv", "PGV", "peak ground velocity", "velocity", 1, _peak_velocity, is_integrated=True),
    Measure("pgd", "PGD", "peak ground displacement", "length", 1, _peak_displacement, is_integrated=True),
    Measure("arias", "I_A", "Arias intensity", "velocity", 2, _arias),
    Measure("d5_95", "D₅₋₉₅", "significant duration", "time", 0, _significant_duration),
)
MEASURES = {each.id: each for each in _TABLE}
"""All measures by id, in the order of tables."""
