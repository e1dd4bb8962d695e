"""[prototype.<specimen>]: values with their limits."""

import pytest
from pydantic import ValidationError

from colonnade.campaign.assessment import Prototype
from every import every


def test_values_and_limits_become_si():
    written = {"restitution": "identified", "restitution_range": [0.93, 0.97], "critical_angle": "10 deg"}
    prototype = Prototype.model_validate(written | {"p": "1.26 rad/s", "p_range": ["1.2 rad/s", "75 deg/s"]})
    assert prototype.restitution == "identified"
    assert prototype.restitution_range == (0.93, 0.97)
    assert prototype.critical_angle == pytest.approx(0.174533, abs=1e-6)
    assert prototype.p_range == pytest.approx((1.2, 1.308997))
    assert prototype.friction is None


@every(
    ("written", "place", "words"),
    [
        ({}, "restitution", "It is missing."),
        ({"restitution": "guessed"}, "restitution", 'Or "identified", "rigid-body".'),
        ({"restitution": 1.2}, "restitution", "above 0, at most 1"),
        ({"restitution": 0.95, "restitution_range": [0.97, 0.93]}, "restitution_range", "has to be the larger one"),
        ({"restitution": 0.9, "restitution_range": [0.93, 0.97]}, "restitution_range", "do not hold restitution = 0.9"),
        ({"restitution": 0.9, "critical_angle": 0.18}, "critical_angle", "has no unit"),
        ({"restitution": 0.9, "p": "1.26 Hz"}, "p", "angular velocity was expected"),
        ({"restitution": 0.9, "friction_range": [0.5, 0.7]}, "friction", "though its limits are given"),
    ],
)
def test_what_is_wrong_is_said_at_its_key(written, place, words):
    with pytest.raises(ValidationError) as refused:
        Prototype.model_validate(written)
    (found,) = refused.value.errors()
    assert found["loc"] == (place,)
    assert words in found["msg"]
