"""Arguments of the identification of e, as they come from a notebook."""

from __future__ import annotations

from typing import Any

import numpy as np

from colonnade.arrays import Array
from colonnade.dynamics.block import Block
from colonnade.validation import described, instance, number, samples

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
