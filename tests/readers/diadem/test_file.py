"""NI DIAdem: both headers, and bytes that are elsewhere."""

from __future__ import annotations

import zipfile
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from colonnade.errors import ReadError
from colonnade.readers.diadem import tdm as diadem_tdm
from colonnade.readers.registry import read, read_here

TDM = """<?xml version="1.0" encoding="UTF-8"?><usi:tdm xmlns:usi="http://www.ni.com/Schemas/USI/1_0" version="1.0">
<usi:include><file byteOrder="{order}" url="{url}"><block byteOffset="0" id="inc0" length="4" valueType="eInt16Usi"/>
<block byteOffset="8" blockOffset="{lag}" blockSize="16" id="inc1" length="3" valueType="eFloat64Usi"/>
</file></usi:include>
<usi:data>
<short_sequence id="s1"><values external="inc0"/></short_sequence>
<double_sequence id="s2"><values external="inc1"/></double_sequence>
<tdm_channel id="c1"><name>top</name><unit_string>mm</unit_string><instance_attributes>
<double_attribute name="wf_increment">0.005</double_attribute>
<double_attribute name="wf_start_offset">-0.01</double_attribute>
</instance_attributes><local_columns>#xpointer(id("l1"))</local_columns></tdm_channel>
<tdm_channel id="c2"><name>table</name><unit_string>g</unit_string>
<local_columns>#xpointer(id("l2"))</local_columns></tdm_channel>
<tdm_channel id="c3"><name>even</name><local_columns>#xpointer(id("l3"))</local_columns></tdm_channel>
<localcolumn id="l1"><sequence_representation>raw_linear</sequence_representation>
<generation_parameters>10 0.5</generation_parameters><values>#xpointer(id("s1"))</values></localcolumn>
<localcolumn id="l2"><sequence_representation>explicit</sequence_representation><values>#xpointer(id("s2"))</values>
</localcolumn>
<localcolumn id="l3"><sequence_representation>implicit_linear</sequence_representation>
<generation_parameters>1 2</generation_parameters><submatrix>#xpointer(id("m3"))</submatrix></localcolumn>
<submatrix id="m3"><number_of_rows>{rows}</number_of_rows></submatrix>
</usi:data></usi:tdm>"""


def tdm(
    tmp_path: Path, *, packed: bool = False, order: str = "littleEndian", rows: int = 3, url: str = "r.tdx"
) -> Path:
    text = TDM.format(order=order, url=url, lag=0, rows=rows)
    sign = "<" if order == "littleEndian" else ">"
    numbers = np.array([0, 1, -2, 100]).astype(f"{sign}i2").tobytes()
    floats = np.array([0.5, 9, 1.5, 9, 2.5, 9]).astype(f"{sign}f8").tobytes()
    (tmp_path / "r.tdx").write_bytes(numbers + floats)
    path = tmp_path / "r.TDM"
    if packed:
        with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
            archive.writestr("header.xml", text)
    else:
        path.write_text(text, encoding="utf-8")
    return path


@pytest.mark.parametrize("packed", [False, True], ids=["plain", "packed"])
@pytest.mark.parametrize("order", ["littleEndian", "bigEndian"])
def test_a_tdm_header_tells_scaling_interleaving_and_clock(tmp_path: Path, packed: bool, order: str) -> None:
    recording = read(tdm(tmp_path, packed=packed, order=order))
    top = recording.channel("top")
    assert (top.values.tolist(), top.unit) == ([10, 10.5, 9, 60], "mm")
    assert top.time is not None
    np.testing.assert_allclose(top.time, [-0.01, -0.005, 0, 0.005])
    assert recording.channel("table").values.tolist() == [0.5, 1.5, 2.5]
    assert recording.channel("even").values.tolist() == [1, 3, 5]


def test_a_channel_that_is_not_stored_is_no_longer_than_those_that_are(tmp_path: Path) -> None:
    assert read(tdm(tmp_path, rows=10**12)).channel("even").values.size == 4


def test_a_path_out_of_the_folder_is_not_followed(tmp_path: Path) -> None:
    folder = tmp_path / "data"
    folder.mkdir()
    path = tdm(folder, url="../r.tdx")
    (folder / "r.tdx").rename(tmp_path / "r.tdx")
    with pytest.raises(ReadError, match=r'its values are in the file "r.tdx", which is not in its folder'):
        read(path)


def test_entities_and_bombs_are_not_unpacked(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tdm(tmp_path)
    path.write_text(path.read_text().replace("?><usi", '?><!DOCTYPE a [<!ENTITY b "c">]><usi'), encoding="utf-8")
    with pytest.raises(ReadError, match="its own entities"):
        read(path)
    monkeypatch.setattr(diadem_tdm, "LARGEST_HEADER", 1 << 16)
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("header.xml", bytes(1 << 17))
    with pytest.raises(ReadError, match="it is not unpacked"):
        read_here(path, "diadem", {}, None)


def test_a_text_header_tells_the_clock_and_missing_values(written: Callable[..., Path]) -> None:
    values = np.arange(40.0)
    values[5] = 9.9e34
    recording = read(written("diadem", ("top", "mm", values)))
    top = recording.channel("top")
    assert np.flatnonzero(np.isnan(top.values)).tolist() == [5]
    assert recording.channel("Time").is_clock
    np.testing.assert_allclose(top.time, np.arange(40) / 200, atol=1e-8)


@pytest.mark.parametrize("method", ["CHANNEL", "BLOCK"])
def test_values_are_found_channel_by_channel_and_row_by_row(written: Callable[..., Path], method: str) -> None:
    path = written("diadem", ("top", "mm", np.arange(40.0)), ("table", "g", -np.arange(40.0)))
    if method == "BLOCK":
        path.write_bytes(path.read_bytes().decode("utf-16").replace("213,CHANNEL", "213,BLOCK").encode("utf-16"))
        stored = np.frombuffer(path.with_suffix(".R32").read_bytes(), "<f4").reshape(3, 40)
        path.with_suffix(".R32").write_bytes(stored.T.tobytes())
    recording = read(path)
    assert recording.channel("table").values.tolist() == [-float(row) for row in range(40)]


def test_values_that_are_cut_off_are_told(written: Callable[..., Path]) -> None:
    path = written("diadem")
    values = path.with_suffix(".R32")
    values.write_bytes(values.read_bytes()[:-40])
    recording = read(path)
    assert recording.warnings == ('"table": record.R32 ends after 30 of its 40 values',)


def test_a_header_without_its_values_says_which_file_is_lacking(written: Callable[..., Path]) -> None:
    path = written("diadem")
    path.with_suffix(".R32").unlink()
    with pytest.raises(ReadError, match=r'its values are in the file "record.R32", which is not in its folder'):
        read(path)
