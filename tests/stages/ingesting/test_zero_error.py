"""An uncertain zero is reported in the units of the result, with a better stretch if there is one."""

from __future__ import annotations

import numpy as np

from colonnade.signals.rest import RestWindow
from colonnade.stages.ingesting.zero_error import find_zero_error, on_angle, on_base
from prism import PRISM

CLOCK = np.arange(0.0, 10.0, 0.01)
WINDOW = RestWindow(0.0, 1.0, quiet=False)
LEVER = 0.4


def _found(drift, *, free_vibration=False):
    """A displacement that drifts by `drift` (m) in the first second and is still afterwards."""
    values = {"top": np.minimum(CLOCK, 1.0) * drift}
    return find_zero_error(CLOCK, values, {"top": on_angle(LEVER, PRISM)}, WINDOW, free_vibration=free_vibration)


def test_a_drift_is_reported_in_radians_with_a_stretch_without_it():
    (found,) = _found(0.002)
    error = 0.002 * 3 / 8 / LEVER  # from the mean of the last quarter to that of the window
    assert f"uncertain by {error:.2g} rad" in found.text
    assert 'zero = ["1' in found.text
    assert found.severity == "warning"


def test_an_accelerometer_across_the_shaking_weighs_more():
    assert on_base(0.5, PRISM).factor == 2.0
    assert on_base(1.0, PRISM).scale == PRISM.uplift_acceleration
