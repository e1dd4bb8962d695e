"""What is said between the two processes comes through whole, and what is no answer is refused."""

from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path
from tempfile import TemporaryFile

import numpy as np
import pytest

from colonnade.readers.bounded import messages
from colonnade.readers.recording import RecordedChannel, Recording
from every import every


@every(
    "answer",
    [
        b"",
        b"{}",
        b"[]\n",
        b'{"arrays": [{"dtype": "<f8", "shape": [-1]}]}\n',
        b'{"arrays": [{"dtype": "O", "shape": [1]}]}\n12345678',
        b'{"arrays": [{"dtype": "<f8", "shape": [1000000]}]}\n',
        b'{"arrays": [{"dtype": "<f8", "shape": [1000000, 1000000, 1000000]}]}\n',
        b'{"arrays": [{"dtype": "<f8", "shape": [2]}]}\n12345678',
        b'{"surprise": 1}\n',
        b"\x80\x04\x95\n",
    ],
)
def test_an_answer_that_is_none_is_refused(path, answer):
    path.write_bytes(answer)
    with path.open("rb") as stream, pytest.raises(messages.BrokenAnswerError):
        messages.receive(stream, 1000)


HEADER = {"format": "odd", "start": None, "notes": [], "warnings": [], "left_out": []}
COLUMN = ["a", None, "a", False, 0, 1]


@every(
    ("header", "arrays"),
    [
        ({**HEADER, "columns": [COLUMN]}, [np.zeros(2)]),
        ({**HEADER, "columns": [COLUMN]}, [np.zeros(2), np.zeros(3)]),
        ({**HEADER, "columns": [COLUMN]}, [np.zeros((2, 1)), np.zeros((2, 1))]),
        ({**HEADER, "columns": [COLUMN]}, [np.zeros(2, dtype=np.uint8)] * 2),
        ({**HEADER, "columns": [[1, *COLUMN[1:]]]}, [np.zeros(2)] * 2),
        (HEADER, []),
        (None, []),
    ],
)
def test_a_recording_whose_parts_do_not_fit_is_refused(header, arrays):
    with pytest.raises(ValueError, match=r"\w"):
        messages.recording_of(Path("r"), header, arrays)


def test_all_that_a_recording_holds_comes_through():
    values, time = np.arange(3.0), np.arange(3) / 7
    channels = (
        RecordedChannel("t", "s", time, time, "t [s]", is_clock=True),
        RecordedChannel("top", None, np.array([1.0, np.nan, -0.0]), time),
        RecordedChannel("none", "mm", np.empty(0), None),
        RecordedChannel("\udcff", "µm", values, time),
    )
    start = datetime(2013, 4, 26, 10, 15, 0, 250000, UTC)
    whole = Recording(Path("r"), "odd", channels, start, ("a",), ("b",))
    with TemporaryFile() as stream:
        header, arrays = messages.told(whole)
        messages.send(stream, arrays, header=header)
        stream.seek(0)
        answer, received = messages.receive(stream, 1000)
    back = messages.recording_of(Path("r"), answer.header, received)
    assert replace(back, channels=()) == replace(whole, channels=())
    for read, sent in zip(back.channels[:3], channels[:3], strict=True):
        np.testing.assert_array_equal(read.values, sent.values)
        told = [(each.name, each.unit, each.heading, each.is_clock) for each in (read, sent)]
        assert told[0] == told[1]
    assert back.channels[0].time is back.channels[1].time  # sent once
    assert back.channels[3].name == "?"
