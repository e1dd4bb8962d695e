"""Five hundred damaged raw and campaign files, seeded: read, warned of or refused with a message, never a traceback."""

from collections import Counter

import numpy as np
import pytest

from colonnade import campaign as campaigns
from colonnade.errors import CampaignError, ColonnadeError
from colonnade.readers.registry import read
from colonnade.stages.ingest import IngestInputs, ingest

CAMPAIGN = """schema = 1
campaign = "damaged"
title = "Damaged"

[specimens]
prism = {shape = "prism", width = "86 mm", depth = "86 mm", height = "456 mm", mass = "26.10 kg"}

[setups.frame]
catch = "0.3 rad"

[setups.frame.channels.top]
column = "LVDT 1"
quantity = "displacement"
unit = "V"
gain = "10.02 mm/V"
offset = "-0.13 mm"
range = "10 V"
on = "specimen"
at = ["43 mm", "0 mm", "440 mm"]
direction = [1, 0, 0]
relative_to = "table"

[[tests]]
id = "free-01"
kind = "free-vibration"
specimen = "prism"
setup = "frame"
file = "free.csv"
"""


def _raw_text():
    time = np.arange(0, 2, 0.01)
    rows = "".join(f"{t:.2f};{5 * np.exp(-t) * np.sin(9 * t):.4f};{np.cos(t):.4f}\n".replace(".", ",") for t in time)
    return "Messung 12, Prüfstand\nZeit;LVDT 1;ACC\ns;V;g\n" + rows


def _flip(data, rng):
    for _ in range(int(rng.integers(1, 20))):
        data[int(rng.integers(len(data)))] = int(rng.integers(256))
    return data


def _cut(data, rng):
    return data[: int(rng.integers(len(data)))]


def _drop(data, rng):
    start = int(rng.integers(len(data)))
    del data[start : start + int(rng.integers(1, 400))]
    return data


def _repeat(data, rng):
    start = int(rng.integers(len(data)))
    return data[:start] + data[max(start - 300, 0) : start] * int(rng.integers(1, 4)) + data[start:]


def _insert(data, rng):
    words = (
        b"OVERFLOW",
        b"\x00\x00",
        b"NaN;;",
        b'"',
        b"1.234,5",
        b"\r\n\r\n",
        "µ°".encode(),
        b"=SUM(A1)",
        b"1e999",
        b"[[",
    )
    for _ in range(int(rng.integers(1, 8))):
        place = int(rng.integers(len(data)))
        data[place:place] = words[int(rng.integers(len(words)))]
    return data


def _shuffle_lines(data, rng):
    lines = bytes(data).splitlines(keepends=True)
    order = np.arange(len(lines))
    picked = rng.choice(order, size=min(8, order.size), replace=False)
    order[picked] = order[rng.permutation(picked)]
    return bytearray(b"".join(lines[index] for index in order))


KINDS = {
    "flipped": _flip,
    "cut": _cut,
    "dropped": _drop,
    "repeated": _repeat,
    "inserted": _insert,
    "shuffled": _shuffle_lines,
}


def _raw_file_outcome(path, campaign):
    """Read and ingest as a run does."""
    test = campaign.tests["free-01"]
    try:
        recording = read(path)
        recorded = ingest({"main": recording}, IngestInputs.of(campaign, test))
    except ColonnadeError as error:
        return "refused" if len(str(error)) > 20 else "refused without a word"
    return "warned" if recorded.attrs["warnings"] else "read"


def _campaign_file_outcome(path):
    try:
        campaign = campaigns.load(path)
    except CampaignError as error:
        return "refused" if path.name in str(error) else "refused without a place"
    return "warned" if campaign.warnings else "read"


@pytest.mark.parametrize("kind", KINDS)
def test_damaged_files_are_read_warned_of_or_refused(kind, tmp_path, capsys):
    rng = np.random.default_rng(list(KINDS).index(kind))
    sound = tmp_path / "campaign.toml"
    sound.write_text(CAMPAIGN, encoding="utf-8")
    campaign = campaigns.load(sound)
    counts = {"raw": Counter(), "campaign": Counter()}
    for number in range(42):
        raw = tmp_path / f"raw-{number}.csv"
        raw.write_bytes(KINDS[kind](bytearray(_raw_text().encode("latin-1")), rng))
        counts["raw"][_raw_file_outcome(raw, campaign)] += 1
        (tmp_path / str(number)).mkdir()
        damaged = tmp_path / str(number) / "campaign.toml"
        damaged.write_bytes(KINDS[kind](bytearray(CAMPAIGN.encode()), rng))
        counts["campaign"][_campaign_file_outcome(damaged)] += 1
    with capsys.disabled():
        print(f"\n{kind}: " + "; ".join(f"{what} {dict(sorted(each.items()))}" for what, each in counts.items()))
    assert counts["raw"].keys() | counts["campaign"].keys() <= {"read", "warned", "refused"}
    assert counts["raw"]["refused"] + counts["raw"]["warned"] > 0
    assert counts["campaign"]["refused"] > 0
