"""Identification of the coefficient of restitution from one free vibration."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from dataclasses import replace
from functools import partial
from math import exp, hypot, log
from typing import Any

import numpy as np
import scipy
from numpy.typing import ArrayLike

from colonnade.arrays import Array
from colonnade.dynamics.block import Block
from colonnade.dynamics.uncertainty import Uncertainty
from colonnade.identification.response.base_motion import table_moves
from colonnade.identification.restitution import departures, peaks
from colonnade.identification.restitution.estimator import METHOD, Estimated, estimate
from colonnade.identification.restitution.path import Path, UnfollowedError, prior_widths
from colonnade.identification.restitution.record import Record, objection, thinned
from colonnade.identification.restitution.result import (
    NO_IMPACTS,
    NO_PEAKS,
    Departure,
    Estimate,
    Joint,
    Peaks,
    Restitution,
)
from colonnade.identification.restitution.scatter import Solved
from colonnade.units.text import format_percent
from colonnade.validation import instance, number, samples

FEWEST_SAMPLES = 8
"""Of a record."""

LARGEST_ERROR = 0.01
"""Standard error of e above which no value is given."""

WIDEST = 2.0
"""ln e at most, where an interval ends; above 0 there is no e."""

FAR = 2.0
"""Prior widths beyond which a shift of α, of the gain or of p is a doubt."""

KNOWN = Uncertainty(critical_angle=0.005, p=0.005, angle_gain=0.005)
"""How well a laboratory knows its specimen if it does not say."""


def identify_restitution(
    time: ArrayLike,
    angle: ArrayLike,
    block: Block,
    *,
    level: float = 0.95,
    lowest_amplitude: float = 0.02,
    noise: float | None = None,
    lowpass: float | None = None,
    uncertainty: Uncertainty = KNOWN,
    out_of_plane: ArrayLike | None = None,
    slide: ArrayLike | None = None,
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
        none.
    uncertainty : Uncertainty, optional
        Of the block and the angle: `critical_angle`, `p` and `angle_gain` count. `Uncertainty()` is an exactly known
        block.
    out_of_plane, slide : array_like, shape (n,), optional
        Rotation about x (rad) and displacement of the pole (m), if measured: departures from plane rocking are then
        seen directly.
    base_acceleration : array_like, shape (n,), optional
        Of the base along x, m/s², at even steps. If it moves the table (`base_motion.table_moves`), and the angle is
        explained better so than by a table at rest and a noisy accelerometer, it drives the history.

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
    Penalised least squares on the samples: unknown are ln e and its departure at each impact, the first peak and its
    time, the zero and its drift; ln of α, of p and of the angle's gain as far as `uncertainty` says. If no history
    follows the record, the energies of its peaks give e. See docs/explanation/restitution.md.

    Examples
    --------
    >>> from colonnade.dynamics.rock import rock
    >>> block = Block.prism(width=0.086, depth=0.086, height=0.456, mass=26.10)
    >>> history = rock(block, theta0=0.09, restitution=0.9, duration=5.0, model="nonlinear")
    >>> round(identify_restitution(history.time, history.angle, block).value, 3)
    0.9
    """
    _check_settings(block, level, lowest_amplitude, noise, lowpass, uncertainty)
    times, measured = _checked(
        time, angle=angle, out_of_plane=out_of_plane, slide=slide, base_acceleration=base_acceleration
    )
    angles = measured["angle"]
    if np.isfinite(angles).sum() < FEWEST_SAMPLES:
        return _refused(f"The record holds fewer than {FEWEST_SAMPLES} values.", level, NO_PEAKS)
    record = Record.seen(thinned(times, angles, block), block, lowest_amplitude, noise)
    base = None
    if "base_acceleration" in measured and table_moves(measured["base_acceleration"], record.samples.step, block):
        base = measured["base_acceleration"] / block.gravity
    if reason := objection(record, base):
        return _refused(reason, level, record.peaks)
    follow = partial(_followed, widths=prior_widths(uncertainty), lowpass=lowpass)
    found, why = follow(record)
    driven, departing = False, list[Departure]()
    if base is not None:
        (recorded, why_not), (turned, _) = (
            follow(replace(record, samples=thinned(times, angles, block, sign * base))) for sign in (1.0, -1.0)
        )
        departing += departures.find_turned(turned, recorded, found)
        # An accelerometer may have more noise than a table at rest may move.
        better = found is None or (recorded is not None and recorded.path.power < found.path.power)
        driven = better or bool(departing) or (found is not None and departures.scatters(found))
        found, why = (recorded, why_not) if driven else (found, why)
    if not driven:
        record = record if found is None else replace(record, zero=found.zero)
        departing += departures.find_beside(times, measured, record)
    if found is not None and not (driven and departing):
        departing += departures.find_within(found, driven=driven)
    moves = driven if "base_acceleration" in measured else None
    return _result(record, found, why, uncertainty, level, departing, moves)


