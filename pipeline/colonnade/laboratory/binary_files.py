"""Raw files as LabVIEW and MATLAB write them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from io import BytesIO

from colonnade.laboratory.files import Sheet

MATLAB_HEADER = b"MATLAB 5.0 MAT-file, Platform: virtual shake table"
"""First bytes of a MATLAB file; scipy would put the time of writing there, and no two files would be alike."""


@dataclass(frozen=True)
class Tdms:
    """LabVIEW's TDMS: one group, each channel with its unit and the properties of a waveform."""

    group: str = "Messung"

    @property
    def suffix(self) -> str:
        """Ending of its files' names."""
        return ".tdms"

    def declaration(self) -> Mapping[str, str]:
        """Keys of `file` in the campaign file."""
        return {"format": "tdms", "group": self.group}

    def content(self, sheet: Sheet) -> bytes:
        """Bytes of a file."""
        from nptdms import ChannelObject, GroupObject, RootObject, TdmsWriter

        channels = [
            ChannelObject(
                self.group,
                name,
                values,
                properties={
                    "wf_start_time": sheet.begun,
                    "wf_start_offset": 0.0,
                    "wf_increment": 1.0 / sheet.sampling_rate_hz,
                    "wf_samples": values.size,
                    "unit_string": unit,
                },
            )
            for name, (unit, values) in sheet.columns.items()
        ]
        stream = BytesIO()
        with TdmsWriter(stream) as writer:
            writer.write_segment([RootObject(), GroupObject(self.group), *channels])
        return stream.getvalue()


@dataclass(frozen=True)
class Matlab:
    """MATLAB's own files, version 5: the clock and each column a variable; it has no place for units."""

    time_name: str = "time"

    @property
    def suffix(self) -> str:
        """Ending of its files' names."""
        return ".mat"

    def declaration(self) -> Mapping[str, str]:
        """Keys of `file` in the campaign file."""
        return {"format": "matlab", "time": self.time_name}

    def content(self, sheet: Sheet) -> bytes:
        """Bytes of a file."""
        from scipy.io import savemat

        variables = {self.time_name: sheet.time} | {name: values for name, (_, values) in sheet.columns.items()}
        stream = BytesIO()
        savemat(stream, variables, do_compression=True, oned_as="column")
        written = stream.getvalue()
        return MATLAB_HEADER.ljust(116) + written[116:]
