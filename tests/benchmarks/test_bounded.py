"""What the bounded process costs for each small file after the first (`make slow` prints the figures)."""

import os
import subprocess
import sys
import time
from pathlib import Path

import pytest

from colonnade.readers.bounded import process
from colonnade.readers.registry import formats, read

TIMES = 10
EXAMPLES = Path(__file__).parents[2] / "raw_schema" / "examples"
BOUNDED = sorted(name for name, format in formats().items() if not format.in_process)
MOST = 6.0
"""Processor time of a file, as a multiple of that of starting a bare Python, which takes some 15 ms."""


def spent(pid):
    """Processor time of a process and of the copies that it has waited for, s."""
    fields = Path(f"/proc/{pid}/stat").read_text(encoding="ascii").rpartition(")")[2].split()
    return sum(map(int, fields[11:15])) / os.sysconf("SC_CLK_TCK")


def start_of_python():
    """Processor time of starting a bare Python, s."""
    before = os.times()
    for _ in range(TIMES):
        subprocess.run([sys.executable, "-I", "-S", "-c", ""], check=True)
    after = os.times()
    return (after.children_user + after.children_system - before.children_user - before.children_system) / TIMES


@pytest.mark.slow
@pytest.mark.skipif(sys.platform != "linux", reason="processor time of another process is taken from /proc")
@pytest.mark.parametrize("name", BOUNDED)
def test_a_file_after_the_first_costs_little_more_than_starting_python(name):
    path = next(path for path in sorted((EXAMPLES / name / "raw").iterdir()) if path.suffix != ".R32")
    process.end()
    began = time.process_time()
    read(path)
    server = process._readers[0].process.pid
    first = time.process_time() - began + spent(server)
    here, there = time.process_time(), spent(server)
    for _ in range(TIMES):
        read(path)
    each = (time.process_time() - here + spent(server) - there) / TIMES
    ratio = each / start_of_python()
    print(f"\n{name}: first {1e3 * first:.0f} ms, then {1e3 * each:.1f} ms each: {ratio:.2f} of starting Python")
    assert ratio < MOST
