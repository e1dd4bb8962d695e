"""The content of a MATLAB file, in either of the two file formats."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from numpy.typing import NDArray

Numbers = NDArray[Any]
Node = Numbers | str | list[Any] | dict[str, Any]
"""Numbers (two-dimensional, as MATLAB shows them), text, a cell array as a list of nodes, a struct as a dictionary of
nodes; an array of structs is a list of dictionaries."""


@dataclass
class Tree:
    """
    Variables of a MATLAB file, as far as they could be read.

    Attributes
    ----------
    variables : dict of str to Node
    left_out : dict of str to str
        Path of what was not read -> why: classes that are not data, or that would have to be executed.
    warnings : list of str
        Where the file is cut off or damaged.
    """

    variables: dict[str, Node] = field(default_factory=dict)
    left_out: dict[str, str] = field(default_factory=dict)
    warnings: list[str] = field(default_factory=list)


OPAQUE = {
    "timeseries": "in MATLAB: t = x.Time; values = x.Data; save them instead",
    "timetable": "in MATLAB: s = table2struct(timetable2table(x), 'ToScalar', true); save('file.mat', '-struct', 's')",
    "table": "in MATLAB: s = table2struct(x, 'ToScalar', true); save('file.mat', '-struct', 's')",
    "datetime": "in MATLAB: t = seconds(x - x(1)); save that instead",
    "duration": "in MATLAB: t = seconds(x); save that instead",
    "string": "it is text",
}
"""What to do about MATLAB classes that are kept in a form that MathWorks does not publish."""


def object_reason(class_name: str) -> str:
    """Say why an object is not read, and what to do in MATLAB about it."""
    advice = OPAQUE.get(class_name, "save its numbers as plain arrays")
    return f"it is an object of MATLAB's class {class_name}, which only MATLAB can open: {advice}"
