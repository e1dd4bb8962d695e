"""Workbooks: the rows of numbers of a sheet with names, units and clock; nothing that would exhaust the memory."""

import datetime as dt
import io
import zipfile

import numpy as np
import pytest

from colonnade.errors import ReadError
from colonnade.readers.registry import read
from every import every
from workbooks import ROWS, SAMPLES, ods, sheet_xml, xls, xlsx

WRITERS = {"xlsx": lambda path, rows: xlsx(path, Blatt=rows), "xls": xls, "ods": ods}


@every("kind", ["xlsx", "xls", "ods"])
def test_names_units_and_clock_are_found_above_and_among_the_rows_of_numbers(tmp_path, kind):
    recording = read(WRITERS[kind](tmp_path / f"a.{kind}", [*ROWS, *SAMPLES]))
    assert recording.format == "excel"
    assert [(each.name, each.unit) for each in recording.channels] == [
        ("Zeit", "s"),
        ("Weg oben", "mm"),
        ("Beschl.", "g"),
    ]
    top = recording.channel("Weg oben")
    np.testing.assert_array_equal(top.values, [row[1] for row in SAMPLES])
    np.testing.assert_allclose(top.time, np.arange(50) * 0.005, atol=1e-12)
    assert any("names in row 3" in note for note in recording.notes)


def test_the_sheet_with_the_samples_is_found_or_given(tmp_path):
    samples = [["Time [s]", "x [mm]"], *[row[:2] for row in SAMPLES]]
    path = xlsx(tmp_path / "a.xlsx", Cover=[["Laboratory", 3], ["Date", "today"]], Daten=samples)
    recording = read(path)
    assert any('sheet "Daten", the one with most rows of numbers' in note for note in recording.notes)
    assert read(path, options={"sheet": 2}).channel("x").unit == "mm"
    with pytest.raises(ReadError, match=r'sheet "Date" is missing\. Did you mean "Daten"'):
        read(path, options={"sheet": "Date"})
    with pytest.raises(ReadError, match=r'sheet "3" is missing\. Choose one of: "Cover"'):
        read(path, options={"sheet": 3})


def test_dates_with_times_are_a_clock_with_a_start(tmp_path):
    start = dt.datetime(2013, 4, 26, 10, 15)
    rows = [[start + dt.timedelta(milliseconds=500 * k), float(k)] for k in range(20)]
    recording = read(xlsx(tmp_path / "a.xlsx", A=[["Datum", "x"], *rows]))
    np.testing.assert_allclose(recording.channel("x").time, np.arange(20) * 0.5, atol=2e-3)
    assert recording.start == start


def test_formulas_give_their_cached_value_and_text_is_only_text(tmp_path):
    rows = [[k * 0.1, f"=A{k + 2}*2→{k * 0.2!r}", 'HYPERLINK("http://example.org")'] for k in range(10)]
    recording = read(xlsx(tmp_path / "a.xlsx", A=[["t [s]", "x [mm]", "note"], *rows]))
    np.testing.assert_allclose(recording.channel("x").values, np.arange(10) * 0.2)
    assert np.isnan(recording.channel("note").values).all()


def test_cells_that_are_no_numbers_are_told_with_their_rows(tmp_path):
    samples = [list(row) for row in SAMPLES]
    samples[4][1], samples[6][2], samples[9] = "abc", "0,5", ["pause", None, None]
    recording = read(xlsx(tmp_path / "a.xlsx", A=[*ROWS, *samples, ["measured by M. Rossi"]]))
    assert recording.channel("Beschl.").values[6] == 0.5
    assert np.isnan(recording.channel("Weg oben").values[4])
    told = " ".join(recording.warnings)
    assert '"Weg oben": 1 cell holds no number (in row 9: "abc"); missing' in told
    assert 'rows 14, 55: left out: text without a number ("pause")' in told


def test_the_clock_the_row_of_names_and_the_layout_can_be_given(tmp_path):
    rows = [["old", "names"], [1234567, 123456789012345], *[[k * 5.0, float(k)] for k in range(9)]]
    path = xlsx(tmp_path / "a.xlsx", A=rows)
    recording = read(path, options={"time": 1, "time_unit": "ms", "names_row": 2})
    np.testing.assert_allclose(recording.channel("123456789012345").time, np.arange(9) * 0.005)
    assert read(path, options={"layout": "running", "names_row": 2}).channel(1).values.tolist()[:4] == [0, 0, 5, 1]


def test_a_stray_cell_far_outside_is_refused_with_its_cause(tmp_path):
    far = sheet_xml([["t", "x"], *[row[:2] for row in SAMPLES]]).replace(
        "</sheetData>", '<row r="1048576"><c r="XFD1048576"><v>1</v></c></row></sheetData>'
    )
    with pytest.raises(ReadError, match="a cell far outside its table"):
        read(xlsx(tmp_path / "a.xlsx", A=far))


@every("kind", ["xlsx", "xls"])
def test_a_workbook_that_was_cut_off_is_refused(tmp_path, kind):
    path = WRITERS[kind](tmp_path / f"a.{kind}", [*ROWS, *SAMPLES])
    whole = path.read_bytes()
    path.write_bytes(whole[: len(whole) * 2 // 3])
    with pytest.raises(ReadError, match=r'(cannot be read as "excel" |crashed).* was cut off'):
        read(path)


def test_a_chain_of_sectors_that_comes_back_to_itself_is_refused(tmp_path):
    path = xls(tmp_path / "a.xls", [*ROWS, *SAMPLES * 40])
    content = bytearray(path.read_bytes())
    table = (int.from_bytes(content[76:80], "little") + 1) * 512
    content[table + 4 * 5 : table + 4 * 6] = (4).to_bytes(4, "little")
    path.write_bytes(content)
    with pytest.raises(ReadError, match='cannot be read as "excel"'):
        read(path)


def test_another_zip_archive_is_no_workbook(tmp_path):
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w") as archive:
        archive.writestr("readme.txt", "raw files")
    (tmp_path / "a.xlsx").write_bytes(buffer.getvalue())
    with pytest.raises(ReadError, match="excel: it is a zip archive without a workbook in it"):
        read(tmp_path / "a.xlsx")


def test_a_workbook_without_numbers_says_so(tmp_path):
    with pytest.raises(ReadError, match=r'no sheet holds rows of numbers \("A"\)'):
        read(xlsx(tmp_path / "a.xlsx", A=[["only", "words"], ["in", "it"]]))
