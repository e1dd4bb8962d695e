"""What the page of a test says of how it was done and how its files were read."""

from colonnade.report.test_page import done


def test_a_note_on_a_file_may_hold_a_semicolon(reported):
    notes = done.of_test(*reported["span-2.0"], []).notes
    assert notes[-1] == 'span-2.0.csv: clock: column 1, "Time" (in s; rising)'
    assert all(note.startswith("span-2.0.csv: ") for note in notes)
