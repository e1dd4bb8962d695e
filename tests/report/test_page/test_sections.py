"""The sections of a test's page: each of that test, with numbers, units and reasons, and nothing where nothing is."""

from dataclasses import replace

import pytest

from colonnade.campaign.forms.summary import PredictionSummary
from colonnade.figures.restitution.estimators import estimate_rows
from colonnade.report.asked import NO_PHOTOS, Photo, Photos
from colonnade.report.pictures import picture
from colonnade.report.test_page import channels, page
from colonnade.report.test_page.facts import known
from colonnade.report.test_page.page import verdict_sentence
from colonnade.store.records.stored import Stored
from colonnade.store.records.test import predicted_peak_time
from colonnade.units.text import NOTHING

SHOWN = Photos((Photo("photos/span-2.0-1.jpg", "Photo 1 of test span-2.0", "a.jpg"),))


STRONG = "sine-3hz-too-strong-for-the-block-1"


@pytest.fixture
def made(reported):
    return lambda name, shown=NO_PHOTOS: page.of_test(reported[name], shown)


def test_each_section_is_of_its_test(made):
    found = made("span-2.0", SHOWN)
    assert found["row"].id == "span-2.0"
    assert found["photos"] is SHOWN
    names = ("record", "closer", "channels")
    assert [picture(name, found["subject"]).identity for name in names] == [f"{name}-span-2.0" for name in names]
    assert found["table"]["picture"].identity == "base-span-2.0"
    assert {row.name for row in found["channels"]} == {"top", "bottom", "table_acceleration"}
    assert found["spread"]
    assert found["decay"] == []


def test_decisions_of_the_review_are_shown_with_and_without_results(made):
    assert any("flagged as suspect" in sentence for sentence in made("span-2.5")["review"])
    assert made("span-2.0")["review"] == []


def test_a_test_that_was_not_run_has_its_drawing_and_nothing_that_was_measured(made):
    found = made("later")
    assert found["setup"] == made("span-2.0")["setup"]
    assert (found["found"], found["channels"]) == ([], ())
    assert [picture(name, found["subject"]) for name in ("record", "closer", "channels", "bands")] == [None] * 4


def found_of(reported, name):
    return dict(page.measured_of(reported[name]))


def test_the_largest_angle_is_the_stored_one_in_mrad(reported):
    said = found_of(reported, "span-2.0")
    peak = abs(reported["span-2.0"].stored.value("rocking", "peak_angle"))
    value, unit = said["largest |θ|"].split()
    assert (float(value), unit) == (pytest.approx(1e3 * peak, rel=1e-3), "mrad")
    assert said["peak base acceleration"].endswith(" g)")


def test_a_free_vibration_has_its_release_and_what_predictions_use(reported):
    said = found_of(reported, "free-01")
    assert "largest |θ|, release included" in said
    assert "largest |θ|" not in said
    assert float(said["released at |θ|/α"]) == pytest.approx(0.5, abs=0.01)
    assert "predictions use" in said


def test_an_overturned_test_has_the_time_and_no_largest_angle(reported):
    said = found_of(reported, STRONG)
    assert said.keys().isdisjoint({"largest |θ|", "predictions use"})
    assert float(said["overturned at"].split()[0]) == pytest.approx(reported[STRONG].record.peak_time, rel=1e-3)


def test_at_prototype_scale_lengths_are_twenty_times_as_long(reported):
    said = found_of(reported, "span-2.0")["at prototype scale, 1:20"]
    duration = float(said.split("duration ")[1].split()[0])
    assert duration == pytest.approx(20**0.5 * reported["span-2.0"].record.duration, rel=5e-3)
    assert "at prototype scale, 1:20" not in found_of(reported, "watched")


def test_each_models_largest_angle_has_its_time(reported):
    one = reported["span-2.0"]
    for model in ("linear", "nonlinear"):
        assert 0.0 < predicted_peak_time(one.stored, model) < one.record.duration


def test_a_few_flagged_samples_are_told_from_many(reported):
    (few, *_), (many, *_) = (channels.of_test(reported[name].stored) for name in ("span-2.0", "span-2.5"))
    assert (few.name, few.few_flagged, many.few_flagged) == ("top", True, False)  # 1 of 1625 in the first


