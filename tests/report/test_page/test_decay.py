"""The section of a free vibration: e by every estimator, its peaks in order, its figures by name."""

from __future__ import annotations

from colonnade.report.test_page import decay, restitution


def test_a_free_vibration_has_e_its_peaks_and_its_figures(subject):
    free = subject("free-01")
    found = decay.of_test(free)
    assert found.facts == restitution.facts_of(free.stored, free.row.record.restitution)
    assert found.estimates == restitution.estimates_of(free.stored)
    assert list(found.pictures) == list(decay.FIGURES)
    drawn = {name: picture.identity for name, picture in found.pictures.items() if picture is not None}
    assert drawn.items() >= {"fitted": "fitted-free-01", "peaks": "peaks-free-01"}.items()


def test_each_peak_is_a_row_of_time_angle_error_fitted_angle_and_use(subject):
    peaks = decay.of_test(subject("free-01")).peaks
    times = [row[0] for row in peaks]
    assert times == sorted(times)
    assert all(len(row) == len(decay.PEAK) for row in peaks)
    used = [(abs(angle), abs(fitted)) for _, angle, _, fitted, is_used in peaks if is_used]
    assert used
    assert all(abs(angle - fitted) < 0.05 * angle for angle, fitted in used)


def test_any_other_test_has_no_such_section(subject):
    found = decay.of_test(subject("span-2.0"))
    assert (found.facts, found.estimates, found.departures, found.peaks) == ([], [], [], [])
    assert set(found.pictures.values()) == {None}
