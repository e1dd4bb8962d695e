"""The misfit of the paper at Span 2.5: a computed response that grows large when the measured one has died down."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from scipy.ndimage import maximum_filter1d

from colonnade.arrays import Array
from colonnade.dynamics.block import Block
from colonnade.dynamics.history import amplitude, capped


@dataclass(frozen=True)
class Criterion:
    """
    Numbers of the criterion, fixed before anything was computed (`span-2.5-design.md`).

    Attributes
    ----------
    quiet : float
        |θ|/α below which a response has died down.
    before : float
        s that it has been quiet.
    loud : float
        |θ|/α above which a response is large. The quiet response stays below half of it.
    after : float
        s within which the other one becomes large.
    """

    quiet: float = 0.1
    before: float = 1.0
    loud: float = 0.4
    after: float = 2.0


@dataclass(frozen=True)
class Response:
    """
    A measured or predicted history, at equal steps.

    Attributes
    ----------
    angle : ndarray, shape (n,)
        rad.
    dt : float
        s.
    overturning_time : float
        s; NaN for a block that stands. From there on the block stays at its critical angle.
    block : Block
        Whose critical angles the angle is compared with.
    """

    angle: Array
    dt: float
    overturning_time: float
    block: Block
    _windows: dict[tuple[float, bool], Array] = field(default_factory=dict, init=False, repr=False)

    @cached_property
    def ratio(self) -> Array:
        """|θ|/α, at most 1, shape (n,)."""
        inside = capped(np.arange(self.angle.size) * self.dt, self.angle, self.overturning_time, self.block)
        return amplitude(inside, self.block)

    @cached_property
    def largest_so_far(self) -> Array:
        """Largest |θ|/α up to each sample, shape (n,)."""
        return np.maximum.accumulate(self.ratio)

    @property
    def overturns(self) -> bool:
        """Whether the block overturns."""
        return bool(np.isfinite(self.overturning_time))

    def largest_before(self, window: float) -> Array:
        """Largest |θ|/α in the `window` (s) that ends at each sample, shape (n,)."""
        return self._largest(window, ahead=False)

    def largest_after(self, window: float) -> Array:
        """Largest |θ|/α in the `window` (s) that begins at each sample, shape (n,); at the end as much as there is."""
        return self._largest(window, ahead=True)

    def _largest(self, window: float, *, ahead: bool) -> Array:
        if (window, ahead) not in self._windows:
            samples = round(window / self.dt)
            values = self.ratio[::-1] if ahead else self.ratio
            largest = maximum_filter1d(values, samples + 1, origin=samples // 2, mode="constant", cval=0.0)
            self._windows[window, ahead] = largest[::-1] if ahead else largest
        return self._windows[window, ahead]


def place_of_growth(quiet: Response, growing: Response, criterion: Criterion) -> float:
    """
    Find where one response grows large after the other has died down.

    Parameters
    ----------
    quiet, growing : Response
        Of the same clock. For the paper's pattern the measured and the predicted one.
    criterion : Criterion

    Returns
    -------
    place : float
        s, of the largest |growing| within `criterion.after` of the first instant t for which: |quiet| was above
        `criterion.quiet` earlier; was below it for `criterion.before` up to t; stays below half of `criterion.loud` for
        `criterion.after` from t on; and |growing| passes `criterion.loud` within that time, and is larger in it than in
        the `criterion.before` up to t. NaN if there is no such instant.
    """
    if growing.largest_so_far[-1] <= criterion.loud or quiet.largest_so_far[-1] < criterion.quiet:
        return float("nan")
    later = growing.largest_after(criterion.after)
    found = (
        (later > criterion.loud)
        & (later > growing.largest_before(criterion.before))
        & (quiet.largest_before(criterion.before) < criterion.quiet)
        & (quiet.largest_so_far >= criterion.quiet)
        & (quiet.largest_after(criterion.after) < 0.5 * criterion.loud)
    )
    if not found.any():
        return float("nan")
    first = int(np.argmax(found))
    until = first + round(criterion.after / growing.dt) + 1
    return float((first + np.argmax(growing.ratio[first:until])) * growing.dt)
