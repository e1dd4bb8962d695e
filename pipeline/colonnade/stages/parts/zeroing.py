"""The zero of each channel, taken where it is at rest, and how far off it may be."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from colonnade.arrays import Array
from colonnade.errors import StageError
from colonnade.findings import MEASUREMENT, Finding, serious, warning
from colonnade.identification.plausibility.scale import as_expected, cause
from colonnade.signals.rest import RestWindow

COUPLED = 0.08
"""Of gravity; an accelerometer that shows less than this of its part at rest does not sense what does not change."""


SENSES_GRAVITY = 7.0
"""m/s², that gravity's part along an accelerometer has to have before its value at rest is judged."""


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
    Bring a channel to its true value at rest, `resting` (SI); None if it has no value in the window.

    What was taken off is noted in its attributes: `zero`, `zero_window` and `noise` are set.
    """
    inside = (clock >= window.start) & (clock <= window.stop)
    if not inside.any():
        raise StageError(
            f"zero: no sample is between {window.start:g} and {window.stop:g} s; the record goes from {clock[0]:.3g} "
            f"to {clock[-1]:.3g} s. Give an interval inside it."
        )
    still = values[inside][np.isfinite(values[inside])]
    if still.size == 0:
        text = (
            f"channel {name} is left out: it has no value from {window.start:.3g} to {window.stop:.3g} s, where the "
            "zero is taken. Give the test another `zero`."
        )
        warnings.append(serious("channel left out", text))
        return None
    shown = float(still.mean())
    attributes["zero"] = shown - resting
    attributes["zero_window"] = f"{window.start:.6g} s to {window.stop:.6g} s"
    if resting:
        attributes["rest_value"] = resting
        warnings += _of_gravity(name, shown, resting)
    if window.quiet:
        attributes["noise"] = max(float(still.std()), float(attributes["noise"]))
    return values - float(attributes["zero"])


def _of_gravity(name: str, shown: float, resting: float) -> list[Finding]:
    """Doubts about an accelerometer on the specimen, by what it shows of gravity at rest, m/s²."""
    text = f"Channel {name} shows {shown:.3g} m/s² at rest, but gravity's part along it is {resting:.3g} m/s²"
    if abs(shown) < COUPLED * abs(resting):
        text += (
            ": the sensor or amplifier blocks constant values (AC), or was zeroed in the recorder. Gravity was added."
        )
        return [warning("gravity", text)]
    ratio = shown / resting
    if abs(resting) < SENSES_GRAVITY or (ratio > 0 and as_expected(ratio)):
        return []
    if as_expected(ratio):
        return [serious("sign", f"{text}: its sign is wrong.")]
    return [serious("gain", f"{text}: {cause(ratio, 'acceleration')}.")]


PARTS = 4
"""Of a window; how far their means are from that of the window is the error of the zero."""

SERIOUS = 10.0
"""Times the largest error that is not reported, from which on results are wrong."""


class Effect(NamedTuple):
    """What an error of a channel's zero does to a result, whose error up to a share of a scale is not reported."""

    result: str
    factor: float
    unit: str
    scale: float
    of_scale: str
    share: float


def find_zero_error(
    clock: Array, values: Mapping[str, Array], effects: Mapping[str, Effect], window: RestWindow
) -> list[Finding]:
    """Report the largest error of the zero of a window that is not quiet, if it matters."""
    first = int(np.searchsorted(clock, window.start))
    inside = slice(first, first + max(int(((clock >= window.start) & (clock <= window.stop)).sum()), PARTS))
    errors = {name: _error(values[name][inside]) * effect.factor / effect.scale for name, effect in effects.items()}
    worst = max(errors, key=lambda name: errors[name] / effects[name].share, default=None)
    if worst is None or not errors[worst] > effects[worst].share:
        return []
    effect, error = effects[worst], errors[worst]
    rest = "Record until the specimen is still" if window.start > clock[0] else "Start recording before the motion"
    text = (
        f"The zero of the {effect.result} is uncertain by {error * effect.scale:.2g} {effect.unit}, {error:.2g} of "
        f"{effect.of_scale}: {worst} moves from {window.start:.3g} to {window.stop:.3g} s, where zero is taken. "
        f"{rest}, or give the test a `zero` where it is upright."
    )
    weight = serious if error > SERIOUS * effect.share else warning
    return [weight("zero", text, follows=MEASUREMENT)]


def _error(stretch: Array) -> float:
    """How far the means of a stretch's parts are from its own; infinite if one has no value."""
    parts = np.array_split(stretch, PARTS)
    if not all(np.isfinite(part).any() for part in parts):
        return float("inf")
    return float(np.abs(np.array([np.nanmean(part) for part in parts]) - np.nanmean(stretch)).max())
