"""Raw files of a small campaign in several formats, and the ways in which recorders put them into a folder."""

import time
from functools import cache

import scipy.io
from nptdms import ChannelObject, TdmsWriter

import short_campaign
from prism import PRISM

CAMPAIGN = f"""{short_campaign.CAMPAIGN}[watch]
words = {{free = "free-vibration"}}
pattern = ["{{kind}}-{{number}}.csv", "{{kind}}-{{number}}.txt", "{{kind}}-{{number}}.mat", "{{kind}}-{{number}}.tdms"]
"""
SUFFIXES = ("csv", "txt", "mat", "tdms")


@cache
def record(kind, number, rate, duration):
    """One of a few records, with noise."""
    moved = (
        {"theta0": (0.3 + 0.05 * number) * PRISM.critical_angle} if kind == "free" else {"pulse": 2.2 + 0.15 * number}
    )
    return short_campaign.record(number, rate=rate, duration=duration, **moved)


def content(columns, suffix, scratch):
    """Give the bytes of a file of this kind."""
    path = scratch / f"content.{suffix}"
    if suffix in ("csv", "txt"):
        short_campaign.write_columns(path, columns, "," if suffix == "csv" else "\t")
        if suffix == "txt":
            path.write_text(path.read_text().replace(".", ","))
    elif suffix == "mat":
        scipy.io.savemat(path, columns)
    else:
        with TdmsWriter(path) as writer:
            writer.write_segment([ChannelObject("record", name, values) for name, values in columns.items()])
    return path.read_bytes()


def whole(path, data, chance):
    """Write it at once."""
    path.write_bytes(data)


def slowly(path, data, chance):
    """Write it in pieces, with pauses shorter than it takes to settle, and now and then one that is longer."""
    cuts = sorted(chance.sample(range(1, len(data)), 8))
    with path.open("wb") as stream:
        for start, stop in zip([0, *cuts], [*cuts, len(data)], strict=True):
            if start:  # after its last piece a file is whole, and may be taken before it is closed
                time.sleep(chance.choice([0.1, 0.3, 0.6, 0.6, 2.5]))
            stream.write(data[start:stop])
            stream.flush()


def renamed(path, data, chance):
    """Write it under another name, then rename it."""
    partial = path.with_name(path.name + ".part")
    partial.write_bytes(data)
    time.sleep(chance.uniform(0.0, 2.0))
    partial.replace(path)


def rewritten(path, data, chance):
    """Write half of it, as if it were all, and later the whole."""
    path.write_bytes(data[: len(data) // 2])
    time.sleep(chance.uniform(2.0, 6.0))
    path.write_bytes(data)


WAYS = (whole, whole, slowly, renamed, rewritten)
