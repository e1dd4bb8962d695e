"""A damaged file gives a recording or a message that names it, never anything else."""

import random
from collections import Counter

import numpy as np

from colonnade.errors import ReadError
from colonnade.readers.recording import Recording
from colonnade.readers.registry import read
from damage import KINDS, damaged
from every import every

ROWS = 200
SEEDS = 12


def undamaged(separator, decimal, encoding):
    lines = [separator.join(["Time [s]", "LVDT 1 [mm]", "ACC [g]"])]
    for row in range(ROWS):
        numbers = [f"{row * 0.005:.3f}", f"{10 * np.sin(row / 9):.4f}", f"{np.cos(row / 5):.5f}"]
        lines.append(separator.join(number.replace(".", decimal) for number in numbers))
    return ("\r\n".join(lines) + "\r\n").encode(encoding)


def read_or_refusal(path):
    try:
        return read(path)
    except ReadError as error:
        return error


@every(("separator", "decimal", "encoding"), [(";", ",", "latin-1"), (",", ".", "utf-16"), ("\t", ".", "utf-8")])
@every("kind", KINDS)
def test_a_damaged_file_is_read_or_refused(tmp_path, kind, separator, decimal, encoding):
    content = undamaged(separator, decimal, encoding)
    path = tmp_path / "damaged.csv"
    seen = Counter()
    for seed in range(SEEDS):
        path.write_bytes(damaged(content, kind, random.Random(f"{kind} {encoding} {seed}")))
        outcome = read_or_refusal(path)
        if isinstance(outcome, ReadError):
            assert "damaged.csv" in str(outcome)
            seen["refused"] += 1
            continue
        recording = outcome
        assert isinstance(recording, Recording)
        assert len({channel.values.size for channel in recording.channels}) == 1
        assert not any(np.isinf(channel.values).any() for channel in recording.channels)
        seen["warned" if recording.warnings else "read"] += 1
    assert sum(seen.values()) == SEEDS
    assert seen["refused"] == SEEDS if kind == "noise" else seen["refused"] < SEEDS


@every("removed", ["0,5000", ";", ";0,5000", "0,5000;"])
def test_a_lost_cell_or_delimiter_never_moves_values_to_another_column(tmp_path, removed):
    rows = [f"{row};0,5000;{row + 100}" for row in range(50)]
    rows[20] = rows[20].replace(removed, "", 1)
    path = tmp_path / "record.csv"
    path.write_text("n;a;b\n" + "\n".join(rows) + "\n")
    recording = read(path)
    others = np.arange(50) != 20
    for name, expected in (("a", np.full(50, 0.5)), ("b", np.arange(50) + 100.0)):
        values = recording.channel(name).values
        np.testing.assert_array_equal(values[others], expected[others])
        assert np.isnan(values[20]) or values[20] == expected[20]
    assert "line 22" in " ".join(recording.warnings)
