"""imc FAMOS: scaling, kinds of numbers, clock, and blocks that are damaged."""

from datetime import datetime

import numpy as np
import pytest

from colonnade.errors import ReadError
from colonnade.readers.registry import read
from every import every


def test_start_is_that_of_the_trigger_and_the_blocks_offset(written):
    recording = read(written("famos"))
    assert recording.start == datetime(2013, 4, 26, 10, 15, 0, 250000)


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


def whole_numbers(path, kind, form, *, order=1, packing="0,0,1,0"):
    data = np.array([0, 1, -2 if form[0] != "u" else 2, 100]).astype((">" if order == 2 else "<") + form).tobytes()
    size = int(form[1:])
    packed = f"1,{size},{kind},{8 * size},{packing}"
    blocks = [
        f"|CF,2,1,{order};",
        *(
            f"|{key},1,{len(content)},{content};"
            for key, content in (
                ("CK", "1,1"),
                ("CG", "1,1,1"),
                ("CD", "0.5,1,2,ms,0,0,0,0.0,1"),
                ("CC", "1,1"),
                ("CP", packed),
                ("CR", "1,0.5,10.0,1,2,mm"),
                ("CN", "0,0,0,3,top,0,"),
                ("Cb", f"1,0,1,1,0,{len(data)},0,{len(data)},1,2.0,0.0,"),
            )
        ),
        f"|CS,1,{len(data) + 2},1,",
    ]
    path.write_bytes("".join(blocks).encode() + data + b";")
    return path


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
    assert channel.time is not None
    np.testing.assert_allclose(channel.time, [0.002, 0.0025, 0.003, 0.0035])  # its x is in ms
    assert channel.unit == "mm"


@every(("kind", "packing"), [(4, "0,0,1,6"), (4, "255,0,1,0"), (9, "0,0,1,0")])
def test_numbers_that_are_packed_in_another_way_are_refused(tmp_path, kind, packing):
    with pytest.raises(ReadError, match="interleaved or of an unknown kind"):
        read(whole_numbers(tmp_path / "record.raw", kind, "i2", packing=packing))


def test_a_file_that_ends_within_its_values_says_so(written):
    path = written("famos")
    path.write_bytes(path.read_bytes()[:-41])
    recording = read(path)
    assert recording.channel("table").values.size == 30
    assert '"table": the file ends after 30 of its 40 values' in recording.warnings


def digital_word(path, names, *, kind=11, bits=16, scaled=False):
    words = np.array([0b0000, 0b0001, 0b0110, 0b0111, 0x8001], dtype="<u2").tobytes()
    if kind == 7:
        words = np.zeros(5, dtype="<f4").tobytes()
    size = len(words) // 5
    blocks = ["|CF,2,1,1;"]
    contents = [("CK", "1,1"), ("CG", "1,1,1"), ("CD", "0.01,1,1,s,0,0,0,0.0,1"), ("CC", "1,1")]
    contents += [("CP", f"1,{size},{kind},{bits},0,0,1,0"), ("Cb", f"1,0,1,1,0,{len(words)},0,{len(words)},1,0.0,0.0,")]
    contents += [("CR", "1,5.0,3.0,1,1,V")] if scaled else []
    contents += [("CN", f"0,0,{bit},{len(name)},{name},0,") for bit, name in names.items()]
    blocks += [f"|{key},1,{len(content)},{content};" for key, content in contents]
    path.write_bytes("".join([*blocks, f"|CS,1,{len(words) + 2},1,"]).encode() + words + b";")
    return path


@every("bits", [16, 4])
@every("scaled", [False, True])
def test_digital_channels_of_one_word_are_channels_of_their_own(tmp_path, bits, scaled):
    names = {1: "release", 2: "door", 3: "pump", 16: "sync"}
    recording = read(digital_word(tmp_path / "record.raw", names, bits=bits, scaled=scaled))
    found = {channel.name: channel.values.tolist() for channel in recording.channels}
    assert found == {
        "release": [0, 1, 0, 1, 1],
        "door": [0, 0, 1, 1, 0],
        "pump": [0, 0, 1, 1, 0],
        "sync": [0, 0, 0, 0, 1],
    }
    assert all(channel.unit is None for channel in recording.channels)
    np.testing.assert_allclose(recording.channel("sync").time, 0.01 * np.arange(5))


def test_a_bit_that_no_word_has_and_bits_of_a_fraction_are_left_out(tmp_path):
    recording = read(digital_word(tmp_path / "record.raw", {1: "release", 99: "door"}))
    assert [channel.name for channel in recording.channels] == ["release"]
    assert any('"door": it is bit 99 of a word' in told for told in recording.warnings)
    with pytest.raises(ReadError, match="digital channels have to be whole numbers"):
        read(digital_word(tmp_path / "fraction.raw", {1: "release"}, kind=7, bits=32))
