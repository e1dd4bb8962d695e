"""Pictures of maps: the sine tests of a specimen over frequency and amplitude."""

from __future__ import annotations

from collections.abc import Sequence

from colonnade.figures.maps.measured_map import measured_map
from colonnade.figures.output import Picture
from colonnade.identification.response.boundaries import MapPoint


def tested(identity: str, points: Sequence[MapPoint]) -> Picture:
    """Draw the sine tests of a specimen by outcome over Ω and A."""
    outcomes = [point.outcome for point in points]
    described = ", ".join(f"{outcomes.count(outcome)} {outcome}" for outcome in dict.fromkeys(outcomes))
    return Picture(
        measured_map(points),
        identity,
        "Sine tests by outcome over frequency ratio Ω and amplitude ratio A",
        f"{len(points)} tests: {described}.",
    )
