"""What every format that is read here holds to: what was written comes back, and damage is told."""

import random
import re
from collections import Counter

import numpy as np
import pytest

from colonnade.errors import ReadError
from colonnade.readers.registry import formats, read
from damage import KINDS, damaged
from every import every
from raw_files import WRITERS
from whole_files import WHOLE, format_of, write

OWN = [*WRITERS.keys() - {"waveform"}, "delimited"]
OWN_PARSERS = {*OWN} - {"diadem", "catman", "c3d"}
"""Libraries take apart the XML of DIAdem, numbers of catman's headers and C3D."""
PACKED = ["c3d", "tdms", "matlab 5 plain", "matlab 5 compressed", "matlab 7.3", "netcdf 4", "netcdf 3", "excel xls"]
TIMES = 40 * np.arange(40) / 200


@every("name", WRITERS)
def test_what_was_written_is_recognised_and_read_back(written, name):
    recording = read(written(name))
    assert recording.format == name
    assert recording.warnings == ()
    last = recording.channels[-1]
    np.testing.assert_allclose(last.values, 0.3 * np.cos(0.75 * TIMES), atol=6e-6)
    np.testing.assert_allclose(last.time, TIMES / 40, atol=1e-8)
    if name not in ("cosmos", "peer"):  # these hold accelerations only
        top = recording.channels[-2]
        np.testing.assert_allclose(top.values, 10 * np.sin(TIMES), atol=6e-6)
        assert top.unit == (None if name == "waveform" else "mm")


@every("name", WRITERS)
def test_a_format_refuses_the_files_of_all_others_whatever_their_names(written, name):
    path = written(name)
    took = [other for other, format in formats().items() if format.recognise(path).yes and other != "delimited"]
    assert took == [name]
    if name in OWN:
        assert read(path.rename(path.with_name("record.csv"))).format == name


def read_or_refusal(name, path):
    """Read; by our own parsers without the registry's guard, which would hide an exception of theirs."""
    format = formats()[format_of(name)]
    try:
        return format.read(path, format.options()) if format.name in OWN_PARSERS else read(path)
    except ReadError as refusal:
        assert path.name in str(refusal)  # noqa: PT017 - either outcome is right
        return None


def samples_of(recording):
    return sum(channel.values.size for channel in recording.channels)


@pytest.mark.whole
@pytest.mark.parametrize("name", WHOLE)
def test_a_damaged_file_is_read_or_refused(tmp_path, name):
    path = write(name, tmp_path)
    content, samples = path.read_bytes(), samples_of(read(path))
    seeds = 20 if format_of(name) in OWN else 3 if name in PACKED else 5
    seen = Counter()
    for kind in KINDS:
        for seed in range(seeds):
            path.write_bytes(damaged(content, kind, random.Random(f"{name} {kind} {seed}")))
            recording = read_or_refusal(name, path)
            if recording is None:
                continue
            seen[kind] += 1
            assert recording.channels or format_of(name) in OWN
            assert not any(np.isinf(channel.values).any() for channel in recording.channels)
            assert samples_of(recording) <= 10 * max(samples, len(content))
    if format_of(name) in {*OWN} - {"diadem"}:  # of others, much damage leaves nothing
        assert seen.keys() >= KINDS.keys() - {"noise"}
    else:
        assert 0 < seen.total() < seeds * len(KINDS)


@pytest.mark.whole
@every("name", PACKED)
def test_a_file_that_ends_anywhere_is_refused_or_warned_of(tmp_path, name):
    path = write(name, tmp_path)
    content, whole = path.read_bytes(), samples_of(read(path))
    for length in range(0, len(content), max(len(content) // 25, 1)):
        path.write_bytes(content[:length])
        recording = read_or_refusal(name, path)
        complete = recording is None or samples_of(recording) == whole
        assert complete or recording.warnings, f"{length} of {len(content)} bytes"


@every("name", WRITERS.keys() - {"waveform"})
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


@every(("name", "cut"), [("catman", 40), ("famos", 41), ("diadem", 40)])
def test_values_that_are_not_there_are_counted(written, name, cut):
    path = written(name)
    stored = path.with_suffix(".tdx") if name == "diadem" else path
    stored.write_bytes(stored.read_bytes()[:-cut])
    recording = read(path)
    assert recording.channel("table").values.size == 30
    assert re.search(r'"table": (the file|record.tdx) ends after 30 of its 40 values', " ".join(recording.warnings))
