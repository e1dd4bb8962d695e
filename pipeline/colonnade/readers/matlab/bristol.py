"""The two layouts of MATLAB files that the shaking tables of Bristol write (as read by pyDySP)."""

from __future__ import annotations

import re

import numpy as np

from colonnade.readers.binary.vectors import Column
from colonnade.readers.clock import RISING_SHARE, rising_share
from colonnade.readers.matlab.tree import Node

DATA = re.compile(r"Channel_(\d+)_Data")


def numbered_channels(variables: dict[str, Node]) -> tuple[dict[str, Node], list[Column], dict[str, float], list[str]]:
    """
    Take the channels of the layout `File_Header`, `Channel_i_Header`, `Channel_i_Data`.

    Parameters
    ----------
    variables : dict of str to Node
        All variables of the file.

    Returns
    -------
    others : dict of str to Node
        Variables that are not part of the layout.
    columns : list of Column
        With names and units by the headers; the first one is called `time` where it rises, as that is the clock.
    scalars : dict of str to float
        `File_Header.SampleFrequency`, Hz, if the first channel is not a clock.
    notes : list of str
        Empty if the file has another layout.
    """
    numbers = sorted(int(match[1]) for name in variables if (match := DATA.fullmatch(name)))
    arrays = {number: variables[f"Channel_{number}_Data"] for number in numbers}
    columns: list[Column] = []
    for number, values in arrays.items():
        if not isinstance(values, np.ndarray) or values.size < 2 or values.size != max(values.shape):
            continue
        header = variables.get(f"Channel_{number}_Header")
        name, unit = _told(header, "SignalName"), _told(header, "Unit")
        if number == 1 and rising_share(values.ravel().astype(np.float64)) >= RISING_SHARE:
            name = "time"
        columns.append(Column(f"Channel_{number}_Data", (), values.ravel(), name, unit))
    if not columns:
        return variables, [], {}, []
    others = {
        name: node
        for name, node in variables.items()
        if not re.fullmatch(r"(?:Channel_\d+|File)_(?:Header|Data)", name)
    }
    notes = ["layout of Bristol: Channel_i_Data, with names and units in Channel_i_Header"]
    rate = _number(variables.get("File_Header"), "SampleFrequency")
    if columns[0].name == "time":
        return others, columns, {}, [*notes, "Channel_1_Data rises: it is the clock"]
    return others, columns, {"File_Header.SampleFrequency": rate} if rate else {}, notes


def lacking_channels(variables: dict[str, Node], columns: list[Column]) -> list[str]:
    """Warn where the layout `t`, `chan1` … `chann`, `No_Channels` has fewer channels than it says."""
    said = variables.get("No_Channels")
    if not isinstance(said, np.ndarray) or said.size != 1:
        return []
    there = sum(re.fullmatch(r"chan\d+|output\[\d+\]", column.path) is not None for column in columns)
    if there == 0 or there == int(said.ravel()[0]):
        return []
    return [f"No_Channels says {int(said.ravel()[0])}, but {there} channels are in the file"]


def _told(header: Node | None, field: str) -> str | None:
    text = header.get(field) if isinstance(header, dict) else None
    return text.strip() or None if isinstance(text, str) else None


def _number(header: Node | None, field: str) -> float | None:
    value = header.get(field) if isinstance(header, dict) else None
    try:
        number = float(value.strip() if isinstance(value, str) else np.asarray(value, dtype=np.float64).ravel()[0])
    except (ValueError, TypeError, IndexError):
        return None
    return number if number > 0 else None
