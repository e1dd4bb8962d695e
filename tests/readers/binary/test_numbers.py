"""Numbers as values: vectors in structs and groups; at a place in a file, scaled, with gaps between them, cut off."""

from pathlib import Path

import numpy as np
from hypothesis import given
from hypothesis import strategies as some
from hypothesis.extra.numpy import arrays

from colonnade.readers.binary.numbers import Told, numbers_at, recorded
from colonnade.readers.clock import ClockOptions
from colonnade.readers.recording import RecordedChannel
from every import every

COLUMNS = [
    RecordedChannel("", None, np.arange(4) * 5, heading="run.t"),
    RecordedChannel("", None, np.array([0.0, np.inf, 2.0, 3.0]), heading="run.top"),
    RecordedChannel("", None, np.arange(3.0), heading="other.top"),
]


def test_a_channel_has_the_last_part_of_its_path_for_a_name_if_that_is_clear_and_infinite_values_are_missing():
    recording = recorded(Path("a.mat"), "matlab", COLUMNS, Told(), ClockOptions())
    assert [channel.name for channel in recording.channels] == ["t", "run.top", "other.top"]
    assert [channel.heading for channel in recording.channels] == ["run.t", "run.top", "other.top"]
    np.testing.assert_array_equal(recording.channels[1].values, [0, np.nan, 2, 3])


NUMBERS = some.sampled_from([np.bool_, np.int8, np.uint64, np.float32, np.float64])


@given(arrays(NUMBERS, some.integers(0, 50)))
def test_numbers_of_any_type_are_values_and_only_infinities_are_changed(numbers):
    recording = recorded(Path("a.mat"), "matlab", [RecordedChannel("a", None, numbers)], Told(), ClockOptions())
    values, infinite = recording.channels[0].values, np.isinf(numbers)
    assert values.dtype == np.float64
    np.testing.assert_array_equal(values[~infinite], numbers[~infinite].astype(float))
    assert np.isnan(values[infinite]).all()


CONTENT = np.frombuffer(np.arange(12, dtype="<i2").tobytes(), dtype=np.uint8)
EVERY_THIRD = {"content": CONTENT, "form": "<i2", "first": 2, "count": 4, "stride": 6, "scale": (10.0, 0.5)}


@every(
    ("change", "there"),
    [({}, 4), ({"count": 9}, 4), ({"content": CONTENT[:10]}, 2), ({"first": 400}, 0), ({"first": -2}, 0)],
)
def test_numbers_are_taken_at_their_stride_and_scaled_and_those_that_are_not_there_are_told(change, there):
    warnings: list[str] = []
    values = numbers_at(name="top", warnings=warnings, **{**EVERY_THIRD, **change})
    assert values.tolist() == [10.5, 12.0, 13.5, 15.0][:there]
    wanted = change.get("count", 4)
    assert warnings == ([] if there == wanted else [f'"top": the file ends after {there} of its {wanted} values'])
