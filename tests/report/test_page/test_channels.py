import pytest

from colonnade.report.test_page import channels


def rows_of(reported, test):
    return {row.name: row for row in channels.of_test(reported[test][1])}


def test_a_channel_has_its_samples_its_flags_and_what_conditioning_did(reported):
    top = rows_of(reported, "span-2.0")["top"]
    assert (top.column, top.recorded, top.cutoff) == ("LVDT <1>", "1625 at 250 Hz", "25 Hz")
    assert top.flagged == "0.062\u00a0% failed"
    assert top.quality.startswith("spikes on 1 sample, the first at")
    assert top.zero_window == "0 s to 0.5 s"
    assert top.noise.endswith(" mm")


def test_a_few_flagged_samples_are_told_from_many(reported):
    assert rows_of(reported, "span-2.0")["top"].few_flagged  # 1 of 1625
    assert not rows_of(reported, "span-2.5")["top"].few_flagged


def test_two_transducers_for_two_motions_leave_no_residual(reported):
    rows = rows_of(reported, "span-2.5")
    assert rows["top"].residual == "no redundancy"
    assert rows["table_acceleration"].residual == "–"


def test_a_residual_is_given_over_the_noise_and_over_the_reading(reported):
    residual = rows_of(reported, "sine-3hz-too-strong-for-the-block-1")["top"].residual
    assert "× noise, " in residual
    assert residual.endswith("% of the reading")


def test_a_test_that_was_not_run_has_no_channel(reported):
    assert channels.of_test(reported["later"][1]) == ()


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