def _followed(record: Record, *, widths: Array, lowpass: float | None) -> tuple[Estimated | None, str]:
    """Follow a record from the first arc that enters; what is found, or why nothing is."""
    try:
        path = Path.through(record.samples, record.block, widths, lowpass, *record.run())
        return estimate(path, record.least), ""
    except (UnfollowedError, np.linalg.LinAlgError) as error:
        return None, f"No simulated history follows the record: {error}."


def _result(
    record: Record,
    found: Estimated | None,
    why: str,
    uncertainty: Uncertainty,
    level: float,
    departing: list[Departure],
    moves: bool | None,
) -> Restitution:
    """Give the value of the history, or if none follows the record that of the peaks."""
    fit, reason = None, "The table moves: it is taken to be at rest."
    if not moves:
        with suppress(np.linalg.LinAlgError):
            fit = peaks.fit_peaks(record.peaks, record.block, record.noise, uncertainty)
        reason = f"At least {peaks.FEWEST_PEAKS} peaks between two impacts, above the noise, are needed."
    of_history = _estimate("history", level, why if found is None else found.answer)
    of_peaks = _estimate("peaks", level, reason if fit is None else fit[0])
    chosen, zero, joint = of_peaks, 0.0, None
    if found is not None:
        chosen, zero, joint = of_history, found.zero - record.zero, found.joint
    elif chosen.value is not None and chosen.standard_error is not None:
        # Peaks say nothing of α and p.
        widths = np.array([chosen.standard_error / chosen.value, uncertainty.critical_angle, uncertainty.p])
        joint = Joint(np.array([log(chosen.value), 0.0, 0.0]), np.diag(widths**2))
    zero = zero if fit is None else float(fit[0].mean[2])
    refused = next((each.sentence for each in departing if each.refuses), "") or _objection(chosen, why)
    value, low, high, error = chosen.value, chosen.low, chosen.high, chosen.standard_error
    return Restitution(
        *((None, None, None, None) if refused else (value, low, high, error)),
        level,
        peaks.METHOD if found is None else METHOD,
        refused,
        zero_offset=record.zero + zero,
        peaks=record.peaks if fit is None else fit[1],
        impacts=NO_IMPACTS if moves else record.single_impacts(zero),
        estimates=(of_history, of_peaks),
        history=None if found is None else found.path.history,
        departures=tuple(departing),
        table_moves=moves,
        recommended="" if refused else chosen.name,
        joint=None if refused else joint,
        doubts=() if found is None else tuple(_doubts(found.joint, uncertainty)),
    )


def _estimate(name: str, level: float, solved: Solved | str) -> Estimate:
    """Return e from the distribution of ln e, or the reason why it is missing."""
    if isinstance(solved, str):
        return Estimate(name, level, solved)
    # A record that says next to nothing has an interval beyond all numbers.
    low, high = (exp(min(solved.quantile(0.5 + sign * level / 2), WIDEST)) for sign in (-1, 1))
    # Of the normal distribution whose interval is as wide.
    error = (high - low) / 2 / float(scipy.special.ndtri((1 + level) / 2))
    return Estimate(name, level, "", exp(min(float(solved.mean[0]), WIDEST)), low, high, error)


