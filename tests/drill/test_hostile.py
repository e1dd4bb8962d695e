"""Five hundred damaged copies of each hostile file: nothing runs, nothing outside is read, and each comes to an end."""

import contextlib
import os
import random
import time
from collections import Counter

import numpy as np
import pytest

import damage
import hostile
from colonnade.errors import ReadError
from colonnade.readers.registry import read

pytestmark = pytest.mark.drill

MUTATIONS = int(os.environ.get("DRILL_MUTATIONS", "500"))
SEED = os.environ.get("DRILL_SEED", "7")
LONGEST = 10.0
"""Seconds that any may take."""


@pytest.mark.parametrize("name", list(hostile.FILES))
def test_damaged_hostile_files_are_only_read(tmp_path, name, capsys):
    hostile.secrets(tmp_path / "secrets")
    (tmp_path / "campaign").mkdir()
    place = hostile.Place(tmp_path / "campaign", tmp_path / "secrets", tmp_path / "made")
    path, format, options = hostile.FILES[name](place)
    content, kinds = path.read_bytes(), list(damage.KINDS)
    before = {each: each.stat().st_mtime_ns for each in tmp_path.rglob("*") if each.is_file() and each != path}
    secret = [*hostile.SECRET, *np.floor(hostile.SECRET)]
    with contextlib.suppress(ReadError):
        read(path, format, options, within=place.folder)  # what is imported for the first file does not count
    seen = Counter()
    slowest = 0.0
    for number in range(MUTATIONS):
        path.write_bytes(damage.damaged(content, kinds[number % len(kinds)], random.Random(f"{SEED} {name} {number}")))
        began = time.monotonic()
        try:
            recording = read(path, format, options, within=place.folder)
        except ReadError as refusal:
            said = str(refusal)
            what = next((each for each in ("crashed", "stopped after", "MB of memory") if each in said), "refused")
            seen[what] += 1
        else:
            seen["read"] += 1
            assert not any(np.isin(channel.values, secret).any() for channel in recording.channels), number
        slowest = max(slowest, time.monotonic() - began)
    after = {each: each.stat().st_mtime_ns for each in tmp_path.rglob("*") if each.is_file() and each != path}
    with capsys.disabled():
        print(f"\n{name}: {dict(seen)}, the slowest in {slowest:.1f} s")
    assert not place.victim.exists()
    assert after == before
    assert slowest < LONGEST