@pytest.mark.parametrize(
    ("given", "written"),
    [
        ({}, "–"),
        ({"clock_offset": 0.0}, "–"),
        ({"clock_offset": 0.0201}, "20.10 ms"),
        ({"clock_offset": 0.0201, "clock_offset_standard_error": 2e-4}, "20.10 ms ± 0.20 ms"),
        ({"clock_offset": 0.0201, "clock_rate_ppm": -3.2}, "20.10 ms, −3.2 ppm"),
        ({"clock_rate_ppm": "unknown"}, "–"),
    ],
)
def test_a_clock_is_given_in_milliseconds_and_its_drift_in_millionths(given, written):
    assert channels._clock(given) == written


def test_a_free_vibration_has_e_its_peaks_and_its_figures(reported):
    free = reported["free-01"]
    assert page.facts_of(free)
    assert estimate_rows(free.stored)
    assert [picture(name, free).identity for name in ("fitted", "peaks")] == ["fitted-free-01", "peaks-free-01"]


def test_each_peak_is_a_row_of_number_time_angle_error_fitted_angle_and_use(reported):
    peaks = page.peaks_of(reported["free-01"].stored)
    assert [row[0] for row in peaks] == list(range(1, len(peaks) + 1))
    times = [row[1] for row in peaks]
    assert times == sorted(times)
    used = [(abs(angle), abs(fitted)) for _, _, angle, _, fitted, is_used in peaks if is_used]
    assert used
    assert all(abs(angle - fitted) < 0.05 * angle for angle, fitted in used)


def test_any_other_test_has_no_decay(reported):
    one = reported["span-2.0"]
    assert page.facts_of(one) == []
    assert estimate_rows(one.stored) == page.peaks_of(one.stored) == []
    names = ("fitted", "estimators", "peaks", "impacts", "region")
    assert [picture(name, one) for name in names] == [None] * len(names)


def test_the_recommended_estimator_gives_the_value_with_its_interval(reported):
    one = reported["free-01"]
    facts = dict(page.facts_of(one))
    assert facts["e"].startswith("0.930")
    assert " ± 0.0" in facts["e"]
    assert "refused" not in facts
    (chosen,) = (each for each in estimate_rows(one.stored) if each.recommended)
    assert facts["from"] == chosen.name
    assert facts["assumptions"] == chosen.assumptions
    assert "interval" not in chosen.text


def test_an_estimator_without_a_value_says_why(reported):
    without = [each for each in estimate_rows(reported["free-refused"].stored) if each.text == "–"]
    assert without
    assert all(each.reason and each.assumptions for each in without)


def test_a_note_on_a_file_may_hold_a_semicolon(reported):
    notes = page.notes_of(reported["span-2.0"].stored)
    assert notes[-1] == 'span-2.0.csv: clock: column 1, "Time" (in s; rising)'
    assert all(note.startswith("span-2.0.csv: ") for note in notes)


def test_the_page_says_where_the_results_are_and_when_the_file_says_it_was_recorded(reported):
    known = dict(page.done_of(reported["span-2.0"]))
    assert known["results"].startswith("NetCDF files in processed/tests/span-2.0/, next to")
    assert "recorded" not in known, "the file gives no date"


def test_a_test_without_results_has_no_place(reported):
    assert "results" not in dict(page.done_of(replace(reported["span-2.0"], stored=Stored())))


def test_what_is_not_known_or_has_no_label_is_left_out_and_the_order_stays():
    facts = [("b", "2 mm"), ("", "3 mm"), ("c", ""), ("d", NOTHING), ("a", "0 mm")]
    assert known(facts) == [("b", "2 mm"), ("a", "0 mm")]


def predicted(horizon, rank, peak_rank, overturning):
    return PredictionSummary(
        horizon=horizon, within_spread=rank, peak_rank=peak_rank, overturning_probability=overturning
    )


def test_a_rank_within_the_limit_is_within_and_one_above_it_outside():
    told = verdict_sentence("linear", predicted(3.42, 0.95, 0.5, 0.0))
    assert told == (
        "Linear model: the measured angle is within its own spread up to 3.42 s (95\u00a0% of the runs are closer "
        "to their median; 50\u00a0% stay below the measured peak)."
    )
    told = verdict_sentence("linear", predicted(3.42, 0.96, 1.0, 0.12))
    assert "is outside its own spread" in told
    assert "12\u00a0% overturn" in told


def test_without_runs_enough_there_is_a_horizon_and_no_verdict():
    told = verdict_sentence("contact", predicted(3.42, None, None, 0.0))
    assert told == "Contact model: predicted up to 3.42 s; not ranked: that needs 20 runs and a measured angle."


def test_without_runs_nothing_is_said():
    assert verdict_sentence("linear", PredictionSummary()) == ""
