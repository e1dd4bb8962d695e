"""Raw files as recorders write them: delimited text in several flavours, LabVIEW's and MATLAB's own."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from io import BytesIO
from typing import NamedTuple

import numpy as np

from colonnade.arrays import Array


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


class FileFormat(NamedTuple):
    """A way to write raw files: the end of their names, and their bytes; the same sheet gives the same bytes."""

    suffix: str
    content: Callable[[Sheet], bytes]


def text(
    sheet: Sheet,
    *,
    delimiter: str = ",",
    decimal: str = ".",
    encoding: str = "utf-8",
    time_name: str = "Time",
    preamble: tuple[str, ...] = (),
    units_in_names: bool = False,
) -> bytes:
    """
    Write delimited text: four decimals of the times, six of the values.

    The names are below the `preamble`, above a row of units; with `units_in_names` they are such as `LVDT 1 [V]`.
    """
    named = {time_name: ("s", sheet.time), **sheet.columns}
    heads = [[f"{name} [{unit}]" for name, (unit, _) in named.items()]]
    if not units_in_names:
        heads = [list(named), [unit for unit, _ in named.values()]]
    row = delimiter.join(["%.4f", *(["%.6f"] * len(sheet.columns))])
    table = np.column_stack([values for _, values in named.values()])
    samples = [(row % tuple(values)).replace(".", decimal) for values in table.tolist()]
    return "\n".join([*preamble, *map(delimiter.join, heads), *samples, ""]).encode(encoding)


GROUP = "Messung"
"""Of the channels in a TDMS file."""


def _tdms(sheet: Sheet) -> bytes:
    """Write LabVIEW's TDMS: one group, each channel with its unit and the properties of a waveform."""
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


MATLAB_HEADER = b"MATLAB 5.0 MAT-file, Platform: virtual shake table"
"""First bytes of a MATLAB file; scipy would put the time of writing there, and no two files would be alike."""


def _matlab(sheet: Sheet) -> bytes:
    """Write MATLAB's version 5: the clock and each column a variable; it has no place for units."""
    from scipy.io import savemat

    variables = {"time": sheet.time} | {name: values for name, (_, values) in sheet.columns.items()}
    stream = BytesIO()
    savemat(stream, variables, do_compression=True, oned_as="column")
    return MATLAB_HEADER.ljust(116) + stream.getvalue()[116:]


COMMAS = FileFormat(".csv", text)
"""Comma-separated, names above a row of units."""

TABS = FileFormat(".csv", partial(text, delimiter="\t", preamble=("Data logger export",)))
"""Tab-separated, names above a row of units, below one line of text."""

GERMAN = FileFormat(
    ".csv",
    partial(
        text,
        delimiter=";",
        decimal=",",
        encoding="latin-1",
        time_name="Zeit",
        preamble=("Messdatei des Rütteltischs", "Messbereich ±10 V; 16 bit", "Kanäle gemäß Belegungsplan"),
        units_in_names=True,
    ),
)
"""Semicolons, decimal commas, Latin-1 and a preamble."""

TDMS, MATLAB = FileFormat(".tdms", _tdms), FileFormat(".mat", _matlab)
