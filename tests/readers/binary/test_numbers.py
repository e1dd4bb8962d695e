"""Numbers as values: vectors in structs and groups; at a place in a file, scaled, with gaps between them, cut off."""

from dataclasses import replace
from pathlib import Path

import numpy as np
from hypothesis import given
from hypothesis import strategies as some
from hypothesis.extra.numpy import arrays

from colonnade.readers.binary.numbers import StoredNumbers, as_values, recorded, values_at
from colonnade.readers.recording import RecordedChannel
from every import every

COLUMNS = [
    RecordedChannel("", None, np.arange(4) * 5, heading="run.t"),
    RecordedChannel("", None, np.array([0.0, np.inf, 2.0, 3.0]), heading="run.top"),
    RecordedChannel("", None, np.arange(3.0), heading="other.top"),
]


def test_a_channel_has_the_last_part_of_its_path_for_a_name_if_that_is_clear_and_infinite_values_are_missing():
    recording = recorded(Path("a.mat"), "matlab", COLUMNS)
    assert [channel.name for channel in recording.channels] == ["t", "run.top", "other.top"]
    assert [channel.heading for channel in recording.channels] == ["run.t", "run.top", "other.top"]
    assert recording.warnings == ("run.top: 1 value is infinite, the first at sample 2: taken as missing",)
    np.testing.assert_array_equal(recording.channels[1].values, [0, np.nan, 2, 3])


@given(arrays(np.float64, some.integers(0, 50), elements=some.floats(allow_nan=True, allow_infinity=True)))
def test_only_infinities_are_changed_and_they_are_counted(numbers):
    values, warning = as_values(numbers)
    infinite = np.isinf(numbers)
    np.testing.assert_array_equal(values[~infinite], numbers[~infinite])
    assert np.isnan(values[infinite]).all()
    assert bool(warning) == bool(infinite.any())
    if warning:
        assert warning.startswith(f"{infinite.sum()} value")
        assert f"at sample {int(np.argmax(infinite)) + 1}:" in warning


@given(arrays(some.sampled_from([np.bool_, np.int8, np.uint64, np.float32]), some.integers(0, 20)))
def test_numbers_of_any_type_become_values(numbers):
    values, _ = as_values(numbers)
    assert values.dtype == np.float64
    assert values.shape == numbers.shape


CONTENT = np.frombuffer(np.arange(12, dtype="<i2").tobytes(), dtype=np.uint8)
EVERY_THIRD = StoredNumbers("top", "<i2", first=2, count=4, stride=6, offset=10.0, factor=0.5)


def test_numbers_are_taken_at_their_stride_and_scaled():
    values, warnings = values_at(CONTENT, EVERY_THIRD)
    assert values.tolist() == [10.5, 12.0, 13.5, 15.0]
    assert warnings == []


@every(("change", "there"), [({"count": 9}, 4), ({"end": 10}, 2), ({"first": 400}, 0), ({"first": -2}, 0)])
def test_numbers_that_are_not_there_are_told(change, there):
    values, warnings = values_at(CONTENT, replace(EVERY_THIRD, **change))
    assert values.size == there
    assert warnings == [f'"top": the file ends after {there} of its {change.get("count", 4)} values']
