"""Identification of the coefficient of restitution from one free vibration, by all estimators."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from colonnade.arrays import Array
from colonnade.dynamics.block import Block
from colonnade.identification.restitution.choice import RULE, choose
from colonnade.identification.restitution.departures.findings import find_departures
from colonnade.identification.restitution.departures.free_rocking import objection
from colonnade.identification.restitution.departures.single_impacts import found_by_impact, scatters
from colonnade.identification.restitution.departures.two_sides import LEAST_TILT, UNEQUAL_SIDES
from colonnade.identification.restitution.estimators.history import NonlinearHistory
from colonnade.identification.restitution.estimators.history_scatter import ScatteredHistory
from colonnade.identification.restitution.estimators.impact_by_impact import ImpactByImpact
from colonnade.identification.restitution.estimators.peaks import PeakDecay
from colonnade.identification.restitution.estimators.registry import CANDIDATES, ESTIMATORS
from colonnade.identification.restitution.fitting.driven_decay import BaseMotion, moving_base
from colonnade.identification.restitution.fitting.samples import thinned
from colonnade.identification.restitution.free_vibration import FreeVibration
from colonnade.identification.restitution.result import Departure, Peaks, Restitution
from colonnade.validation import described, instance, number, samples

FEWEST_SAMPLES = 8
FEWEST_PEAKS = 2


def identify_restitution(
    time: ArrayLike,
    angle: ArrayLike,
    block: Block,
    *,
    level: float = 0.95,
    lowest_amplitude: float = 0.02,
    noise: float | None = None,
    lowpass: float | None = None,
    free: tuple[str, ...] = (),
    out_of_plane: ArrayLike | None = None,
    slide: ArrayLike | None = None,
    uplift: ArrayLike | None = None,
    base_acceleration: ArrayLike | None = None,
) -> Restitution:
    """
    Identify the coefficient of restitution from a free vibration.

    Parameters
    ----------
    time, angle : array_like, shape (n,)
        s, increasing; rad, about the rest position. Missing samples are NaN.
    block : Block
    level : float, optional
        Probability of the interval of confidence, 0 to 1.
    lowest_amplitude : float, optional
        Peaks with |θ|/α below it are left out, as are those that do not stand out of the noise.
    noise : float, optional
        Standard deviation of the angle at rest, rad; default: from the record itself.
    lowpass : float, optional
        Cut-off of the zero-phase low-pass (Butterworth, order 4, both ways) that the record went through, Hz; default:
        found from the residuals of the fit.
    free : tuple of {"critical_angle", "p"}, optional
        What the whole histories identify with e: worn edges, an uncertain inertia.
    out_of_plane, slide, uplift : array_like, shape (n,), optional
        Rotation about x (rad), displacement of the pole and height of the base (m), if measured: departures from
        plane rocking are then seen directly.
    base_acceleration : array_like, shape (n,), optional
        Of the base along x, m/s², at even steps. If it moves the table (`base_motion.table_moves`), and the angle is
        explained better so than by a table at rest and a noisy accelerometer, it drives the history; only the whole
        history with an e of its own at each impact can follow that.

    Returns
    -------
    result : Restitution
        `value` is None, with a `reason`, if the record does not give e.

    Raises
    ------
    ValueError
        If an argument is out of its range or of another kind, time and angle differ in shape, or time does not
        increase.

    Notes
    -----
    Each `Estimate` says what its estimator assumes. All are made; one is recommended (`choice.RULE`). Each impact
    multiplies the energy of the peaks by e² (Housner 1963).

    Examples
    --------
    >>> from colonnade.dynamics.rock import rock
    >>> block = Block.prism(width=0.086, depth=0.086, height=0.456, mass=26.10)
    >>> history = rock(block, theta0=0.09, restitution=0.9, duration=5.0)
    >>> round(identify_restitution(history.time, history.angle, block).value, 3)
    0.9
    """
    free = check_settings(
        block, level=level, lowest_amplitude=lowest_amplitude, noise=noise, lowpass=lowpass, free=free
    )
    times, angles = check_records(
        time, angle, out_of_plane=out_of_plane, slide=slide, uplift=uplift, base_acceleration=base_acceleration
    )
    if np.isfinite(angles).sum() < FEWEST_SAMPLES:
        return _refused(f"The record holds fewer than {FEWEST_SAMPLES} values.", level, Peaks())
    record = FreeVibration.seen(
        thinned(times, angles, block), block,
        lowest_amplitude=lowest_amplitude, noise=noise, level=level, lowpass=lowpass, free=free,
    )  # fmt: skip
    if reason := _no_free_rocking(record):
        return _refused(reason, level, record.peaks)
    try:
        record = _driven(record, moving_base(times, base_acceleration, block))
    except ValueError as error:
        return _refused(str(error), level, record.peaks)
    zero = record.fitted(ScatteredHistory()).zero_offset
    departures: tuple[Departure, ...] = ()
    if record.base is not None:
        record = replace(record, zero=zero)
    else:
        # Impacts are where the angle passes its true zero.
        record = record.about(zero)
        departures = _departures(record, times, angles - zero, out_of_plane=out_of_plane, slide=slide, uplift=uplift)
        record = record.without_first(max((departure.left_out for departure in departures), default=0))
        if scatters(record.fitted(ScatteredHistory())):
            measured = {"out_of_plane": out_of_plane, "slide": slide, "uplift": uplift}
            record, departures = _on_tilted_table(record, departures, times, angles - zero, **measured)
    whole = record.fitted(ScatteredHistory())
    result = _result(record, departures + found_by_impact(whole, driven=record.base is not None))
    return replace(result, table_moves=None if base_acceleration is None else record.base is not None)


def _driven(record: FreeVibration, base: BaseMotion | None) -> FreeVibration:
    """
    Let the recorded motion of the table drive the history, unless a table at rest explains the angle better.

    An accelerometer may have more noise than a table at rest may move. A motion that did not happen spoils the history;
    one that did, and is left out, makes e of single impacts scatter.
    """
    if base is None:
        return record
    driven = replace(record, base=base, fits={})
    at_rest = record.fitted(ScatteredHistory())
    if at_rest.estimate.residual is None or scatters(at_rest):
        return driven
    with_motion = driven.fitted(ScatteredHistory()).estimate.residual
    return driven if with_motion is not None and with_motion < at_rest.estimate.residual else record


def _on_tilted_table(
    record: FreeVibration, departures: tuple[Departure, ...], time: Array, angle: Array, **measured: ArrayLike | None
) -> tuple[FreeVibration, tuple[Departure, ...]]:
    """Give the block the sides that a tilted table makes, if e of single impacts scatters no more then."""
    found = _departures(record, time, angle, least_tilt=0.0, **measured)
    for sides in (each for each in found if each.name == UNEQUAL_SIDES):
        block = record.block
        negative, positive = (
            replace(side, critical_angle=side.critical_angle + sign * sides.size)
            for side, sign in zip(block.sides, (-1.0, 1.0), strict=True)
        )
        tilted = replace(record, block=replace(block, negative=negative, positive=positive), fits={})
        if not scatters(tilted.fitted(ScatteredHistory())):
            return tilted, (*(each for each in departures if each.name != UNEQUAL_SIDES), sides)
    return record, departures


def _departures(
    record: FreeVibration, time: Array, angle: Array, *, least_tilt: float = LEAST_TILT, **measured: ArrayLike | None
) -> tuple[Departure, ...]:
    """Find the departures that arcs and samples show; the angle (rad) is about its zero."""
    arcs, (impact_time, covariance) = record.arcs, record.arcs.impacts
    return find_departures(
        time,
        angle,
        record.block,
        impact_time=impact_time,
        impact_standard_error=np.sqrt(np.diag(covariance)),
        peak_angle=arcs.peak_angle,
        peak_standard_error=arcs.peak_standard_error,
        used=record.usable,
        least_tilt=least_tilt,
        **measured,
    )


def _no_free_rocking(record: FreeVibration) -> str:
    """Why the record is not a free rocking of the block from which e could be found; empty if it is."""
    count = int(record.usable.sum())
    if count >= FEWEST_PEAKS:
        return objection(record.arcs, record.usable, record.block)
    return (
        f"At least {FEWEST_PEAKS} peaks between two impacts, above "
        f"{record.lowest / record.block.critical_angle:.2g} of the critical angle, are needed; the record has {count}."
    )


def _result(record: FreeVibration, departures: tuple[Departure, ...]) -> Restitution:
    """Gather what all estimators give, with the value of the recommended one unless a departure refuses it."""
    peaks, impacts = record.fitted(PeakDecay()), record.fitted(ImpactByImpact())
    chosen, reason = choose([record.fitted(each) for each in CANDIDATES])
    refusing = [departure.sentence for departure in departures if departure.refuses]
    if refusing:
        chosen, reason = None, refusing[0]
    result = Restitution(
        None,
        None,
        None,
        None,
        record.level,
        RULE,
        reason,
        zero_offset=record.zero + peaks.zero_offset,
        peaks=peaks.peaks or record.peaks,
        impacts=impacts.impacts,
        estimates=tuple(record.fitted(each).estimate for each in ESTIMATORS.values()),
        history=record.fitted(ScatteredHistory()).fitted or record.fitted(NonlinearHistory()).fitted,
        departures=departures,
        constancy=impacts.constancy,
    )
    if chosen is None:
        return result
    return replace(
        result,
        value=chosen.value,
        low=chosen.low,
        high=chosen.high,
        standard_error=chosen.standard_error,
        method=ESTIMATORS[chosen.name].method,
        recommended=chosen.name,
    )


def _refused(reason: str, level: float, peaks: Peaks) -> Restitution:
    """Return a result without a value, from no estimator."""
    refused = (each.refuse(level, f"No value to start from: {reason}") for each in ESTIMATORS.values())
    estimates = tuple(each.estimate for each in refused)
    return Restitution(None, None, None, None, level, RULE, reason, peaks=peaks, estimates=estimates)


FREED = ("critical_angle", "p")
"""What may be identified with e."""


def check_settings(
    block: Any, *, level: Any, lowest_amplitude: Any, noise: Any, lowpass: Any, free: Any
) -> tuple[str, ...]:
    """
    Check the settings given to `identify_restitution`; return `free`.

    Raises
    ------
    ValueError
        If an argument is out of its range or of another kind; the message names it.
    """
    instance("block", block, Block)
    number("level", level, "a probability between 0 and 1", above=0.0, below=1.0)
    number("lowest_amplitude", lowest_amplitude, "a fraction of the critical angle from 0 to 1", low=0.0, below=1.0)
    if noise is not None:
        number("noise", noise, "a standard deviation in rad, zero or more,", low=0.0)
    if lowpass is not None:
        number("lowpass", lowpass, "a positive frequency in Hz", above=0.0)
    if not isinstance(free, (tuple, list)):
        raise ValueError(f"free is {described(free)}; a tuple of names was expected, such as ('p',)")
    if unknown := [name for name in free if not isinstance(name, str) or name not in FREED]:
        raise ValueError(f"free names {unknown[0]!r}; 'critical_angle' and 'p' were expected")
    return tuple(free)


def check_records(time: Any, angle: Any, **others: Any) -> tuple[Array, Array]:
    """
    Check time and angle, and what was measured with them (None if it was not); return the two.

    Raises
    ------
    ValueError
        If one is not an array of real numbers, they differ in shape or time does not increase.
    """
    times, angles = samples("time", time, fewest=0), samples("angle", angle, fewest=0, finite=False)
    for name, values in {"angle": angles, **others}.items():
        if values is not None and samples(name, values, fewest=0, finite=False).shape != times.shape:
            raise ValueError(
                f"time has shape {times.shape} and {name} {np.shape(values)}; arrays of one length were expected"
            )
    if times.size and not (np.diff(times) > 0).all():
        raise ValueError(f"time does not increase after sample {int(np.argmin(np.diff(times) > 0))}")
    return times, angles
