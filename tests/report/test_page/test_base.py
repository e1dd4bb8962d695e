"""What the page of a test says of the motion of the table, against the motion that the virtual table followed."""

import pytest

from colonnade.figures import base_motion as drawn
from colonnade.report.test_page import base
from colonnade.signals.named_motion import Series

AT_SCALE = "#achieved, prototype scale"


@pytest.fixture(scope="module")
def table(reported):
    return lambda name: base.of_test(reported[name])


def measures(found):
    return {row[0].split(" (")[0]: dict(zip(found["heads"], row, strict=True)) for row in found["rows"]}


def test_the_target_of_a_named_motion_is_laid_on_what_was_recorded(table, reported, monkeypatch):
    acceleration = reported["span-2.0"].stored.array("rocking", "base_acceleration")
    reference = Series(acceleration[200:1400] / 2.5, 0.004 / 0.2236)
    monkeypatch.setattr(drawn, "_reference", lambda campaign, motion: reference)
    found = table("span-2.0")
    assert "#target" in found["heads"]
    label, text = found["facts"][0]
    assert label == "target"
    assert "2.5 times the reference, at time scale 0.2236; correlation 1" in text
    intensity = measures(found)["Arias intensity"]
    achieved, target = (float(intensity[head].split()[0]) for head in ("#achieved", "#target"))
    assert achieved == pytest.approx(target, rel=0.1)
    assert "Achieved over target" in found["picture"].description
    assert len(found["picture"].figure.axes) == 3


def test_a_sine_has_its_achieved_frequency_amplitude_and_distortion_and_no_spectrum(table, reported):
    name = next(name for name, one in reported.items() if one.test.kind == "sine" and one.record.frequency)
    found = table(name)
    assert [label for label, _ in found["facts"]] == ["frequency", "amplitude", "distortion", "steady from"]
    assert "asked for" in dict(found["facts"])["frequency"]
    assert found["picture"] is None
    assert "#target" not in found["heads"]


def test_prototype_scale_leaves_accelerations_and_stretches_lengths(table):
    found = measures(table("span-2.0"))
    assert found["peak acceleration"][AT_SCALE] == found["peak acceleration"]["#achieved"]
    model, prototype = (float(found["Arias intensity"][head].split()[0]) for head in ("#achieved", AT_SCALE))
    assert prototype == pytest.approx(20**0.5 * model, rel=1e-2)


def test_a_velocity_that_the_drift_does_not_permit_is_not_given(table):
    """The virtual shaking has an end velocity, so that its integral does not come to rest."""
    velocity = measures(table("span-2.0"))["peak velocity of the table"]
    assert velocity["#achieved"] == "–"
    assert velocity["how it is computed"].startswith(
        "not given: the integral of the acceleration drifts by more than 25\u00a0%"
    )
