"""NI DIAdem: headers in XML, objects that refer to one another, packed or plain, and bytes that are elsewhere."""

import zipfile

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as some

from colonnade.errors import ReadError
from colonnade.readers.binary import diadem
from colonnade.readers.binary.diadem import Described, described_channels
from colonnade.readers.binary.numbers import StoredNumbers
from colonnade.readers.registry import read, read_here
from every import every

HEADER = """<?xml version="1.0"?>
<usi:tdm xmlns:usi="x">
  <usi:include><file byteOrder="littleEndian" url="a.tdx">
    <block id="inc0" byteOffset="16" length="10" valueType="eInt16Usi" {block}/>
  </file></usi:include>
  <usi:data>
    <tdm_channel id="usi1"><name>top</name><unit_string>mm</unit_string>
      <local_columns>#xpointer(id("usi2"))</local_columns>
      <instance_attributes><double_attribute name="wf_increment">0.01</double_attribute></instance_attributes>
    </tdm_channel>
    <localcolumn id="usi2"><sequence_representation>{kind}</sequence_representation>
      <generation_parameters>{parameters}</generation_parameters>
      <submatrix>#xpointer(id("usi3"))</submatrix><values>#xpointer(id("usi4"))</values></localcolumn>
    <submatrix id="usi3"><number_of_rows>7</number_of_rows></submatrix>
    <short_sequence id="usi4"><values external="inc0"/></short_sequence>
  </usi:data>
</usi:tdm>"""


def header(path, kind="explicit_external", parameters="", block=""):
    path.write_text(HEADER.format(kind=kind, parameters=parameters, block=block), encoding="utf-8")
    return path


def test_a_channel_is_found_by_way_of_its_references(tmp_path):
    (stored,), warnings = described_channels(header(tmp_path / "a.tdm"))
    assert warnings == []
    assert stored == Described("mm", "a.tdx", StoredNumbers("top", "<i2", 16, 10, 2), step=0.01, begin=0.0)


@every(
    ("kind", "parameters", "expected"),
    [
        ("raw_linear_external", "1.5 0.25", (1.5, 0.25, "a.tdx", 10)),
        ("implicit_linear", "3 2", (3.0, 2.0, "", 7)),
        ("implicit_constant", "4", (4.0, 0.0, "", 7)),
    ],
)
def test_a_channel_is_scaled_or_made_up_as_its_column_says(tmp_path, kind, parameters, expected):
    (stored,), _ = described_channels(header(tmp_path / "a.tdm", kind, parameters))
    assert (stored.numbers.offset, stored.numbers.factor, stored.file, stored.numbers.count) == expected


@every(
    ("change", "told"),
    [(("usi2", "usi9"), "no column"), (('"inc0"/', '"inc9"/'), "inc9"), (("explicit_external", "odd"), '"odd"')],
)
def test_a_channel_that_cannot_be_found_says_why(tmp_path, change, told):
    path = header(tmp_path / "a.tdm")
    path.write_text(path.read_text(encoding="utf-8").replace(change[0], change[1], 1), encoding="utf-8")
    stored, (warning,) = described_channels(path)
    assert stored == []
    assert told in warning


def test_a_packed_header_is_read_and_a_damaged_one_refused(tmp_path):
    plain, packed = header(tmp_path / "plain.tdm"), tmp_path / "packed.tdm"
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.write(plain, "header.xml")
    assert described_channels(packed) == described_channels(plain)
    content = packed.read_bytes()
    packed.write_bytes(content.replace(content[60:70], bytes(10), 1))
    with pytest.raises(ReadError, match=r"packed.tdm: .*(damaged|is not complete XML)"):
        described_channels(packed)


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=40, deadline=None)
@given(place=some.integers(0, 1200), wrong=some.binary(max_size=8))
def test_a_header_with_other_bytes_in_it_is_refused_or_describes_channels(tmp_path, place, wrong):
    path = header(tmp_path / "a.tdm")
    content = path.read_bytes()
    path.write_bytes(content[:place] + wrong + content[place + len(wrong) :])
    try:
        channels, _ = described_channels(path)
    except ReadError as error:
        assert "a.tdm" in str(error)  # noqa: PT017 - either outcome is right
        return
    assert all(channel.numbers.count >= 0 for channel in channels)


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


def tdm(tmp_path, *, packed=False, order="littleEndian", rows=3, url="r.tdx"):
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


@every("packed", [False, True])
@every("order", ["littleEndian", "bigEndian"])
def test_a_tdm_header_tells_scaling_interleaving_and_clock(tmp_path, packed, order):
    recording = read(tdm(tmp_path, packed=packed, order=order))
    top = recording.channel("top")
    assert (top.values.tolist(), top.unit) == ([10, 10.5, 9, 60], "mm")
    assert top.time is not None
    np.testing.assert_allclose(top.time, [-0.01, -0.005, 0, 0.005])
    assert recording.channel("table").values.tolist() == [0.5, 1.5, 2.5]
    assert recording.channel("even").values.tolist() == [1, 3, 5]


def test_a_channel_that_is_not_stored_is_no_longer_than_those_that_are(tmp_path):
    assert read(tdm(tmp_path, rows=10**12)).channel("even").values.size == 4


def test_a_path_out_of_the_folder_is_not_followed(tmp_path):
    folder = tmp_path / "data"
    folder.mkdir()
    path = tdm(folder, url="../r.tdx")
    (folder / "r.tdx").rename(tmp_path / "r.tdx")
    with pytest.raises(ReadError, match=r'its values are in the file "r.tdx", which is not in its folder'):
        read(path)


def test_entities_and_bombs_are_not_unpacked(tmp_path, monkeypatch):
    path = tdm(tmp_path)
    path.write_text(path.read_text().replace("?><usi", '?><!DOCTYPE a [<!ENTITY b "c">]><usi'), encoding="utf-8")
    with pytest.raises(ReadError, match="its own entities"):
        read(path)
    monkeypatch.setattr(diadem, "LARGEST_HEADER", 1 << 16)
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("header.xml", bytes(1 << 17))
    with pytest.raises(ReadError, match="it is not unpacked"):
        read_here(path, "diadem", {}, None)


def test_values_that_are_cut_off_are_told(written):
    path = written("diadem")
    values = path.with_suffix(".tdx")
    values.write_bytes(values.read_bytes()[:-40])
    recording = read(path)
    assert recording.warnings == ('"table": record.tdx ends after 30 of its 40 values',)


def test_a_file_of_values_without_bytes_has_none(written):
    path = written("diadem")
    path.with_suffix(".tdx").write_bytes(b"")
    with pytest.raises(ReadError, match=r'"table": record.tdx ends after 0 of its 40 values'):
        read(path)
