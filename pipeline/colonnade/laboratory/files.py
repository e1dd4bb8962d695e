"""Raw files as recorders write them: delimited text in several flavours, LabVIEW's and MATLAB's own."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from io import BytesIO
from pathlib import Path
from typing import ClassVar

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


class FileFormat(ABC):
    """A way to write raw files; `suffix` ends their names."""

    suffix: ClassVar[str]

    @abstractmethod
    def content(self, sheet: Sheet) -> bytes:
        """Bytes of a file; the same sheet gives the same bytes."""


@dataclass(frozen=True)
class Flavour(FileFormat):
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
    """

    delimiter: str = ","
    decimal: str = "."
    encoding: str = "utf-8"
    time_name: str = "Time"
    preamble: tuple[str, ...] = ()
    units_in_names: bool = False

    suffix: ClassVar[str] = ".csv"

    def content(self, sheet: Sheet) -> bytes:
        """Bytes of a file; four decimals of the times are written, six of the values."""
        named = {self.time_name: ("s", sheet.time), **sheet.columns}
        lines = [*self.preamble, self.delimiter.join(self.heading(name, unit) for name, (unit, _) in named.items())]
        if not self.units_in_names:
            lines.append(self.delimiter.join(unit for unit, _ in named.values()))
        row = self.delimiter.join(["%.4f", *(["%.6f"] * len(sheet.columns))])
        table = np.column_stack([values for _, values in named.values()])
        samples = [row % tuple(values) for values in table.tolist()]
        if self.decimal != ".":
            samples = [sample.replace(".", self.decimal) for sample in samples]
        return "\n".join([*lines, *samples, ""]).encode(self.encoding)

    def heading(self, name: str, unit: str) -> str:
        """Name of a column as written in the file."""
        return f"{name} [{unit}]" if self.units_in_names else name


GERMAN = Flavour(
    delimiter=";",
    decimal=",",
    encoding="latin-1",
    time_name="Zeit",
    preamble=("Messdatei des Rütteltischs", "Messbereich ±10 V; 16 bit", "Kanäle gemäß Belegungsplan"),
    units_in_names=True,
)
"""Semicolons, decimal commas, Latin-1 and a preamble."""

COMMAS = Flavour()
"""Comma-separated, names above a row of units."""

TABS = Flavour(delimiter="\t", preamble=("Data logger export",))
"""Tab-separated, names above a row of units, below one line of text."""


GROUP = "Messung"
"""Of the channels in a TDMS file."""

MATLAB_HEADER = b"MATLAB 5.0 MAT-file, Platform: virtual shake table"
"""First bytes of a MATLAB file; scipy would put the time of writing there, and no two files would be alike."""


class Tdms(FileFormat):
    """LabVIEW's TDMS: one group, each channel with its unit and the properties of a waveform."""

    suffix: ClassVar[str] = ".tdms"

    def content(self, sheet: Sheet) -> bytes:
        """Return the bytes of a file."""
        from nptdms import ChannelObject, GroupObject, RootObject, TdmsWriter

        waveform = {
            "wf_start_time": sheet.begun,
            "wf_start_offset": 0.0,
            "wf_increment": 1.0 / sheet.sampling_rate_hz,
            "wf_samples": sheet.time.size,
        }
        channels = [
            ChannelObject(GROUP, name, values, properties={**waveform, "unit_string": unit})
            for name, (unit, values) in sheet.columns.items()
        ]
        stream = BytesIO()
        with TdmsWriter(stream) as writer:
            writer.write_segment([RootObject(), GroupObject(GROUP), *channels])
        return stream.getvalue()


class Matlab(FileFormat):
    """MATLAB's own files, version 5: the clock and each column a variable; it has no place for units."""

    suffix: ClassVar[str] = ".mat"

    def content(self, sheet: Sheet) -> bytes:
        """Return the bytes of a file."""
        from scipy.io import savemat

        variables = {"time": sheet.time} | {name: values for name, (_, values) in sheet.columns.items()}
        stream = BytesIO()
        savemat(stream, variables, do_compression=True, oned_as="column")
        written = stream.getvalue()
        return MATLAB_HEADER.ljust(116) + written[116:]


def put(path: Path, data: bytes) -> None:
    """
    Write a file of a virtual campaign, unless it holds these bytes already.

    Raises
    ------
    StoreError
        If it cannot be written.
    """
    with writing(path):
        path.parent.mkdir(parents=True, exist_ok=True)
        if path.is_symlink():  # what it leads to is not ours
            path.unlink()
        if not path.is_file() or path.read_bytes() != data:
            path.write_bytes(data)


@contextmanager
def writing(path: Path) -> Iterator[None]:
    """Tell why a file or folder of a virtual campaign cannot be written."""
    try:
        yield
    except OSError as error:
        raise StoreError(f"{path}: the virtual campaign cannot be written here ({error.strerror}).") from error
