"""What is written as delimited text comes back equal, however it is written."""

from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from colonnade.readers.registry import read

SEPARATORS = {";": ";", "tab": "\t", "|": "|", ",": ",", "spaces": "  ", "; ": "; "}
ENCODINGS = ["utf-8", "utf-8-sig", "utf-16", "latin-1", "cp1252"]
PREAMBLES = [
    [],
    ["Erdbebensimulator, Prüfstand 3"],
    ["# recorded by: a logger", "# rate: 200 Hz", ""],
    ["Sampling rate;200", "Channels;3", "Operator;N. N.", "Date;26.04.2013", ""],
    [
        "",
        "",
        "Title: rocking of a prism",
        "Remark, with, so, many, commas, in, it, that, no, table, here, is, as, wide",
    ],
]
NAMES = ["LVDT 1", "Kraft oben", "ACC-X", "µ-strain", "Table accel XXXX", "1281068", "top"]
UNITS = ["mm", "V", "kN", "m/s²", "g", "°", "Volts"]


@st.composite
def writings(draw):
    """One way of writing a table."""
    separator = draw(st.sampled_from(list(SEPARATORS.values())))
    return SimpleNamespace(
        separator=separator,
        decimal="." if separator == "," else draw(st.sampled_from([".", ","])),
        encoding=draw(st.sampled_from(ENCODINGS)),
        preamble=draw(st.sampled_from(PREAMBLES)),
        naming=draw(st.sampled_from(["none", "names", "names and units", "units in names"])),
        line_end=draw(st.sampled_from(["\n", "\r\n", "\r"])),
        trailing=separator in ";\t|," and draw(st.booleans()),
        quoted_names=separator in ";\t|," and draw(st.booleans()),
        last_line_ended=draw(st.booleans()),
    )


@st.composite
def tables(draw):
    """Numbers in text with a point, as many decimals in each; the first column is a clock at 200 Hz."""
    columns = draw(st.integers(2, 5))
    rows = draw(st.integers(6, 30))
    decimals = draw(st.integers(1, 7))
    values = st.integers(-(10**9), 10**9).map(lambda number: f"{number / 10**decimals:.{decimals}f}")
    body = draw(st.lists(st.lists(values, min_size=columns, max_size=columns), min_size=rows, max_size=rows))
    return [[f"{row * 0.005:.3f}", *cells] for row, cells in enumerate(body)]


def write(path, table, writing):
    """Write a table; return the names and units that have to be found."""
    columns = len(table[0])
    names = ["Time", *NAMES[: columns - 1]]
    units = ["s", *UNITS[: columns - 1]]
    blank = writing.separator.strip(" ") == ""
    if blank:
        names = [name.replace(" ", "_") for name in names]
    heads = []
    if writing.naming == "names":
        heads = [names]
    elif writing.naming == "names and units":
        heads = [names, units]
    elif writing.naming == "units in names":
        heads = [[f"{name}{'' if blank else ' '}[{unit}]" for name, unit in zip(names, units, strict=True)]]
    if writing.quoted_names:
        heads = [[f'"{cell}"' for cell in cells] for cells in heads]
    body = [[cell.replace(".", writing.decimal) for cell in row] for row in table]
    rows = [writing.separator.join(cells) + (writing.separator if writing.trailing else "") for cells in heads + body]
    text = writing.line_end.join([*writing.preamble, *rows]) + (writing.line_end if writing.last_line_ended else "")
    path.write_bytes(text.encode(writing.encoding, errors="replace"))
    if writing.naming == "none":
        return [f"column {number}" for number in range(1, columns + 1)], [None] * columns
    return names, (units if writing.naming != "names" else [None] * columns)


@settings(max_examples=150, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(table=tables(), writing=writings())
def test_numbers_names_and_units_come_back(path, table, writing):
    names, units = write(path, table, writing)
    recording = read(path)
    assert recording.warnings == ()
    read_back = np.array([channel.values for channel in recording.channels]).T
    np.testing.assert_array_equal(read_back, np.array(table, dtype=float))
    assert [channel.name for channel in recording.channels] == names
    assert [channel.unit for channel in recording.channels] == units
    for channel in recording.channels:
        np.testing.assert_array_equal(channel.time, read_back[:, 0])  # it rises in equal steps, also without a name


@settings(max_examples=40, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    values=st.lists(st.floats(-1e12, 1e12, allow_subnormal=False), min_size=5, max_size=20),
    style=st.sampled_from(["{:.15g}", "{:.9e}", "{:+.4E}"]),
)
def test_numbers_of_fifteen_digits_are_exact_in_any_notation(path, values, style):
    texts = [style.format(value if abs(value) > 1e-6 else 0.0) for value in values]
    path.write_text("a;b\n" + "".join(f"{text};{text}\n" for text in texts))
    np.testing.assert_allclose(read(path).channel("b").values, [float(text) for text in texts], rtol=3e-16, atol=0)


@pytest.mark.parametrize("size", [700, 4000, 1_000_000])
def test_what_is_read_does_not_depend_on_the_pieces(path, size, monkeypatch):
    rows = [f"{number / 8};{number % 7},5;ä{number}" for number in range(2000)]
    rows[900:900] = ["", "", ""]
    rows[1200], rows[1500] = "150,125;-;ä", "# a remark"
    path.write_text("t;x;said\r\n" + "\r\n".join(rows).replace(".", ","), encoding="utf-8", newline="")
    expected = read(path)
    monkeypatch.setattr("colonnade.readers.text.encoding.PIECE", size)
    found = read(path)
    assert (found.notes, found.warnings) == (expected.notes, expected.warnings)
    for channel, same in zip(found.channels, expected.channels, strict=True):
        np.testing.assert_array_equal(channel.values, same.values)
