"""The zero of each channel, taken where it is at rest, and how far off it may be."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from colonnade.arrays import Array
from colonnade.dynamics.block import Block
from colonnade.errors import StageError
from colonnade.findings import MEASUREMENT, Finding, serious, warning
from colonnade.signals.rest import RestWindow

COUPLED = 0.08
"""Of gravity; an accelerometer that shows less than this of its part at rest does not sense what does not change."""


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
    if abs(shown) < COUPLED * abs(resting):
        text = (
            f"channel {name}: at rest it shows {shown:.3g} m/s², but gravity's part along it is {resting:.3g} m/s². "
            "The sensor or amplifier blocks constant values (AC), or was zeroed in the recorder. Gravity was added to "
            "it."
        )
        warnings.append(warning("gravity", text))
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


class Effect(NamedTuple):
    """What an error of a channel's zero does to a result, of which an error up to `largest` is not reported."""

    result: str
    factor: float
    unit: str
    scale: float
    of_scale: str
    largest: float


def on_angle(lever: float, block: Block) -> Effect:
    """Effect of a transducer on the specimen with this lever (m; 1 of an inclinometer) on the rocking angle."""
    scale = block.critical_angle
    return Effect("rocking angle", 1 / abs(lever), "rad", scale, "the critical angle", LARGEST_ANGLE * scale)


def on_base(along: float, block: Block) -> Effect:
    """Effect of a table accelerometer with this part of its direction along x on the base acceleration."""
    scale, of_scale = block.uplift_acceleration, "the acceleration that uplifts the specimen"
    return Effect("base acceleration", 1 / abs(along), "m/s²", scale, of_scale, LARGEST_ACCELERATION * scale)


def find_zero_error(
    clock: Array,
    values: Mapping[str, Array],
    effects: Mapping[str, Effect],
    window: RestWindow,
    *,
    free_vibration: bool,
) -> list[Finding]:
    """
    Report the largest error of the zero of a window that is not quiet, if it matters, and a stretch without it.

    Of a free vibration a stretch before the release is not rest, however still it is: the specimen is held tilted.
    """
    size = max(int(np.count_nonzero((clock >= window.start) & (clock <= window.stop))), PARTS)
    first = int(np.searchsorted(clock, window.start))
    errors = {name: _error(values[name][first : first + size]) * effect.factor for name, effect in effects.items()}
    shares = {name: errors[name] / effects[name].largest for name in errors}
    worst = max(shares, key=lambda name: shares[name], default=None)
    if worst is None or not shares[worst] > 1:
        return []
    effect = effects[worst]
    weight = serious if shares[worst] > SERIOUS else warning
    text = (
        f"The zero of the {effect.result} is uncertain by {errors[worst]:.2g} {effect.unit}, "
        f"{errors[worst] / effect.scale:.2g} of {effect.of_scale}: {worst} moves from {window.start:.3g} to "
        f"{window.stop:.3g} s, where zero is taken. {_advice(clock, values, effects, size, free_vibration)}"
    )
    return [weight("zero", text, follows=(*MEASUREMENT, "hum"))]


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
