"""Zero: the stretch in which specimen and table are still; each channel's value there is subtracted."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from colonnade.arrays import Array
from colonnade.errors import StageError
from colonnade.findings import Finding, serious, warning
from colonnade.signals.rest import RestWindow, find_rest
from colonnade.stages.ingesting.clocks import ChannelOnClock
from colonnade.stages.ingesting.zero_error import Effect, find_zero_error

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
