"""The stage gives the identification what is known: the low-pass, and the motion of the table."""

from __future__ import annotations

import numpy as np
import pytest

from colonnade.stages import condition as conditioning
from colonnade.stages import ingest as ingesting
from colonnade.stages import restitution as stage
from colonnade.stages import rocking as rocking_stage


@pytest.fixture
def passed(small_campaign, free_vibration, monkeypatch):
    """What the identification is called with, of a free vibration, and the result of `rocking` that it is from."""
    test = small_campaign.tests["free-01"]
    recorded = ingesting.ingest(free_vibration[0], ingesting.IngestInputs.of(small_campaign, test))
    ready = conditioning.condition(recorded, conditioning.ConditionInputs.of(small_campaign, test))
    rocking = rocking_stage.rocking(ready, rocking_stage.RockingInputs.of(small_campaign, test))
    calls, identify = [], stage.identify_restitution

    def recorded_call(*arguments, **known):
        calls.append(known)
        return identify(*arguments, **known)

    monkeypatch.setattr(stage, "identify_restitution", recorded_call)

    def call(**changed):
        read = stage.RestitutionInputs.of(small_campaign, test).model_copy(update=changed)
        stage.restitution(rocking, read)
        return calls[-1], ready, rocking

    return call


def test_the_low_pass_that_the_angle_went_through_is_passed_on(passed):
    known, ready, rocking = passed()
    assert known["lowpass"] == ready["top"].attrs["cutoff_hz"] == rocking["rocking_angle"].attrs["cutoff_hz"]
    np.testing.assert_array_equal(known["base_acceleration"], rocking["base_acceleration"])


def test_a_filter_of_another_order_is_not_taken_for_the_one_that_the_fit_knows(passed):
    known, _, _ = passed(filter_order=2)
    assert known["lowpass"] is None
