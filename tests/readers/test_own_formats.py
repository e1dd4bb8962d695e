"""What every format that is read here holds to: what was written comes back, and damage is told."""

import random

import numpy as np

from colonnade.errors import ReadError
from colonnade.readers.registry import formats, read
from damage import KINDS, damaged
from every import every

OWN = ("catman", "cosmos", "diadem", "famos", "lvm", "mts", "peer", "uff")
BY_PACKAGES = ("waveform",)
TIMES = 40 * np.arange(40) / 200


@every("name", OWN + BY_PACKAGES)
def test_what_was_written_is_recognised_and_read_back(written, name):
    recording = read(written(name))
    assert recording.format == name
    assert recording.warnings == ()
    expected = 0.3 * np.cos(0.75 * TIMES)
    last = recording.channels[-1]
    np.testing.assert_allclose(last.values, expected, atol=6e-6)
    assert last.time is not None
    np.testing.assert_allclose(last.time, TIMES / 40, atol=1e-8)
    if name not in ("cosmos", "peer"):  # these hold accelerations only
        top = recording.channels[-2]
        np.testing.assert_allclose(top.values, 10 * np.sin(TIMES), atol=6e-6)
        assert top.unit == (None if name == "waveform" else "mm")


@every("name", OWN + BY_PACKAGES)
def test_a_format_refuses_the_files_of_all_others(written, name):
    path = written(name)
    took = [other for other, format in formats().items() if format.recognise(path).yes and other != "delimited"]
    assert took == [name]


def read_or_refusal(name, path):
    """Read without the registry's guard, which would hide an exception of the reader's own."""
    try:
        return formats()[name].read(path, formats()[name].options())
    except ReadError as error:
        return error


@every("name", OWN)
@every("kind", KINDS)
def test_a_damaged_file_is_read_or_refused_by_its_format(written, name, kind):
    path = written(name)
    content = path.read_bytes()
    recordings = 0
    for seed in range(20):
        path.write_bytes(damaged(content, kind, random.Random(f"{name} {kind} {seed}")))
        outcome = read_or_refusal(name, path)
        if isinstance(outcome, ReadError):
            assert path.name in str(outcome)
            continue
        recordings += 1
        for channel in outcome.channels:
            assert not np.isinf(channel.values).any()
            assert channel.values.size < 100_000
    assert recordings > 0 or kind == "noise" or name == "diadem"  # XML is whole or none


@every("name", OWN)
@every("share", [0.6, 0.9])
def test_a_file_that_was_cut_off_says_so(written, name, share):
    path = written(name)
    cut = path.with_suffix(".tdx") if name == "diadem" else path
    cut.write_bytes(cut.read_bytes()[: int(share * cut.stat().st_size)])
    try:
        told = " ".join(read(path).warnings)
    except ReadError as error:
        told = str(error)
    assert any(words in told for words in ("end", "cut off", "too few cells")), told or "nothing was told"


@every("name", OWN)
def test_the_bytes_of_a_file_decide_not_its_name(written, name):
    path = written(name)
    renamed = path.rename(path.with_name("record.csv"))
    assert read(renamed).format == name
