"""MTS 793 text: what the first line declares, and blocks."""

import pytest

from colonnade.errors import ReadError
from colonnade.readers.registry import read
from every import every


def written(tmp_path, *lines):
    path = tmp_path / "specimen.dat"
    path.write_bytes("\r\n".join([*lines, ""]).encode("latin-1"))
    return path


HEAD = "MTS793|MPT|ENU|1|2|.|/|:|1|0|0|A"


def block(first, title, delimiter="\t", decimal="."):
    rows = [[first + 0.5 * row, 10.5 + row, -row] for row in range(3)]
    numbers = [delimiter.join(f"{cell:.4f}".replace(".", decimal) for cell in row) for row in rows]
    names = delimiter.join(["Running Time", "Axial Displacement", "Axial Force"])
    return [title, names, delimiter.join(["s", "mm", "kN"]), *numbers, ""]


@every(
    ("declared", "delimiter", "decimal", "title"),
    [
        ("ENU|1|2|.|/|:|1|0|0|A", "\t", ".", "Data Acquisition\tTime:\t10.0\tSec\t4/26/2013 1:54:32 PM"),
        ("DEU|1|2|,|.|:|49|1|1|A", "\t", ",", "Datenerfassung\tZeit:\t10,0\ts\t26.04.2013 13:54:32"),
        ("ENU|1|1|.|/|:|1|0|0|A", ",", ".", '"Data Acquisition","Time:",10.0,"Sec","4/26/2013 1:54:32 PM"'),
        ("ENU|1|0|.|/|:|1|0|0|A", "   ", ".", "Data Acquisition   Time:   10.0   Sec   4/26/2013 1:54:32 PM"),
    ],
)
def test_the_first_line_declares_delimiter_and_decimal_sign(tmp_path, declared, delimiter, decimal, title):
    lines = block(2.0, title, delimiter, decimal)
    recording = read(written(tmp_path, f"MTS793|MPT|{declared}", "", *lines))
    assert recording.format == "mts"
    assert [(channel.name, channel.unit) for channel in recording.channels] == [
        ("Running Time", "s"),
        ("Axial Displacement", "mm"),
        ("Axial Force", "kN"),
    ]
    force = recording.channel("Axial Force")
    assert force.values.tolist() == [0, -1, -2]
    assert force.time.tolist() == [2.0, 2.5, 3.0]
    assert recording.warnings == ()


def test_blocks_of_the_same_columns_go_on_and_others_are_kept_apart(tmp_path):
    title = "Data Acquisition\tTime:\t{}\tSec\t4/26/2013 1:54:32 PM"
    lines = []
    for number, first in enumerate((0.0, 100.0)):
        lines += block(first, title.format(f"{10 + number}.0"))
    lines += [title.format("30.0"), "Axial Force\tStrain", "kN\tmm/mm", "7.5\t0.1", ""]
    recording = read(written(tmp_path, HEAD, "", *lines))
    displacement = recording.channel("Axial Displacement")
    assert displacement.values.tolist() == [10.5, 11.5, 12.5] * 2
    assert displacement.time.tolist() == [0, 0.5, 1, 100, 100.5, 101]
    assert recording.channel("block 2: Axial Force").values.tolist() == [7.5]
    assert recording.warnings == ()
    assert recording.channel("block 2: Axial Force").time is None


def test_notes_of_the_operator_are_no_block(tmp_path):
    lines = ["Operator Information\tTime:\t1.0\tSec\t4/26/2013 1:54:32 PM", "Weight\t5342", "Length\t300.3", ""]
    with pytest.raises(ReadError, match="no block of numbers"):
        read(written(tmp_path, HEAD, *lines))


def test_a_first_line_that_declares_nothing_is_refused(tmp_path):
    with pytest.raises(ReadError, match=r'line 1 is "MTS793\|MPT\|ENU"; .* was expected'):
        read(written(tmp_path, "MTS793|MPT|ENU", "1\t2"))
