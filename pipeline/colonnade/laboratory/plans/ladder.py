"""
Amplitudes of the sine tests: a ladder at each frequency, through both boundaries of the map.

Within 1 % in A of a step the true outcome does not change, so that what becomes of a test does not hang on the last
digits of the table's motion; tests/laboratory/plans/test_ladder.py looks at every step's neighbourhood. At 1 and 2 Hz a
specimen that rocks at all overturns: no band of lasting rocking is wide enough for a step. From 3 Hz on rocking lasts,
at large amplitudes also sub-harmonic, and beyond the first overturning amplitude islands are survived: of 3 Hz the step
at 1.80 is one.
"""

from __future__ import annotations

from colonnade.units import format_percent

MARGIN = 0.01
"""Relative change of A within which the true outcome of every step stays the same."""

KEPT_AWAY = (
    f"The amplitudes of the virtual sine tests keep at least {format_percent(MARGIN)} away from the boundaries between "
    "outcomes, so that outcomes are easier to get right here than in a laboratory."
)
"""What is said with every number of right outcomes."""

Ladder = dict[float, tuple[float, ...]]
"""A = a/(g tan α) of the steps, by frequency in Hz."""

CYCLES = {1.0: 10, 2.0: 15}
"""Cycles at full amplitude by frequency in Hz, where rocking does not last."""

LASTING = 60
"""Cycles at full amplitude at all other frequencies: transients take 20 to 50 of them to die."""

RAMPS = {7.0: 6}
"""Cycles of the ramps before and after by frequency in Hz: with a shorter one no amplitude at 7 Hz overturns surely."""

RAMP = 3
"""Cycles of each ramp at all other frequencies."""

PRISM: Ladder = {
    1.0: (0.90, 0.98, 1.05, 1.20),
    2.0: (0.90, 0.98, 1.25, 1.36),
    3.0: (0.90, 0.98, 1.23, 1.59, 1.80, 2.20),
    4.0: (0.90, 0.98, 1.06, 1.20, 1.40, 1.80, 2.22, 2.55, 2.80),
    5.0: (0.98, 1.07, 1.30, 1.60, 2.00, 2.45, 2.61, 3.65),
    6.0: (0.98, 1.07, 1.35, 1.80, 2.40, 3.00, 3.39, 4.80),
    7.0: (0.98, 1.07, 1.40, 1.90, 2.60, 3.10, 4.09, 4.60, 6.24),
}
"""For the prism of e = 0.976."""

CYLINDER: Ladder = {4.0: (0.98, 1.07, 1.50, 2.00, 2.22, 2.47, 2.85)}
"""For the cylinder of e = 0.970."""

CONE: Ladder = {4.0: (0.98, 1.07, 1.50, 2.00, 2.25, 2.57, 2.88)}
"""For the truncated cone of e = 0.962."""
