"""What the page of a test says of how it was done and how its files were read."""

from colonnade.report.test_page import done
from colonnade.store.records.stored import Stored


def test_a_note_on_a_file_may_hold_a_semicolon(reported):
    notes = done.of_test(*reported["span-2.0"], []).notes
    assert notes[-1] == 'span-2.0.csv: clock: column 1, "Time" (in s; rising)'
    assert all(note.startswith("span-2.0.csv: ") for note in notes)


def test_the_page_says_where_the_results_are_and_when_the_file_says_it_was_recorded(reported):
    row, stored = reported["span-2.0"]
    known = dict(done.of_test(row, stored, [("operator", "M. Rossi")]).facts)
    assert known["operator"] == "M. Rossi"
    assert known["results"].startswith("NetCDF files in processed/tests/span-2.0/, next to")
    assert "recorded" not in known, "the file gives no date"


def test_a_test_without_results_has_no_place(reported):
    row, _ = reported["span-2.0"]
    assert "results" not in dict(done.of_test(row, Stored(), []).facts)
