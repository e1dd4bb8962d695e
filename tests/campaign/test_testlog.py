"""The laboratory's own test log: the same campaign as with [[tests]], and errors by row and column."""

import io
import re
from datetime import date, datetime
from pathlib import Path

import pytest
import xlwt
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from colonnade.campaign import load
from colonnade.errors import CampaignError
from workbooks import xlsx

CONTRACT = Path(__file__).with_name("contract.toml").read_text(encoding="utf-8")
HEADS = [
    *("id", "kind", "specimen", "setup", "file", "file.daq2", "window", "zero", "span", "observed_outcome"),
    *("frequency",),
]
ROWS = [
    ["free-01", "free-vibration", "prism", "frame", "raw/a.csv", "raw/b.csv", "2 s, 14 s", "0 s to 0.5 s", "", "", ""],
    ["2", "earthquake", "prism", "frame", "raw/c.csv", "", "", "end", "2.5", "rocking", ""],
    ["3", "sine", "prism", "frame", "raw/d.csv", "", "", "", "", "", "3.5 Hz"],
]


def with_log(folder, name, content):
    text = CONTRACT[: CONTRACT.index("[[tests]]")].replace("[specimens]", f'tests = "{name}"\n\n[specimens]', 1)
    (folder / "campaign.toml").write_text(text, encoding="utf-8")
    (folder / name).write_bytes(content)
    return load(folder)


def table(delimiter, rows):
    quoted = [[f'"{cell}"' if delimiter in cell else cell for cell in row] for row in rows]
    return "\n".join(delimiter.join(row) for row in quoted) + "\n"


def with_rows(folder, rows):
    return with_log(folder, "log.csv", table(";", rows).encode())


def workbook(rows):
    """Write an xlsx: text as text, numbers as numbers."""
    written = io.BytesIO()
    typed = [[float(cell) if re.fullmatch(r"[0-9.]+", cell) else cell or None for cell in row] for row in rows]
    xlsx(written, log=typed)
    return written.getvalue()


LOGS = {
    "commas.csv": table(",", [HEADS, *ROWS]).encode(),
    "semicolons.csv": table(";", [HEADS, *ROWS]).replace("2.5", "2,5").replace("3.5 Hz", "3,5 Hz").encode("cp1252"),
    "bom.csv": b"\xef\xbb\xbf" + table(";", [HEADS, *ROWS]).encode(),
    "utf16.csv": table("\t", [HEADS, *ROWS]).encode("utf-16"),
    "log.xlsx": workbook([HEADS, *ROWS]),
}


@pytest.mark.parametrize("name", LOGS)
def test_a_log_gives_the_tests_whatever_wrote_it(name, tmp_path):
    tests = with_log(tmp_path, name, LOGS[name]).tests
    assert list(tests) == ["free-01", "2", "3"]
    folder = tmp_path.resolve() / "raw"
    assert tests["free-01"].files == {"main": folder / "a.csv", "daq2": folder / "b.csv"}
    assert (tests["free-01"].window, tests["free-01"].zero) == ((2.0, 14.0), (0.0, 0.5))
    assert (tests["2"].span, tests["2"].zero, tests["2"].observed_outcome) == (2.5, "end", "rocking")
    assert (tests["3"].frequency, tests["3"].zero, tests["3"].files) == (3.5, "auto", {"main": folder / "d.csv"})


def test_a_workbook_is_not_parsed_in_this_process(tmp_path, monkeypatch):
    monkeypatch.setattr("colonnade.readers.binary.excel._sheet", None)
    with_log(tmp_path, "log.xlsx", LOGS["log.xlsx"])


def test_a_log_says_who_and_when_and_names_photos(tmp_path):
    heads = [*HEADS, "date", "operator", "photos"]
    first = ["26.04.2013", "M. Rossi", "photos/a.jpg; photos/b.png"]
    second = ["2013-04-27", "Κ. Παπάς", "photos/a.jpg,photos/b.png"]
    rows = [[*row, *more] for row, more in zip(ROWS, (first, second, [""] * 3), strict=True)]
    tests = with_rows(tmp_path, [heads, *rows]).tests
    assert [test.date for test in tests.values()] == [date(2013, 4, 26), date(2013, 4, 27), None]
    assert [test.operator for test in tests.values()] == ["M. Rossi", "Κ. Παπάς", None]
    assert [test.photos for test in tests.values()] == [("photos/a.jpg", "photos/b.png")] * 2 + [()]


def test_heads_may_have_units_and_capitals_and_a_cell_several_lines(tmp_path):
    heads = [{"frequency": "Frequency [Hz]", "kind": "Kind"}.get(head, head) for head in HEADS]
    rows = [[*row[:-1], row[-1].removesuffix(" Hz"), said] for row, said in zip(ROWS, ("", '"a\nb"', ""), strict=True)]
    tests = with_rows(tmp_path, [[*heads, "notes"], *rows]).tests
    assert (tests["3"].kind, tests["3"].frequency, tests["2"].notes) == ("sine", 3.5, "a\nb")


