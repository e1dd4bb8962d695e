"""A block from rest under a harmonic motion that is not sampled."""

from math import inf, isfinite, tan
from types import SimpleNamespace

import numpy as np

from colonnade.dynamics.history import NO_ROCKING_RATIO
from colonnade.dynamics.models import plane_model_of
from colonnade.dynamics.plane.march import propagate
from colonnade.dynamics.plane.sides import sides_of


def harmonic_run(block, motion, amplitude_ratio, restitution, *, model="linear", samples=0, interval=1.0):
    """Outcome, peak over α, impacts, and so many samples at an interval (s), as at the motion's end after it."""
    times = np.minimum(interval * np.arange(samples), motion.edges[2])
    forcing = motion.forcing(*times)
    angles, velocities, impact_times, impact_velocities, end = propagate(
        forcing._replace(levels=forcing.levels * (amplitude_ratio * tan(block.critical_angle))),
        sides_of(block, restitution),
        is_linearised=plane_model_of(model).is_linearised,
        since=0,
        floor=inf,
    )
    at = np.searchsorted(forcing.times, times)
    return SimpleNamespace(
        outcome="overturned" if isfinite(end.time) else "rocking" if end.peak > NO_ROCKING_RATIO else "no-rocking",
        peak_ratio=end.peak,
        angle=angles[at],
        angular_velocity=velocities[at],
        impact_times=impact_times,
        impact_velocities=impact_velocities,
    )
