"""What is said of a table goes before what is found in it."""

from __future__ import annotations

from colonnade.readers.text.delimited_header import TableOptions
from colonnade.readers.text.heading import HeadingLines
from every import every

FOUND = HeadingLines(2, 3)


@every(
    ("options", "names", "units"),
    [
        ({}, 2, 3),
        ({"names_row": 1}, 0, 3),
        ({"names_row": 4}, 3, None),
        ({"units_row": 3}, None, 2),
        ({"names_row": 0, "units_row": 0}, None, None),
    ],
)
def test_lines_of_names_and_units_are_as_given_else_as_found(
    options: dict[str, int], names: int | None, units: int | None
) -> None:
    assert TableOptions(**options).heading_lines(FOUND) == HeadingLines(names, units)


@every(
    ("kinds", "options", "kind"),
    [
        (("number", "number"), TableOptions(layout="running"), "running"),
        (("time", "number"), TableOptions(), "columns"),
        (("number", "number"), TableOptions(time=1), "columns"),
        (("number", "number"), TableOptions(), None),
    ],
)
def test_the_layout_is_as_given_or_as_the_columns_kinds_leave_it(
    kinds: tuple[str, ...], options: TableOptions, kind: str | None
) -> None:
    layout = options.given_layout(kinds)
    assert (None if layout is None else layout.kind) == kind
