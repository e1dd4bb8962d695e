"""imc FAMOS: scaling, kinds of numbers, clock, and blocks that are damaged."""

from datetime import datetime

import numpy as np
import pytest

from colonnade.errors import ReadError
from colonnade.readers.registry import read
from every import every


def test_channels_that_were_triggered_at_different_times_count_from_the_first(written):
    path = written("famos")
    content = path.read_bytes()
    second = content.rindex(b"26,4,2013,10,15,0.25")
    path.write_bytes(content[:second] + b"26,4,2013,10,15,1.75" + content[second + 20 :])
    recording = read(path)
    top, table = (channel.time for channel in recording.channels)
    np.testing.assert_allclose(top, np.arange(40) / 200)
    np.testing.assert_allclose(table, 1.5 + np.arange(40) / 200)
    assert recording.start == datetime(2013, 4, 26, 10, 15, 0, 250000)


def stored(path, packed, data, *blocks, order=1):
    """A file of one block of values, packed as its words say, and of what else is given."""
    common = [("CK", "1,1"), ("CG", "1,1,1"), ("CD", "0.5,1,2,ms,0,0,0,0.0,1"), ("CC", "1,1"), ("CP", packed)]
    block = ("Cb", f"1,0,1,1,0,{len(data)},0,{len(data)},1,2.0,0.0,")
    heads = "".join(f"|{key},1,{len(content)},{content};" for key, content in (*common, block, *blocks))
    path.write_bytes(f"|CF,2,1,{order};{heads}|CS,1,{len(data) + 2},1,".encode() + data + b";")
    return path


def whole_numbers(path, kind, form, *, order=1, packing="0,0,1,0"):
    data = np.array([0, 1, -2 if form[0] != "u" else 2, 100]).astype((">" if order == 2 else "<") + form).tobytes()
    size = int(form[1:])
    blocks = ("CR", "1,0.5,10.0,1,2,mm"), ("CN", "0,0,0,3,top,0,")
    return stored(path, f"1,{size},{kind},{8 * size},{packing}", data, *blocks, order=order)


@every(
    ("kind", "form"),
    [(1, "u1"), (2, "i1"), (3, "u2"), (4, "i2"), (5, "u4"), (6, "i4"), (7, "f4"), (8, "f8"), (12, "u8"), (14, "i8")],
)
@every("order", [1, 2])
def test_numbers_of_every_kind_are_scaled(tmp_path, kind, form, order):
    recording = read(whole_numbers(tmp_path / "record.raw", kind, form, order=order))
    third = 2 if form[0] == "u" else -2
    channel = recording.channel("top")
    assert channel.values.tolist() == [10, 10.5, 10 + 0.5 * third, 60]
    np.testing.assert_allclose(channel.time, [0.002, 0.0025, 0.003, 0.0035])  # its x is in ms
    assert channel.unit == "mm"


@every(("kind", "packing"), [(4, "0,0,1,6"), (4, "255,0,1,0"), (9, "0,0,1,0"), (11, "0,0,1,0")])
def test_numbers_that_are_packed_in_another_way_are_refused_with_what_to_do(tmp_path, kind, packing):
    with pytest.raises(ReadError, match=r'"top" is left out: bits of words and numbers that are interleaved .* export'):
        read(whole_numbers(tmp_path / "record.raw", kind, "i2", packing=packing))
