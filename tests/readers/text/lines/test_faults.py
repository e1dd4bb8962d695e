"""What is wrong with a row, and what is only a sample without some of its numbers."""

from __future__ import annotations

from colonnade.readers.text.lines.cells import Dialect
from colonnade.readers.text.lines.faults import Row, RowForm, fault_of
from every import every

FORM = RowForm(Dialect("utf-8", ";", "."), ("number", "number"))


def judged(text: str, form: RowForm = FORM) -> str | None:
    cells = form.dialect.split(text)
    return fault_of(Row(0, 1, text, cells), form, has_number=any(map(form.dialect.is_number, cells)))


@every(
    ("text", "fault"),
    [
        ("1;2", None),
        ("1;OVL", None),
        ("OVL;--", None),
        ("1;2;3", "long"),
        ("1;2;", "long"),
        ("1", "short"),
        ("# event", "comment"),
        ("# 1;2", "struck out"),
        ("Time;x", "text"),
    ],
)
def test_a_fault_has_a_name(text: str, fault: str | None) -> None:
    assert judged(text) == fault


def test_delimiters_at_each_lines_end_belong_to_the_form() -> None:
    form = RowForm(FORM.dialect, FORM.kinds, trailing=1)
    assert (form.cells, form.most_cells) == (3, 3)
    assert judged("1;2;", form) is None
    assert judged("1;2;3", form) == "long"
    assert judged("1;2", form) == "short"


def test_each_row_of_an_instrument_is_a_sample_in_its_place() -> None:
    form = RowForm(FORM.dialect, FORM.kinds, remark=True, by_instrument=True)
    assert judged("Time;x", form) is None
    assert judged("1;2;lost;;", form) is None
    assert judged("1;2;lost;4", form) == "long"
