"""Files in known formats that are not read are refused by their format's name, never taken for tables."""

import numpy as np
import pytest

from colonnade.campaign.draft.write import draft
from colonnade.errors import CampaignError, ReadError
from colonnade.readers.motion import read_motion
from colonnade.readers.registry import read
from every import every

VALUES = np.cumsum(np.random.default_rng(4).standard_normal(800)) / 9


def block(columns, form):
    return ["".join(form % number for number in row) for row in VALUES.reshape(-1, columns)]


def numbered(lines):
    """Lines as USC numbers them, in columns 73 and 74."""
    return [f"{line:<72}{number:02d}    " for number, line in enumerate(lines, 1)]


WHOLE, REAL = ["    1  100    3 -999" * 4] * 6, ["  .0050000  .7071000 301.30000-999.00000" * 2] * 12
CSMIP_2 = [
    "Corrected accelerogram   00000001.XX.TAB.--.HN      Chan  1:  90 Deg     from",
    "Uncorrected Accelerogram Data             Processed: 04/26/13, XYZ  tab1",
    "Rcrd of Fri Apr 26, 2013 10:15:00.0 UTC               (Avol1 v0.6, 3/14 CSMIP)",
    *["a line of text"] * 12,
    "   800 points of instrument- and baseline-corrected accel, veloc and displ data",
    "At equally-spaced intervals of    .020  sec.",
    *["a line of text"] * 8,
]
USC = [f"Line {number} of the title" for number in range(1, 13)]
ESM = {"EVENT_NAME": "", "EVENT_ID": "XX-2013-0001", "STATION_CODE": "TAB", "SAMPLING_INTERVAL_S": "0.005000"}
ESM |= {"NDATA": "800", "UNITS": "cm/s^2", "HEADER_FORMAT": "DYNA 1.2"} | {f"USER{number}": "" for number in range(57)}
HEADS = {
    "BHRC": (
        ["* VOL1DS FILE:  0001/01", "Inst Type = SSA-2", *[""] * 4, "COMP L1", "UNITS ARE SECONDS AND G/10"],
        (10, "%13.6E"),
        "BHRC",
    ),
    "CSMIP/DMG, volume 1": (
        ["Uncorrected Accelerogram Data      Processed: 04/26/13, XYZ  tab1", *["a line of text"] * 12, *WHOLE, *REAL],
        (8, "%10.6f"),
        "CSMIP/DMG",
    ),
    "CSMIP/DMG, volume 2": (
        [*CSMIP_2, *WHOLE, *REAL, "   800 points of accel data equally spaced at  .020 sec, in cm/sec2. (8f10.6)"],
        (8, "%10.6f"),
        "CSMIP/DMG",
    ),
    "CSMIP/DMG, volume 3": (
        ["Response and Fourier Amplitude Spectra   00000001", *CSMIP_2[:2], *["a line of text"] * 22],
        (8, "%10.6f"),
        "CSMIP/DMG",
    ),
    "USC, volume 1": (
        ["OF UNCORRECTED ACCELEROGRAM DATA OF", *numbered(USC), *WHOLE],
        (10, "%8.4f"),
        "USC",
    ),
    "USC, volume 2": (["CORRECTED ACCELEROGRAM", "uncorrected accelerogram", *numbered(USC)], (8, "%9.3f"), "USC"),
    "SMC, first kind of header": (["2 CORRECTED ACCELEROGRAM", *["a line"] * 9, "*", *WHOLE], (8, "%10.4E"), "SMC"),
    "SMC, second kind of header": (["*", *["a line"] * 9, "*", *WHOLE], (8, "%10.4E"), "SMC"),
    "ESM": ([f"{key}: {said}" for key, said in ESM.items()], (1, "%.6f"), "ESM"),
    "GeoNet": (
        ["Corrected accelerogram 20130426_101500_TAB_20 GNS Science", "Site TAB   43 30 25S  172 43 53E", "a line"],
        (10, "%8.1f"),
        "GeoNet",
    ),
    "CWA": (
        ["#Earthquake Information", "#Origin Time(GMT+08): 2013/04/26-10:15:00", "#StationCode: TAB",
         "#SampleRate(Hz): 200", "#AmplitudeUnit:  gal. DCoffset(corr)", "#Data: 4F10.3"],
        (4, "%10.3f"),
        "CWA/CWB",
    ),
    "NSMN": (
        ["STRONG GROUND MOTION RECORDS OF TÜRKIYE", "PLACE               : TABLE", "SAMPLING INTERVAL (sec): 0.010000",
         "NUMBER OF DATA: 800", "RAW ACCELERATION (gal)", "          N-S         E-W         U-D "],
        (4, "%12.6f"),
        "NSMN/AFAD",
    ),
    "UNAM": (
        [*["==="] * 3, *["a line"] * 3, "ARCHIVO ESTANDAR DE ACELERACION", *["a line: 12"] * 30], (4, "%12.3f"), "UNAM"
    ),
    "RENADIC": ([*["a line"] * 7, "UNIVERSIDAD DE CHILE - RENADIC", "  .005  s"], (8, "%10.5f"), "RENADIC"),
}  # fmt: skip


