"""The ingest of long files beside a bare read of the same file in the same run (`make slow` prints the figures)."""

import hashlib
import time

import numpy as np
import pandas as pd
import pytest
from nptdms import ChannelObject, TdmsFile, TdmsWriter

from colonnade.campaign import load
from colonnade.readers.registry import read
from colonnade.stages.ingest import IngestInputs, ingest
from colonnade.store import files

MEGABYTES = 500
CHANNELS = 10
RATE = 1000.0
ONE_PIECE = 100_000
MOST = 2.0
"""Times what a bare read, the hash and the write of the result take together; the goal is 1.5."""

HEAD = """schema = 1
campaign = "long"
title = "A long file"

[specimens]
prism = {shape = "prism", width = "86 mm", depth = "86 mm", height = "456 mm", mass = "26.10 kg"}

[setups.frame]
[setups.frame.channels]
"""
CHANNEL = (
    'c{0} = {{column = "CH {0}", quantity = "displacement", unit = "mm", range = "20 mm", on = "specimen", '
    'at = ["43 mm", "0 mm", "{0}0 mm"], direction = [1, 0, 0], relative_to = "table"}}\n'
)
TEST = '\n[[tests]]\nid = "one"\nkind = "other"\nspecimen = "prism"\nsetup = "frame"\nfile = "{}"\n'


def piece(number):
    """Values of all channels over one piece: sines with noise, as a recorder with 16 bits writes them."""
    noise = np.random.default_rng(number).normal(0, 0.01, (ONE_PIECE, CHANNELS))
    at = (np.arange(ONE_PIECE) + number * ONE_PIECE)[:, None] / RATE
    return np.round((5 * np.sin(2 * np.pi * 0.3 * np.arange(1, CHANNELS + 1) * at) + noise) / 3e-4) * 3e-4


def write_text(path, megabytes):
    names = [f"CH {number} [mm]" for number in range(1, CHANNELS + 1)]
    with path.open("w", encoding="utf-8") as stream:
        stream.write(";".join(["Time [s]", *names]) + "\n")
        number = 0
        while path.stat().st_size < megabytes * 1e6:
            table = pd.DataFrame(piece(number))
            table.insert(0, "time", (np.arange(ONE_PIECE) + number * ONE_PIECE) / RATE)
            table.to_csv(stream, sep=";", float_format="%.6f", header=False, index=False)
            stream.flush()
            number += 1


def write_tdms(path, megabytes):
    with TdmsWriter(path) as writer:
        for number in range(int(megabytes * 1e6 / (8 * CHANNELS * ONE_PIECE))):
            values = piece(number)
            writer.write_segment(
                [
                    ChannelObject(
                        "frame", f"CH {k + 1}", values[:, k].copy(), {"wf_increment": 1 / RATE, "unit_string": "mm"}
                    )
                    for k in range(CHANNELS)
                ]
            )


def lasting(function, *arguments, **more):
    """What a call gives, and how long it lasts, s; a bounded process that reads for it counts."""
    began = time.perf_counter()
    return function(*arguments, **more), time.perf_counter() - began


def hashed(path):
    with path.open("rb") as stream:
        return hashlib.file_digest(stream, "sha256")


def bare_text(path):
    return pd.read_csv(path, sep=";")["CH 3 [mm]"].to_numpy()


def bare_tdms(path):
    file = TdmsFile.read(path)
    return np.asarray([channel[:] for channel in file["frame"].channels()][2])


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "write", "bare"),
    [
        pytest.param("long.csv", write_text, bare_text, id="text beside pandas"),
        pytest.param("long.tdms", write_tdms, bare_tdms, id="TDMS beside npTDMS"),
    ],
)
def test_ingest_beside_a_bare_read(tmp_path, name, write, bare):
    channels = "".join(CHANNEL.format(number) for number in range(1, CHANNELS + 1))
    (tmp_path / "campaign.toml").write_text(HEAD + channels + TEST.format(name), encoding="utf-8")
    campaign = load(tmp_path)
    told = IngestInputs.of(campaign, campaign.tests["one"])

    for megabytes in (10, MEGABYTES):  # what is imported with the first file does not count
        write(tmp_path / name, megabytes)
        expected, bare_read = lasting(bare, tmp_path / name)
        _, hash_time = lasting(hashed, tmp_path / name)
        recording, own_read = lasting(read, tmp_path / name)
        recorded, judged = lasting(ingest, {"main": recording}, told)
        _, stored = lasting(files.write, recorded, tmp_path / "recorded.nc", attributes={"stage": "ingest"})
        np.testing.assert_allclose(recorded["c3"].to_numpy(), expected * 1e-3, rtol=1e-12)
    ratio = (hash_time + own_read + judged + stored) / (bare_read + hash_time + stored)
    print(f"\n{name}: {expected.size} x {CHANNELS} samples; bare read {bare_read:.2f} s, hash {hash_time:.2f} s")
    print(f"  read {own_read:.2f} s, judged {judged:.2f} s, stored {stored:.2f} s: {ratio:.2f} times the least")
    assert ratio <= MOST
