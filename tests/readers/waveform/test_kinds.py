"""The kind of a seismic file, by its first bytes."""

from __future__ import annotations

import struct
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as some

from colonnade.readers.waveform.kinds import RECOGNISED, kind_of_waveform


def mini_seed(year: int = 2013, order: str = ">", quality: bytes = b"D") -> bytes:
    return b"000001" + quality + b" " + b"TABLE  ACC  " + struct.pack(order + "H", year) + bytes(40)


def sac(order: str = "<", version: int = 6, step: float = 0.01, points: int = 100) -> bytes:
    head = bytearray(632)
    struct.pack_into(order + "f", head, 0, step)
    struct.pack_into(order + "i", head, 304, version)
    struct.pack_into(order + "i", head, 316, points)
    return bytes(head)


def kinemetrics(length: int = 2040) -> bytes:
    return b"K\x01\x00\x00" + struct.pack(">LH", 1, length) + bytes(20)


@pytest.mark.parametrize(
    ("head", "kind"),
    [
        (b"Origin Time       2011/01/24 19:51:00", "KNET"),
        (b"WID2 1996/10/13", "GSE2"),
        (b"\x55\x3a" + bytes(30), "SEG2"),
        (b"TIMESERIES XX_TEST, 50 samples, 1 sps, SLIST, FLOAT", "SLIST"),
        (b"TIMESERIES XX_TEST, 50 samples, 1 sps, TSPAIR, FLOAT", "TSPAIR"),
        (b"RIFF\x00\x00\x00\x00WAVEfmt ", "WAV"),
        (mini_seed(), "MSEED"),
        (mini_seed(order="<"), "MSEED"),
        (mini_seed(year=1), None),
        (mini_seed(quality=b"X"), None),
        (b"000001V 010" + bytes(60), "MSEED"),
        (kinemetrics(), "KINEMETRICS_EVT"),
        (kinemetrics(9), None),
        (sac(), "SAC"),
        (sac(">", 7), "SAC"),
        (sac(step=-1.0), None),
        (sac(points=0), None),
        (sac()[:600], None),
        (b"time;top\n0;1\n", None),
        (b"", None),
    ],
    ids=lambda value: value if isinstance(value, str) else None,
)
def test_a_kind_is_told_by_the_first_bytes(tmp_path: Path, head: bytes, kind: str | None) -> None:
    path = tmp_path / "a"
    path.write_bytes(head)
    assert kind_of_waveform(path) == kind


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=80, deadline=None)
@given(some.binary(max_size=700))
def test_any_bytes_are_of_a_known_kind_or_of_none(tmp_path: Path, content: bytes) -> None:
    path = tmp_path / "a"
    path.write_bytes(content)
    assert kind_of_waveform(path) in RECOGNISED | {None}