def test_a_date_of_excel_is_a_date(tmp_path):
    book, written = xlwt.Workbook(), io.BytesIO()
    sheet, style = book.add_sheet("log"), xlwt.easyxf(num_format_str="DD.MM.YYYY")
    for number, row in enumerate([[*HEADS, "date"], *([*row, datetime(2013, 4, 26)] for row in ROWS)]):
        for column, cell in enumerate(row):
            sheet.write(number, column, cell, *([style] if isinstance(cell, datetime) else []))
    book.save(written)
    tests = with_log(tmp_path, "log.xls", written.getvalue()).tests
    assert {test.date for test in tests.values()} == {date(2013, 4, 26)}


@pytest.mark.parametrize(
    ("row", "column", "cell", "told"),
    [
        (1, 1, "earthquakes", 'log.csv, row 3, column "kind": tests[2].kind: "earthquakes" was found. Did you mean'),
        (0, 2, "prsm", 'log.csv, row 2, column "specimen": tests[free-01].specimen: Unknown specimen "prsm"'),
        (2, 10, "3.5", 'log.csv, row 4, column "frequency": tests[3].frequency: "3.5" has no unit.'),
        (1, 8, "much", 'log.csv, row 3, column "span": tests[2].span: "much" was found. A plain number'),
        (2, 0, "FREE-01", 'log.csv, row 4, column "id": tests[FREE-01].id'),
        (2, 0, "", 'log.csv, row 4, column "id": tests[3].id: It is missing.'),
        (0, 5, "../b.csv", 'log.csv, row 2, column "file.daq2": tests[free-01].file.daq2: "../b.csv" is outside'),
        (0, 6, "14 s, 2 s", 'log.csv, row 2, column "window": tests[free-01].window'),
    ],
)
def test_a_wrong_cell_is_told_by_row_and_column(row, column, cell, told, tmp_path):
    rows = [list(each) for each in ROWS]
    rows[row][column] = cell
    with pytest.raises(CampaignError, match=re.escape(told)):
        with_rows(tmp_path, [HEADS, *rows])


def test_wrong_cells_are_told_in_the_order_of_their_rows(tmp_path):
    rows = [list(each) for each in ROWS]
    rows[2][0], rows[1][2] = "free-01", "prsm"
    with pytest.raises(CampaignError) as caught:
        with_rows(tmp_path, [HEADS, *rows])
    assert [line[:15] for line in str(caught.value).splitlines()] == ["log.csv, row 3,", "log.csv, row 4,"]


def test_a_column_of_the_laboratorys_own_is_warned_of_and_a_mistyped_key_refused(tmp_path):
    rows = [[*row, "sunny"] for row in ROWS]
    campaign = with_rows(tmp_path, [[*HEADS, "Weather"], *rows])
    assert 'log.csv: column "Weather" is not a key of a test; it is ignored.' in map(str, campaign.warnings)
    with pytest.raises(CampaignError, match=r'log\.csv: unknown column "windw"\. Did you mean "window"\?'):
        with_rows(tmp_path, [[*HEADS, "windw"], *rows])


@pytest.mark.parametrize(
    ("content", "told"),
    [
        (b"", "log.csv: the file is empty. A test log with a row of column heads was expected."),
        (b"id;id;kind\n1;2;sine\n", 'duplicate column head "id"'),
        (b"id;kind\n1;sine;more\n", "log.csv, row 2: 3 cells are below 2 heads"),
        (b'id;kind\n"1;sine\n', "row 2"),
        (bytes(range(256)), "log.csv"),
    ],
)
def test_what_is_no_table_is_refused(content, told, tmp_path):
    with pytest.raises(CampaignError, match=re.escape(told)):
        with_log(tmp_path, "log.csv", content)


@pytest.mark.parametrize("gap", [" " * 200_000, " " * 200_000 + ";"], ids=["blanks", "blanks before a separator"])
def test_blanks_in_an_interval_cost_nothing(tmp_path, gap):
    heads, row = ["id", "kind", "specimen", "setup", "file", "window"], ["1", "sine", "prism", "frame", "raw/a.csv"]
    with pytest.raises(CampaignError) as refused:
        with_log(tmp_path, "log.csv", table(",", [heads, [*row, f'"2 s{gap}x"']]).encode())
    assert len(str(refused.value)) < 1000


def test_a_missing_log_names_the_nearest_file(tmp_path):
    with_log(tmp_path, "log.csv", LOGS["commas.csv"])
    text = (tmp_path / "campaign.toml").read_text(encoding="utf-8")
    (tmp_path / "campaign.toml").write_text(text.replace("log.csv", "logg.csv"), encoding="utf-8")
    told = r'line 7: tests: logg\.csv: there is no such file in .*Did you mean "log\.csv"'
    with pytest.raises(CampaignError, match=told):
        load(tmp_path)


@settings(max_examples=60, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    st.sampled_from(sorted(LOGS)),
    st.lists(st.tuples(st.integers(0, 3000), st.integers(0, 255)), max_size=6),
    st.booleans(),
)
def test_a_damaged_log_is_read_or_refused_never_a_traceback(tmp_path, name, changes, cut):
    content = bytearray(LOGS[name])
    for place, byte in changes:
        content[place % len(content)] = byte
    if cut and changes:
        del content[changes[0][0] % len(content) :]
    told = ""
    try:
        with_log(tmp_path, name, bytes(content))
    except CampaignError as error:
        told = str(error)
    assert all(line.startswith((name, "campaign.toml")) for line in told.splitlines())
