"""Headers of DIAdem in XML: objects that refer to one another, packed or plain."""

from __future__ import annotations

import zipfile
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as some

from colonnade.errors import ReadError
from colonnade.readers.binary.stored_numbers import StoredNumbers
from colonnade.readers.diadem.tdm import channels_in_tdm

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


def written(path: Path, kind: str = "explicit_external", parameters: str = "", block: str = "") -> Path:
    path.write_text(HEADER.format(kind=kind, parameters=parameters, block=block), encoding="utf-8")
    return path


def test_a_channel_is_found_by_way_of_its_references(tmp_path: Path) -> None:
    ((name, place),), warnings = channels_in_tdm(written(tmp_path / "a.tdm"))
    assert (name, warnings) == ("top", [])
    assert place() == StoredNumbers("top", "mm", "a.tdx", "<i2", 16, 10, 2, step=0.01)


@pytest.mark.parametrize(
    ("kind", "parameters", "expected"),
    [
        ("raw_linear_external", "1.5 0.25", (1.5, 0.25, "a.tdx", 10)),
        ("implicit_linear", "3 2", (3.0, 2.0, "", 7)),
        ("implicit_constant", "4", (4.0, 0.0, "", 7)),
    ],
)
def test_a_channel_is_scaled_or_made_up_as_its_column_says(
    tmp_path: Path, kind: str, parameters: str, expected: tuple[float, float, str, int]
) -> None:
    ((_, place),), _ = channels_in_tdm(written(tmp_path / "a.tdm", kind, parameters))
    stored = place()
    assert (stored.offset, stored.factor, stored.file, stored.count) == expected


def test_numbers_in_blocks_have_a_stride(tmp_path: Path) -> None:
    ((_, place),), _ = channels_in_tdm(written(tmp_path / "a.tdm", block='blockSize="6" blockOffset="4"'))
    assert (place().first, place().stride) == (20, 6)


@pytest.mark.parametrize(
    ("change", "told"),
    [(("usi2", "usi9"), "no column"), (('"inc0"/', '"inc9"/'), "inc9"), (("explicit_external", "odd"), '"odd"')],
    ids=["reference", "block", "kind"],
)
def test_a_channel_that_cannot_be_found_says_why(tmp_path: Path, change: tuple[str, str], told: str) -> None:
    path = written(tmp_path / "a.tdm")
    path.write_text(path.read_text(encoding="utf-8").replace(change[0], change[1], 1), encoding="utf-8")
    ((_, place),), _ = channels_in_tdm(path)
    with pytest.raises((ValueError, KeyError), match=told):
        place()


def test_a_packed_header_is_read_and_a_damaged_one_refused(tmp_path: Path) -> None:
    plain, packed = written(tmp_path / "plain.tdm"), tmp_path / "packed.tdm"
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.write(plain, "header.xml")
    assert channels_in_tdm(packed)[0][0][1]() == channels_in_tdm(plain)[0][0][1]()
    content = packed.read_bytes()
    packed.write_bytes(content.replace(content[60:70], bytes(10), 1))
    with pytest.raises(ReadError, match=r"packed.tdm: .*(damaged|is not complete XML)"):
        channels_in_tdm(packed)


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=40, deadline=None)
@given(place=some.integers(0, 1200), wrong=some.binary(max_size=8))
def test_a_header_with_other_bytes_in_it_is_refused_or_describes_channels(
    tmp_path: Path, place: int, wrong: bytes
) -> None:
    path = written(tmp_path / "a.tdm")
    content = path.read_bytes()
    path.write_bytes(content[:place] + wrong + content[place + len(wrong) :])
    try:
        channels, _ = channels_in_tdm(path)
    except ReadError as error:
        assert "a.tdm" in str(error)  # noqa: PT017 - either outcome is right
        return
    for _, describe in channels:
        try:
            assert describe().count >= 0
        except (ValueError, KeyError, OverflowError):
            continue
