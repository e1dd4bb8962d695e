"""
Read damaged copies of one file, in a process that may die of it.

`python read_damaged.py FILE FORMAT SEED FIRST COUNT`: for each a line "KIND NUMBER OUTCOME" on stdout, and before it
one "begin KIND NUMBER". The outcome is read, warned, refused, or caught where the registry made a refusal of a parser's
own exception; anything else is a finding. A read that takes longer than `LIMIT` ends the process with its stack on
stderr.
"""

import contextlib
import faulthandler
import random
import shutil
import sys
import tempfile
import warnings
from pathlib import Path

import numpy as np

from colonnade.errors import ReadError
from colonnade.readers.registry import read, read_here
from damage import KINDS, damaged

WITHOUT_LENGTH = ("delimited", "mts", "tdms")
"""Formats in which a file that ends between two rows or segments is whole as far as anyone can tell."""
LIMIT = 20.0
"""Seconds for one read."""
MEMORY = 4 << 30
"""Bytes that the process may take."""


def shortest(path, format):
    """Values of a file's shortest channel."""
    _, arrays = read_here(path, format, {}, None)
    return min(array.size for array in arrays)


def outcome(path, format, size, least):
    """Read a file; in one word what came of it. A channel with fewer values than `least` has to be told."""
    try:
        recording = read(path, format)  # in the bounded process, if the format is not plain text
    except ReadError as error:
        if path.name not in str(error) or len(str(error)) < 30:
            return f"finding: refused without its name or a reason: {error}"
        return "caught" if error.__cause__ is not None else "refused"
    except BaseException as error:
        return f"finding: {type(error).__name__}: {' '.join(str(error).split())[:200]}"
    values = [channel.values for channel in recording.channels]
    times = [channel.time for channel in recording.channels if channel.time is not None]
    if any(np.isinf(each).any() for each in (*values, *times)):
        return "finding: infinite values"
    if sum(each.size for each in values) > 100 * max(size, 10_000):
        return "finding: more values than the file can hold"
    if recording.warnings:
        return "warned"
    return "read" if all(each.size >= least for each in values) else "finding: cut off, and nothing is told"


def main(file, format, seed, first, count):
    """Damage and read."""
    with contextlib.suppress(ImportError):
        import resource

        resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    warnings.simplefilter("ignore")
    folder = Path(tempfile.mkdtemp())
    companions = [path for path in sorted(file.parent.iterdir()) if path != file]
    kinds, size, whole = list(KINDS), sum(path.stat().st_size for path in (file, *companions)), shortest(file, format)
    try:
        for number in range(first, count):
            kind, chance = kinds[number % len(kinds)], random.Random(f"{seed} {file.name} {file.parent.name} {number}")
            victim = chance.choice([file, *companions]) if number % 3 == 0 else file
            for path in (file, *companions):
                content = path.read_bytes()
                (folder / path.name).write_bytes(damaged(content, kind, chance) if path == victim else content)
            print("begin", kind, number, flush=True)
            faulthandler.dump_traceback_later(LIMIT, exit=True)
            least = whole if kind == "truncation" and format not in WITHOUT_LENGTH else 0
            said = outcome(folder / file.name, format, size, least)
            faulthandler.cancel_dump_traceback_later()
            print(kind, number, said, flush=True)
    finally:
        shutil.rmtree(folder)


if __name__ == "__main__":
    main(Path(sys.argv[1]), sys.argv[2], sys.argv[3], int(sys.argv[4]), int(sys.argv[5]))
