"""A single shock in a record: one short peak that is far larger than all else."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from colonnade.arrays import Array

STANDS_OUT = 3.0
"""Times the largest value elsewhere from which on a peak is a shock."""

LONGEST = 0.025
"""s above half the peak; what lasts longer is a motion."""

AROUND = 0.1
"""s on both sides of the peak that belong to it: filters ring, structures too."""


@dataclass(frozen=True)
class Shock:
    """When (s from the first sample), how large, how long (s, above half of it), and the largest value elsewhere."""

    time: float
    peak: float
    duration: float
    elsewhere: float


def single_shock(values: Array, interval: float) -> Shock | None:
    """
    Find a single shock.

    Parameters
    ----------
    values : ndarray, shape (n,)
        Any unit; NaN where missing.
    interval : float
        s.

    Returns
    -------
    shock : Shock or None
        None if the largest value is one of several alike, or lasts.

    Examples
    --------
    >>> motion = np.sin(np.arange(1000) * 0.05)
    >>> motion[500:503] += 5.0
    >>> shock = single_shock(motion, 0.005)
    >>> round(shock.time, 3), round(shock.duration, 3), round(shock.elsewhere, 2)
    (2.51, 0.015, 1.0)
    >>> single_shock(np.sin(np.arange(1000) * 0.05), 0.005) is None
    True
    """
    size = np.abs(np.nan_to_num(values))
    if size.size == 0:
        return None
    at = int(size.argmax())
    reach = max(round(AROUND / interval), 1)
    elsewhere = max(size[: max(at - reach, 0)].max(initial=0.0), size[at + reach + 1 :].max(initial=0.0))
    peak = float(size[at])
    if not peak > STANDS_OUT * elsewhere > 0:
        return None
    high = size > 0.5 * peak
    first = at - int(np.argmin(high[at::-1])) + 1 if not high[: at + 1].all() else 0
    last = at + int(np.argmin(high[at:])) - 1 if not high[at:].all() else size.size - 1
    duration = (last - first + 1) * interval
    return Shock(at * interval, float(values[at]), duration, float(elsewhere)) if duration <= LONGEST else None
