"""A decay whose unknowns are known, and its record."""

from typing import NamedTuple

import numpy as np
import pytest

from colonnade.identification.restitution.fitting.free_decay import Decay
from colonnade.identification.restitution.fitting.samples import AngleSamples
from prism import PRISM

E = 0.92
VALUES = {"restitution": np.log(E), "peak": 0.5, "time": 0.3, "zero_offset": 0.0, "critical_angle": 0.0, "p": 0.0}


class Known(NamedTuple):
    """A decay and samples of it, without noise."""

    decay: Decay
    samples: AngleSamples


@pytest.fixture
def known():
    """Make a decay of the prism from half its critical angle, and its record every 10 ms."""

    def make(*, count=8, deviations=(), linearised=False, **values):
        given = VALUES | {"peak": 0.5 * PRISM.critical_angle} | values
        decay = Decay(given, 1, count, PRISM, linearised, np.array(deviations, dtype=float))
        time = np.arange(0.12, decay.arcs()[2][-1], 0.01)
        return Known(decay, AngleSamples(time, decay.angle_alone(time), 0.01))

    return make
