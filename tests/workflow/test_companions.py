"""A raw file that is in two parts is hashed, up to date, and has its provenance, by both."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
import pytest

from colonnade.store import files

CHANNELS = (("time", "s"), ("top", "mm"), ("table", "m/s^2"))


def as_diadem(raw: Path) -> Path:
    """Write a raw file of text anew as a DIAdem header with its values beside it; these are returned."""
    rows = np.loadtxt(raw, delimiter=",", skiprows=1)
    values = raw.with_suffix(".tdx")
    blocks, data = "", ""
    for number, (name, unit) in enumerate(CHANNELS):
        blocks += f'<block byteOffset="{4 * number * len(rows)}" id="i{number}" length="{len(rows)}" '
        blocks += 'valueType="eFloat32Usi"/>'
        data += f'<tdm_channel id="c{number}"><name>{name}</name><unit_string>{unit}</unit_string>'
        data += f'<local_columns>id("l{number}")</local_columns></tdm_channel>'
        data += f'<localcolumn id="l{number}"><values>id("s{number}")</values></localcolumn>'
        data += f'<float_sequence id="s{number}"><values external="i{number}"/></float_sequence>'
    raw.write_text(
        '<?xml version="1.0"?><usi:tdm xmlns:usi="x"><usi:include>'
        f'<file byteOrder="littleEndian" url="{values.name}">{blocks}</file></usi:include>'
        f"<usi:data>{data}</usi:data></usi:tdm>",
        encoding="utf-8",
    )
    values.write_bytes(rows.T.astype("<f4").tobytes())
    return values


@pytest.fixture
def in_two_parts(untouched):
    """The small campaign with one test whose raw file is in two parts, once run up to ingest."""
    as_diadem(untouched.raw("pulse-01"))
    assert not untouched.run(only="pulse-01", until="ingest").failed
    return untouched


def values_of(campaign) -> Path:
    return campaign.raw("pulse-01").with_suffix(".tdx")


def alter(path: Path, *, keep_time: bool = False) -> None:
    status = path.stat()
    content = bytearray(path.read_bytes())
    content[-2] ^= 0x20
    path.write_bytes(content)
    if keep_time:
        os.utime(path, ns=(status.st_atime_ns, status.st_mtime_ns))


def test_both_parts_are_in_the_provenance(in_two_parts):
    attributes = files.read_attributes(in_two_parts.layout.stage("pulse-01", "ingest"))
    assert list(attributes["raw_files"]) == ["raw/pulse-01.csv", "raw/pulse-01.tdx"]
    assert all(len(digest) == 64 for digest in attributes["raw_sha256"])


def test_altered_values_are_ingested_again(in_two_parts):
    assert in_two_parts.redone(only="pulse-01", until="ingest") == {}
    alter(values_of(in_two_parts))
    assert in_two_parts.redone(only="pulse-01", until="ingest") == {("pulse-01", "ingest"): "raw file changed"}
    assert in_two_parts.redone(only="pulse-01", until="ingest") == {}


def test_values_that_change_or_go_while_they_are_read_are_told(in_two_parts, monkeypatch):
    from colonnade.workflow import steps

    ingest = steps._ingest
    for change in (alter, Path.unlink):
        with monkeypatch.context() as still:

            def still_copying(*arguments, change=change):
                result = ingest(*arguments)
                change(values_of(in_two_parts))
                return result

            still.setattr(steps, "_ingest", still_copying)
            result = in_two_parts.run(only="pulse-01", until="ingest", start_from="ingest")
        assert "raw/pulse-01.tdx: this file changed while it was being read" in result.stages[0].reason


def test_missing_values_are_named_and_taken_up_once_they_are_there(in_two_parts):
    values = values_of(in_two_parts)
    away = values.rename(values.with_name("away"))
    (failed,) = in_two_parts.run(only="pulse-01", until="ingest").stages
    assert 'its values are in the file "pulse-01.tdx", which is not in its folder' in failed.reason
    away.rename(values)
    assert not in_two_parts.run(only="pulse-01", until="ingest").failed


def test_values_that_are_a_link_out_of_the_campaign_are_refused_and_not_hashed(in_two_parts, tmp_path):
    values = values_of(in_two_parts)
    outside = values.rename(tmp_path / "outside")
    values.symlink_to(outside)
    (failed,) = in_two_parts.run(only="pulse-01", until="ingest").stages
    assert "its values are in pulse-01.tdx, which is a link to" in failed.reason
    attributes = files.read_attributes(in_two_parts.layout.stage("pulse-01", "ingest"))
    assert not attributes["raw_sha256"][1]
    values.unlink()
    outside.rename(values)
    assert not in_two_parts.run(only="pulse-01", until="ingest").failed
