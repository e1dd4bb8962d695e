"""Whether the block comes down within a piece of an arc, by bounds on the derivatives of its height."""

from __future__ import annotations

from colonnade.dynamics.kernel import kernel

Jet = tuple[float, float, float, float]
"""Height above the base, s θ, and its first three derivatives by x = p t."""

SHORTEST_STEP = 1e-7
"""In x: events closer than this are not separated."""

FRESH = 1e-4
"""In x: the beginning of an arc after uplift, where rounding could feign a landing; it rises 1e-9 α."""


@kernel
def verdict(width: float, start: Jet, end: Jet, fourth: float, fifth: float) -> int:
    """
    Tell what happens between two points, the first at h ≥ 0; the bounds are those of |h''''| and |h'''''| in between.

    Returns 1 where there is no impact, −1 where h falls to 0 exactly once, 0 where the bounds do not decide.
    """
    eighth = 0.125 * width * width
    # A function is above the lower of its ends less width²/8 of what its second derivative is at most.
    most = max(start[2], end[2]) + eighth * fourth
    if end[0] < 0.0:
        steepest = max(abs(start[3]), abs(end[3])) + eighth * fifth
        return -1 if most < 0.0 or max(start[1], end[1]) + eighth * steepest < 0.0 else 0
    if most <= 0.0 or min(start[0], end[0]) > eighth * most:
        return 1
    # From the start: h ≥ h0 + h0' x + h0'' x²/2 + L x³/6 with L ≤ h''' throughout.
    if start[1] < 0.0:
        return 0
    least = min(start[3], end[3]) - eighth * fifth
    if least > 0.0 and (start[2] >= 0.0 or (start[0] == 0.0 and start[1] == 0.0 and start[2] > -1e-9)):
        return 1
    return 1 if start[1] + 0.5 * start[2] * width + min(least, 0.0) * width * width / 6.0 > 0.0 else 0
