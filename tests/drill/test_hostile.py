"""Hostile files, one a library, and damaged copies: nothing runs, nothing outside is read, each comes to an end."""

import os
import random
import time
from collections import Counter

import numpy as np
import pytest

import hostile
from colonnade.errors import ReadError
from colonnade.readers.registry import read
from damage import KINDS, damaged

pytest.importorskip("xlwt")

COPIES = int(os.environ.get("DRILL_MUTATIONS", "500"))
SEED = os.environ.get("DRILL_SEED", "7")
LONGEST = 10.0
"""Seconds that any may take."""
SLOW = {"matlab_swelling"}
"""It takes all that a reader may: seconds."""


def files(folder, but):
    return {each: each.stat().st_mtime_ns for each in folder.rglob("*") if each.is_file() and each != but}


@pytest.mark.parametrize("copies", [0, pytest.param(COPIES, marks=pytest.mark.drill)])
@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=[pytest.mark.whole] * (name in SLOW)) for name in hostile.FILES]
)
def test_a_hostile_file_is_only_read(tmp_path, name, copies, capsys):
    hostile.secrets(tmp_path / "secrets")
    (tmp_path / "campaign").mkdir()
    place = hostile.Place(tmp_path / "campaign", tmp_path / "secrets", tmp_path / "made")
    path, format = hostile.FILES[name](place), "waveform" if name == "seismic_pickle" else None
    content, before, seen, slowest = path.read_bytes(), files(tmp_path, path), Counter(), 0.0
    for number in range(-1, copies):
        if number >= 0:
            kind = list(KINDS)[number % len(KINDS)]
            path.write_bytes(damaged(content, kind, random.Random(f"{SEED} {name} {number}")))
        began = time.monotonic()
        try:
            recording = read(path, format, within=place.folder)
        except ReadError as refusal:
            said = str(refusal)
            assert path.name in said
            seen[next((each for each in ("crashed", "stopped after", "MB of memory") if each in said), "refused")] += 1
        else:
            seen["read"] += 1
            secret = [*hostile.SECRET, *np.floor(hostile.SECRET)]
            assert not any(np.isin(channel.values, secret).any() for channel in recording.channels), number
            assert not any("31337" in text for text in (*recording.notes, *recording.warnings))
        if number >= 0:  # what is imported for the first file does not count
            slowest = max(slowest, time.monotonic() - began)
    if copies:
        with capsys.disabled():
            print(f"\n{name}: {dict(seen)}, the slowest in {slowest:.1f} s")
    assert not place.victim.exists()
    assert files(tmp_path, path) == before
    assert slowest < LONGEST
