"""What the page of a test says was found: numbers with their units, and the figure of the whole record."""

from __future__ import annotations

import pytest

from colonnade.report.test_page import found

STRONG = "sine-3hz-too-strong-for-the-block-1"


def facts(subject, name):
    return dict(found.of_test(subject(name)).facts)


def test_the_largest_angle_is_the_stored_one_in_mrad(subject):
    said = facts(subject, "span-2.0")
    peak = abs(subject("span-2.0").stored.value("rocking", "peak_angle"))
    value, unit = said["largest |θ|"].split()
    assert (float(value), unit) == (pytest.approx(1e3 * peak, rel=1e-3), "mrad")
    assert said["peak base acceleration"].endswith(" g)")


def test_a_free_vibration_has_its_release_and_what_predictions_use(subject):
    said = facts(subject, "free-01")
    assert "largest |θ|, release included" in said
    assert "largest |θ|" not in said
    assert float(said["released at |θ|/α"]) == pytest.approx(0.5, abs=0.01)
    assert "predictions use" in said


def test_an_overturned_test_has_the_time_and_no_largest_angle(subject):
    said = facts(subject, STRONG)
    assert said.keys().isdisjoint({"largest |θ|", "predictions use"})
    assert float(said["overturned at"].split()[0]) == pytest.approx(subject(STRONG).row.record.peak_time, rel=1e-3)


def test_at_prototype_scale_lengths_are_twenty_times_as_long(subject):
    said = facts(subject, "span-2.0")["at prototype scale, 1:20"]
    duration = float(said.split("duration ")[1].split()[0])
    assert duration == pytest.approx(20**0.5 * subject("span-2.0").row.record.duration, rel=5e-3)
    assert "at prototype scale, 1:20" not in facts(subject, "watched")


def test_each_models_largest_angle_has_its_time(subject):
    times = found.of_test(subject("span-2.0")).predicted_times
    assert set(times) == {"linear", "nonlinear"}
    assert all(0.0 < time < subject("span-2.0").row.record.duration for time in times.values())


def test_other_motions_have_their_standard_error(subject):
    assert ", standard error " in facts(subject, "span-2.0")["largest slide"]


def test_of_a_test_that_was_not_run_nothing_is_said(subject):
    nothing = found.of_test(subject("later"))
    assert (nothing.facts, nothing.record, nothing.predicted_times) == ([], None, {})
