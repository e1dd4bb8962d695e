"""Raw files as recorders write them: what every format has, and delimited text in several flavours."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

import numpy as np

from colonnade.arrays import Array
from colonnade.errors import StoreError


@dataclass(frozen=True)
class Sheet:
    """
    What one recorder has to write of one test.

    Attributes
    ----------
    time : ndarray, shape (n,)
        s, from the recorder's own zero.
    sampling_rate_hz : float
    columns : mapping of str to (str, ndarray of shape (n,))
        Unit and values by name.
    begun : numpy.datetime64
        When the test began.
    """

    time: Array
    sampling_rate_hz: float
    columns: Mapping[str, tuple[str, Array]]
    begun: np.datetime64


class FileFormat(Protocol):
    """A way to write raw files."""

    @property
    def suffix(self) -> str:
        """Ending of its files' names."""

    def declaration(self) -> Mapping[str, str]:
        """Keys of `file` in the campaign file; none where it is left to be sniffed."""

    def content(self, sheet: Sheet) -> bytes:
        """Bytes of a file; the same sheet gives the same bytes."""


@dataclass(frozen=True)
class Flavour:
    """
    How one recorder writes its text files.

    Attributes
    ----------
    delimiter, decimal, encoding : str
    time_name : str
        Name of the clock's column.
    preamble : tuple of str
        Lines above the names.
    units_in_names : bool
        Names such as `LVDT 1 [V]`; else the units have a row of their own.
    declared : bool
        Whether the campaign file says all this; else it is left to be sniffed.
    """

    delimiter: str = ","
    decimal: str = "."
    encoding: str = "utf-8"
    time_name: str = "Time"
    preamble: tuple[str, ...] = ()
    units_in_names: bool = False
    declared: bool = False

    @property
    def suffix(self) -> str:
        """Ending of its files' names."""
        return ".csv"

    def declaration(self) -> Mapping[str, str]:
        """Keys of `file` in the campaign file; none where it is left to be sniffed."""
        if not self.declared:
            return {}
        said = {"format": "delimited", "delimiter": self.delimiter, "decimal": self.decimal, "encoding": self.encoding}
        return said | {"time": self.heading(self.time_name, "s")}

    def content(self, sheet: Sheet) -> bytes:
        """Bytes of a file."""
        return delimited_text(sheet.time, sheet.columns, self).encode(self.encoding)

    def heading(self, name: str, unit: str) -> str:
        """Name of a column as it stands in the file."""
        return f"{name} [{unit}]" if self.units_in_names else name


GERMAN = Flavour(
    delimiter=";",
    decimal=",",
    encoding="latin-1",
    time_name="Zeit",
    preamble=("Messdatei des Rütteltischs", "Messbereich ±10 V; 16 bit", "Kanäle gemäß Belegungsplan"),
    units_in_names=True,
    declared=True,
)
"""Semicolons, decimal commas, Latin-1 and a preamble, all of it told in the campaign file."""

COMMAS = Flavour()
"""Comma-separated, names above a row of units."""

TABS = Flavour(delimiter="\t", preamble=("Data logger export",))
"""Tab-separated, names above a row of units, below one line of text."""


def delimited_text(time: Array, columns: Mapping[str, tuple[str, Array]], flavour: Flavour) -> str:
    """
    Write out the columns of a recorder.

    Parameters
    ----------
    time : ndarray, shape (n,)
        s, from the recorder's own zero.
    columns : mapping of str to (str, ndarray of shape (n,))
        Unit and values by name; six decimals are written.
    flavour : Flavour

    Returns
    -------
    text : str
    """
    named = {flavour.time_name: ("s", time), **columns}
    names = [flavour.heading(name, unit) for name, (unit, _) in named.items()]
    lines = [*flavour.preamble, flavour.delimiter.join(names)]
    if not flavour.units_in_names:
        lines.append(flavour.delimiter.join(unit for unit, _ in named.values()))
    row = flavour.delimiter.join(["%.4f", *(["%.6f"] * len(columns))])
    table = np.column_stack([values for _, values in named.values()])
    samples = [row % tuple(values) for values in table.tolist()]
    if flavour.decimal != ".":
        samples = [sample.replace(".", flavour.decimal) for sample in samples]
    return "\n".join([*lines, *samples, ""])


def put(path: Path, data: bytes) -> None:
    """
    Write a file of a virtual campaign, unless it holds these bytes already.

    Raises
    ------
    StoreError
        If it cannot be written.
    """
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        if path.is_symlink():  # what it leads to is not ours
            path.unlink()
        if not path.is_file() or path.read_bytes() != data:
            path.write_bytes(data)
    except OSError as error:
        raise StoreError(f"{path}: the virtual campaign cannot be written here ({error.strerror}).") from error