def _objection(chosen: Estimate, why: str) -> str:
    """Why no value is given; empty if it is."""
    if chosen.value is None or chosen.high is None or chosen.standard_error is None:
        return " ".join(dict.fromkeys(each for each in (why, chosen.reason) if each))
    if chosen.high >= 1:
        return (
            f"The motion does not decay: e would be {chosen.value:.4f}, between {chosen.low:.4f} and "
            f"{chosen.high:.4f}; below 1 was expected. A free vibration on a table at rest is needed."
        )
    if chosen.standard_error > LARGEST_ERROR:
        return (
            f"e would be {chosen.value:.3f} with a standard error of {chosen.standard_error:.1g}; at most "
            f"{LARGEST_ERROR:g} was expected. The amplitude is too low for this noise, or the impacts are too few or "
            "too unlike each other; release from a larger angle."
        )
    return ""


def _doubts(joint: Joint, uncertainty: Uncertainty) -> Iterator[tuple[str, str]]:
    """Doubts if the record asks for another block or angle than given."""
    scale, known = float(joint.mean[1]) + joint.gain, hypot(uncertainty.critical_angle, uncertainty.angle_gain)
    for kind, fitted, shift, width, check in (
        ("critical angle or gain", "a critical angle, or a gain of the angle,", scale, known,
         "the gains and lever arms of the transducers, and the dimensions of the block"),
        ("frequency parameter", "a frequency parameter p", float(joint.mean[2]), uncertainty.p,
         "the sampling rate, and the dimensions and the mass of the block"),
    ):  # fmt: skip
        if abs(shift) > FAR * width > 0:
            yield (
                kind,
                f"The record fits {fitted} that differs by {format_percent(shift, 1, signed=True)} from what was "
                f"given, {abs(shift) / width:.2g} times what its uncertainty allows. Check {check}.",
            )


def _refused(reason: str, level: float, seen: Peaks) -> Restitution:
    """Return a result without a value."""
    why = f"No value to start from: {reason}"
    estimates = _estimate("history", level, why), _estimate("peaks", level, why)
    return Restitution(None, None, None, None, level, METHOD, reason, peaks=seen, estimates=estimates)


def _check_settings(block: Any, level: Any, lowest_amplitude: Any, noise: Any, lowpass: Any, uncertainty: Any) -> None:
    instance("block", block, Block)
    number("level", level, "a probability between 0 and 1", above=0.0, below=1.0)
    number("lowest_amplitude", lowest_amplitude, "a fraction of the critical angle from 0 to 1", low=0.0, below=1.0)
    if noise is not None:
        number("noise", noise, "a standard deviation in rad, zero or more,", low=0.0)
    if lowpass is not None:
        number("lowpass", lowpass, "a positive frequency in Hz", above=0.0)
    instance("uncertainty", uncertainty, Uncertainty)


def _checked(time: Any, **measured: Any) -> tuple[Array, dict[str, Array]]:
    """Return times, and by name what was measured at them, checked."""
    times = samples("time", time, fewest=0)
    found = {
        name: samples(name, values, fewest=0, finite=False) for name, values in measured.items() if values is not None
    }
    for name, values in found.items():
        if values.shape != times.shape:
            raise ValueError(
                f"time has shape {times.shape} and {name} {values.shape}; arrays of one length were expected"
            )
    if times.size and not (np.diff(times) > 0).all():
        raise ValueError(f"time does not increase after sample {int(np.argmin(np.diff(times) > 0))}")
    # Copies: kernels are compiled for arrays that may be written, and once more for those of a file.
    return times.copy(), {name: values.copy() for name, values in found.items()}
