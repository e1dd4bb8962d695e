"""NI DIAdem: headers in XML, objects that refer to one another, packed or plain, and bytes that are elsewhere."""

import numpy as np
import pytest

from colonnade.errors import ReadError
from colonnade.readers.registry import read
from every import every
from raw_files import tdm


@every(
    ("kind", "parameters", "values"),
    [
        ("explicit_external", "", [0, 1, -2, 100]),
        ("raw_linear_external", "1.5 0.25", [1.5, 1.75, 1, 26.5]),
        ("implicit_linear", "3 2", [3, 5, 7, 9, 11, 13, 15]),
    ],
)
def test_a_channel_is_scaled_or_made_up_as_its_column_says(path, kind, parameters, values):
    assert read(tdm(path, kind=kind, parameters=parameters, rows=7)).channel("top").values.tolist() == values


@every(
    ("known", "other", "told"),
    [('"l1"))', '"l9"))', "l9"), ('"inc0"/', '"inc9"/', "inc9"), ("raw_linear", "odd", '"odd"')],
)
def test_a_channel_that_cannot_be_found_says_why(path, known, other, told):
    path.write_text(tdm(path).read_text(encoding="utf-8").replace(known, other, 1), encoding="utf-8")
    recording = read(path)
    assert [channel.name for channel in recording.channels] == ["table", "even"]
    assert told in recording.warnings[0]


def test_a_packed_header_that_is_damaged_is_refused(path):
    content = tdm(path, packed=True).read_bytes()
    path.write_bytes(content.replace(content[60:70], bytes(10), 1))
    with pytest.raises(ReadError, match=r"record.raw: it cannot be read as .* is damaged"):
        read(path, "diadem")


@every("packed", [False, True])
@every("order", ["littleEndian", "bigEndian"])
def test_a_tdm_header_tells_scaling_interleaving_and_clock(path, packed, order):
    recording = read(tdm(path, packed=packed, order=order))
    top = recording.channel("top")
    assert (top.values.tolist(), top.unit) == ([10, 10.5, 9, 60], "mm")
    np.testing.assert_allclose(top.time, [-0.01, -0.005, 0, 0.005])
    assert recording.channel("table").values.tolist() == [0.5, 1.5, 2.5]
    assert recording.channel("even").values.tolist() == [1, 3, 5]


@every(("url", "told"), [("../a.tdx", "a.tdx"), ("C:\\data\\a.tdx", "a.tdx"), ("b.tdx", "b.tdx")])
def test_values_are_only_looked_for_beside_the_header_under_its_name(tmp_path, url, told):
    path = tdm(tmp_path / "a.tdm", url=url)
    if told == "a.tdx":
        assert read(path).channels  # whatever folder is written
        path.with_suffix(".tdx").unlink()
    with pytest.raises(
        ReadError, match=rf'its values are in the file "{told}"; they were expected next to it in a.tdx'
    ):
        read(path)


def test_a_file_of_values_without_bytes_is_refused(written):
    path = written("diadem")
    path.with_suffix(".tdx").write_bytes(b"")
    with pytest.raises(ReadError, match=r'"table": record.tdx ends after 0 of its 40 values'):
        read(path)