def written(folder, name):
    lines, (columns, form), _ = HEADS[name]
    path = folder / "record.txt"
    path.write_text("\n".join([*lines, *block(columns, form), ""]), encoding="latin-1")
    return path


@every("name", HEADS)
def test_it_is_refused_by_its_formats_name_with_what_to_do(tmp_path, name):
    path = written(tmp_path, name)
    for reading in (read, read_motion, lambda path: read(path, "delimited")):
        with pytest.raises(ReadError, match="export it as text with a column of times") as told:
            reading(path)
        told.match(f"record.txt: this is a strong-motion .* in the format of {HEADS[name][2]}")


@every(
    ("start", "told"),
    [
        (b"MDF     4.10    ", "an ASAM MDF file, which is not read here. Export it as CSV or MATLAB"),
        (b"UnFinMF 4.10    ", "an ASAM MDF file, which is not read here. Export it as CSV or MATLAB"),
        ("DIAEXTENDED  {@:ENGLISH\r\n".encode("utf-16"), "a DIAdem .DAT header, which is .* Save .* as .TDM or .TDMS"),
        (b"DIAEXTENDED  {@:ENGLISH\r\n", "a DIAdem .DAT header, which is not read here. Save .* as .TDM or .TDMS"),
    ],
)
def test_a_recorders_file_is_refused_with_the_export_to_make(path, start, told):
    path.write_bytes(start + bytes(200))
    for format in (None, "delimited"):
        with pytest.raises(ReadError, match=f"record.raw: this is {told}"):
            read(path, format)


def test_a_format_that_was_read_once_is_refused_with_the_export_to_make(tmp_path):
    with pytest.raises(ReadError, match=r'Unknown format "mdf"\. This is an ASAM MDF file, .* Export it as CSV'):
        read(tmp_path / "record.mf4", "mdf")


def test_whoever_says_where_the_numbers_begin_gets_them(tmp_path):
    path, head = written(tmp_path, "CSMIP/DMG, volume 2"), HEADS["CSMIP/DMG, volume 2"][0]
    recording = read(path, "delimited", {"skip_rows": len(head), "layout": "running"})
    np.testing.assert_allclose(recording.channel(1).values, VALUES, atol=1e-6)


def test_a_draft_leaves_it_out_with_the_reason(tmp_path):
    written(tmp_path, "ESM")
    with pytest.raises(CampaignError, match=r"record.txt: this is a strong-motion record in the format of ESM"):
        draft(tmp_path)


@every(
    "head",
    ["1 velocity", "# corrected accelerogram of the table", "response spectrum analyser", "*", "Accelerogram 3, GNS"],
)
def test_a_laboratorys_own_words_are_none_of_these(path, head):
    path.write_text(f"{head}\nt [s],top [mm]\n" + "".join(f"{row / 200},{row % 7}\n" for row in range(40)))
    assert read(path).format == "delimited"
