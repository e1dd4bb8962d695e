"""The zero of each channel: from its rest or as the campaign file says, and how far off it may be."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from colonnade.arrays import Array
from colonnade.dynamics.block import Block
from colonnade.errors import StageError
from colonnade.findings import MEASUREMENT, Finding, serious, warning
from colonnade.signals.rest import RestWindow, find_rest
from colonnade.stages.parts.clocks import ChannelOnClock

COUPLED = 0.08
"""Of gravity; an accelerometer that shows less than this of its part at rest does not sense what does not change."""


def rest_window(
    clock: Array,
    values: Mapping[str, Array],
    attributes: Mapping[str, Mapping[str, Any]],
    channels: Mapping[str, ChannelOnClock],
    *,
    zero: str | tuple[float, float],
    free_vibration: bool,
    duration: float,
    effects: Mapping[str, Effect],
    warnings: list[Finding],
) -> RestWindow | None:
    """
    Find the window of the true rest state: of a free vibration the end, of all others the start.

    Parameters
    ----------
    clock : ndarray, shape (n,)
        s.
    values, attributes, channels
        By channel: values (SI), attributes with its `noise`, and what is known of it.
    zero : str or (float, float)
        "auto", "start", "end", "none" or a stretch, s.
    free_vibration : bool
    duration : float
        Of the window, s.
    effects : mapping of str to Effect
        By channel, of those whose zero enters a result.
    warnings : list of Finding
        How far the zero may be off is added, where that matters.

    Returns
    -------
    window : RestWindow or None
        None if no zero is wanted.
    """
    if zero == "none":
        return None
    if not isinstance(zero, str):
        return RestWindow(*zero, quiet=True)
    end = zero == "end" or (zero == "auto" and free_vibration)
    noises = {
        name: (values[name], float(attributes[name]["noise"]))
        for name in _showing_rest({name: channels[name] for name in values}, free_vibration=free_vibration)
    }
    window = find_rest(clock, noises, end=end, duration=duration)
    if not window.quiet:
        known = {name: effect for name, effect in effects.items() if name in values}
        warnings += find_zero_error(clock, values, known, window, free_vibration=free_vibration)
    return window


def _showing_rest(channels: Mapping[str, ChannelOnClock], *, free_vibration: bool) -> list[str]:
    """Channels that show whether all stands still: positions and the table, or else the transducers on the specimen."""
    steady = [
        name
        for name, channel in channels.items()
        if channel.quantity in ("displacement", "angle")
        or (channel.quantity == "acceleration" and channel.on == "table" and not free_vibration)
    ]
    moving = ("acceleration", "angular_velocity")
    return steady or [name for name, channel in channels.items() if channel.quantity in moving]


def zeroed(
    clock: Array,
    values: Array,
    name: str,
    attributes: dict[str, Any],
    window: RestWindow,
    resting: float,
    warnings: list[Finding],
) -> Array | None:
    """
    Bring a channel to its true value at rest; what was taken off is noted in its attributes.

    Parameters
    ----------
    clock, values : ndarray, shape (n,)
        s; SI.
    name : str
        Of the channel.
    attributes : dict
        Of the channel; `zero`, `zero_window` and `noise` are set.
    window : RestWindow
    resting : float
        True value at rest, SI: gravity's part along an accelerometer on the upright specimen, 0 for all else.
    warnings : list of Finding

    Returns
    -------
    values : ndarray, shape (n,), or None
        None if the channel has no value in the window.

    Raises
    ------
    StageError
        If the window holds no sample.
    """
    inside = (clock >= window.start) & (clock <= window.stop)
    if not inside.any():
        raise StageError(
            f"zero: no sample is between {window.start:g} and {window.stop:g} s; the record goes from {clock[0]:.3g} "
            f"to {clock[-1]:.3g} s. Give an interval inside it."
        )
    still = values[inside][np.isfinite(values[inside])]
    if still.size == 0:
        warnings.append(
            serious(
                "channel left out",
                f"channel {name} is left out: it has no value from {window.start:.3g} to {window.stop:.3g} s, where "
                "the zero is taken. Give the test another `zero`.",
            )
        )
        return None
    attributes["zero"] = float(still.mean()) - resting
    attributes["zero_window"] = f"{window.start:.6g} s to {window.stop:.6g} s"
    if resting:
        attributes["rest_value"] = resting
        if abs(float(still.mean())) < COUPLED * abs(resting):
            warnings.append(
                warning(
                    "gravity",
                    f"channel {name}: at rest it shows {float(still.mean()):.3g} m/s², but gravity's part along it is "
                    f"{resting:.3g} m/s². The sensor or amplifier blocks constant values (AC), or was zeroed in the "
                    "recorder. Gravity was added to it.",
                )
            )
    if window.quiet:
        attributes["noise"] = max(float(still.std()), float(attributes["noise"]))
    return values - float(attributes["zero"])


PARTS = 4
"""Of a window; how far their means are from that of the window is the error of the zero."""

LARGEST_ANGLE = 0.01
"""Of the critical angle; a zero less certain than this is reported."""

LARGEST_ACCELERATION = 0.03
"""Of the acceleration that uplifts the specimen; a zero of the table less certain than this is reported."""

SERIOUS = 10.0
"""Times these, from which on results are wrong."""

MOST_WINDOWS = 10_000
"""Stretches of a record that are looked at for a better one."""


@dataclass(frozen=True)
class Effect:
    """
    What an error of a channel's zero does to a result.

    Attributes
    ----------
    factor : float
        Error of the result over that of the zero.
    unit : str
        Of the result: "rad" or "m/s²".
    scale : float
        What the result is compared with: the critical angle, or the acceleration that uplifts the specimen.
    """

    factor: float
    unit: str
    scale: float

    @property
    def largest(self) -> float:
        """Largest error of the result that is not reported."""
        return self.scale * (LARGEST_ANGLE if self.unit == "rad" else LARGEST_ACCELERATION)


def on_angle(lever: float, block: Block) -> Effect:
    """Effect of a transducer on the specimen with this lever (m; 1 of an inclinometer) on the rocking angle."""
    return Effect(1 / abs(lever), "rad", block.critical_angle)


def on_base(along: float, block: Block) -> Effect:
    """Effect of a table accelerometer with this part of its direction along x on the base acceleration."""
    return Effect(1 / abs(along), "m/s²", block.uplift_acceleration)


def find_zero_error(
    clock: Array,
    values: Mapping[str, Array],
    effects: Mapping[str, Effect],
    window: RestWindow,
    *,
    free_vibration: bool,
) -> list[Finding]:
    """
    Report how far the zero of a window that is not quiet may be off, if that matters.

    Parameters
    ----------
    clock : ndarray, shape (n,)
        s, even.
    values : mapping of str to ndarray, shape (n,)
        SI, by channel.
    effects : mapping of str to Effect
        Of the channels whose zero enters a result.
    window : RestWindow
        Used for the zero.
    free_vibration : bool
        A stretch before the release is not rest, however still it is: the specimen is held tilted.

    Returns
    -------
    findings : list of Finding
        At most one: the largest error with its size, and a stretch of the record that does not have it, if there is.
    """
    size = max(int(np.count_nonzero((clock >= window.start) & (clock <= window.stop))), PARTS)
    first = int(np.searchsorted(clock, window.start))
    errors = {name: _error(values[name][first : first + size]) * effect.factor for name, effect in effects.items()}
    shares = {name: errors[name] / effects[name].largest for name in errors}
    worst = max(shares, key=lambda name: shares[name], default=None)
    if worst is None or not shares[worst] > 1:
        return []
    effect = effects[worst]
    held = "the critical angle" if effect.unit == "rad" else "the acceleration that uplifts the specimen"
    result = "rocking angle" if effect.unit == "rad" else "base acceleration"
    weight = serious if shares[worst] > SERIOUS else warning
    return [
        weight(
            "zero",
            f"The zero of the {result} is uncertain by {errors[worst]:.2g} {effect.unit}, "
            f"{errors[worst] / effect.scale:.2g} of {held}: {worst} moves from {window.start:.3g} to "
            f"{window.stop:.3g} s, where zero is taken. {_advice(clock, values, effects, size, free_vibration)}",
            follows=(*MEASUREMENT, "hum"),
        )
    ]


def _error(stretch: Array) -> float:
    """How far the means of a stretch's parts are from its own; infinite if one has no value."""
    if not np.isfinite(stretch).any():
        return float("inf")
    means = np.array(
        [np.nanmean(part) if np.isfinite(part).any() else np.inf for part in np.array_split(stretch, PARTS)]
    )
    return float(np.abs(means - np.nanmean(stretch)).max())


def _advice(
    clock: Array, values: Mapping[str, Array], effects: Mapping[str, Effect], size: int, free_vibration: bool
) -> str:
    if free_vibration:
        return "Record until the specimen is still, or give the test a `zero` where it is upright."
    step = max(size // 2, (clock.size - size) // MOST_WINDOWS, 1)
    for first in range(0, clock.size - size, step):
        inside = slice(first, first + size)
        if all(_error(values[name][inside]) * effect.factor <= effect.largest / 2 for name, effect in effects.items()):
            start, stop = clock[first], clock[first + size - 1]
            return f'They are still from {start:.4g} s: zero = ["{start:.4g} s", "{stop:.4g} s"] avoids it.'
    return "No part of the record is quieter: start recording some time before the motion."
