"""Linux's Landlock: after it a process reads some folders and does nothing else, whatever its code."""

import subprocess
import sys

import pytest

from colonnade.readers.bounded import landlock

with_landlock = pytest.mark.skipif(not landlock.version(), reason="this kernel has no Landlock")

RESTRICT = """
import ctypes, os, sys
from pathlib import Path
from colonnade.readers.bounded import landlock
folder = sys.argv[1].encode()
system = ctypes.CDLL(None)
assert landlock.restrict([Path(sys.argv[1]), Path(sys.argv[1]) / "missing"])
for path, flags in ((b"/inside", os.O_RDONLY), (b"/../outside", os.O_RDONLY), (b"/inside", os.O_WRONLY),
                    (b"/new", os.O_WRONLY | os.O_CREAT)):
    print(system.open(folder + path, flags, 0o600) >= 0)
print(system.open(os.devnull.encode(), os.O_WRONLY) >= 0)
"""


@with_landlock
def test_native_code_reads_inside_and_nothing_else(tmp_path):
    (tmp_path / "campaign").mkdir()
    (tmp_path / "campaign" / "inside").write_text("inside")
    (tmp_path / "outside").write_text("outside")
    told = subprocess.run(
        [sys.executable, "-c", RESTRICT, str(tmp_path / "campaign")], capture_output=True, text=True, check=True
    )
    assert told.stdout.split() == ["True", "False", "False", "False", "True"]
    assert not (tmp_path / "campaign" / "new").exists()


def test_a_kernel_without_it_restricts_nothing_and_says_so(monkeypatch, tmp_path):
    monkeypatch.setattr(sys, "platform", "darwin")
    assert landlock.version() == 0
    assert not landlock.restrict([tmp_path])
