"""The chain of segments of a TDMS file, wherever it ends."""

from __future__ import annotations

import struct
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as some
from nptdms import ChannelObject, TdmsFile, TdmsWriter

from colonnade.errors import ReadError
from colonnade.readers.tdms.segments import UNFINISHED, Ending, missing_samples, walk

SEGMENTS = 3


@pytest.fixture
def path(tmp_path: Path) -> Path:
    path = tmp_path / "a.tdms"
    with TdmsWriter(path) as writer:
        for number in range(SEGMENTS):
            writer.write_segment(
                [ChannelObject("g", "a", np.arange(10.0) + number), ChannelObject("g", "b", [1.0] * 10)]
            )
    return path


def test_a_whole_file_ends_where_its_segments_do(path: Path) -> None:
    size = path.stat().st_size
    assert walk(path) == Ending(size, size)
    assert missing_samples(walk(path), TdmsFile.read(path)) == []


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=60, deadline=None)
@given(share=some.floats(0, 1, exclude_max=True))
def test_a_file_that_was_cut_off_lacks_what_is_behind_the_cut(path: Path, share: float) -> None:
    content = path.read_bytes()
    cut = path.with_name("cut.tdms")
    cut.write_bytes(content[: int(share * len(content))])
    ending = walk(cut)
    assert ending.size == cut.stat().st_size
    if ending.declared is None:
        assert 0 < ending.undescribed <= 28
    elif ending.undescribed:
        assert ending.declared > ending.size
    else:
        assert ending.declared >= ending.size
        assert ending.present <= ending.expected
        assert ending.declared - ending.size == ending.expected - ending.present


def test_what_is_missing_is_counted_by_channels(path: Path) -> None:
    whole = path.stat().st_size
    path.write_bytes(path.read_bytes()[:-40])
    (told,) = missing_samples(walk(path), TdmsFile.read(path))
    assert told.startswith(f"it ends after {whole - 40} of {whole} bytes: a recording or a copy was interrupted")
    assert 'of 30 samples of "' in told


def test_a_segment_that_the_recorder_did_not_finish_is_told(path: Path) -> None:
    content = bytearray(path.read_bytes())
    last = content.rfind(b"TDSm")
    struct.pack_into("<Q", content, last + 12, UNFINISHED)
    path.write_bytes(content)
    ending = walk(path)
    assert ending.declared is None
    assert missing_samples(ending, TdmsFile.read(path))[0].startswith("the recorder did not finish the last segment")


def test_a_segment_that_does_not_start_where_it_should_is_damage(path: Path) -> None:
    content = path.read_bytes()
    second = content.find(b"TDSm", 4)
    path.write_bytes(content[:second] + b"????" + content[second + 4 :])
    with pytest.raises(ReadError, match=rf"a.tdms: at byte {second} of {len(content)} .* b'\?\?\?\?' was found"):
        walk(path)
