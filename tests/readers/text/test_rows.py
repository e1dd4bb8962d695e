"""Rows become columns of numbers; rows unlike the others come with their lines and faults."""

from datetime import datetime, timedelta, timezone

import numpy as np
import pytest

from colonnade.readers.text.dialect import Dialect
from colonnade.readers.text.encoding import Piece
from colonnade.readers.text.rows import RowForm, read_rows
from every import every

FORM = RowForm(Dialect(";", "."), ("number", "number"))


INSTRUMENT = RowForm(Dialect("\t", "."), ("number", "number"), by_instrument=True)


@pytest.mark.parametrize("size", [1, 2, 5], ids="in pieces of {}".format)
def test_columns_and_lines_come_out_whatever_the_size_of_the_pieces(size):
    texts = [f"{row}.5\t{-row}" if row % 2 else "" for row in range(6)]
    pieces = [Piece(11 + at, "\n".join([*texts[at : at + size], ""])) for at in range(0, 6, size)]
    rows = read_rows([*pieces, Piece(17, "x\t4")], INSTRUMENT)
    np.testing.assert_array_equal(np.array(rows.columns)[:, ~rows.blank], [[1.5, 3.5, 5.5, np.nan], [-1, -3, -5, 4]])
    assert [row.line for row in rows.odd] == [17]
    assert rows.is_cut


def times(*stamps):
    """What a column of timestamps gives: seconds from the first, and the first."""
    text = "".join(f"{stamp};1\n" for stamp in stamps)
    rows = read_rows([Piece(1, text)], RowForm(FORM.dialect, ("time", "number")))
    return rows.columns[0], rows.start


def test_timestamps_are_seconds_from_the_first_in_later_pieces_too():
    pieces = [Piece(1, "2013-04-26 10:15:00.5;1\n2013-04-26 10:15:01;2\n"), Piece(3, "2013-04-26 10:16:00.5;3\n")]
    rows = read_rows(pieces, RowForm(FORM.dialect, ("time", "number")))
    assert rows.columns[0].tolist() == [0, 0.5, 60]
    assert rows.start == datetime(2013, 4, 26, 10, 15, 0, 500000)


def test_what_is_not_a_timestamp_is_missing():
    np.testing.assert_array_equal(times("10:15:00", "broken", "10:15:02")[0], [0, np.nan, 2])


@every(("zone", "hours"), [("Z", 0), ("+02:00", 2), ("-0330", -3.5), (" +05:45", 5.75), ("+00:00", 0)])
def test_the_first_timestamp_keeps_its_zone(zone, hours):
    seconds, start = times(*(f"2013-04-26T23:15:{second}{zone}" for second in ("00.5", "01.0")))
    assert seconds.tolist() == [0, 0.5]
    assert start == datetime(2013, 4, 26, 23, 15, 0, 500000, timezone(timedelta(hours=hours)))
    assert start.utcoffset() == timedelta(hours=hours)


def test_a_timestamp_without_a_zone_has_none():
    assert times("26.04.2013 10:15:00")[1].tzinfo is None
