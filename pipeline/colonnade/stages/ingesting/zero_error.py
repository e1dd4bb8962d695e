"""Error of a zero in the units of the results: the rocking angle and the base acceleration."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from colonnade.arrays import Array
from colonnade.dynamics.block import Block
from colonnade.findings import MEASUREMENT, Finding, serious, warning
from colonnade.signals.rest import RestWindow

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
