"""The hash of a file, and what is never opened for it."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from colonnade.readers.hashing import sha256_of


def test_the_hash_is_that_of_the_content(tmp_path: Path) -> None:
    (tmp_path / "a.csv").write_bytes(b"abc")
    # The SHA-256 of "abc": FIPS 180-2, B.1.
    expected = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"
    assert sha256_of(tmp_path / "a.csv") == expected


def test_what_is_missing_or_no_file_has_none(tmp_path: Path) -> None:
    assert sha256_of(tmp_path / "missing.csv") is None
    assert sha256_of(tmp_path) is None


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="this system has no named pipes")
def test_a_pipe_is_not_opened(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe")  # opening it would wait for a writer for ever
    assert sha256_of(tmp_path / "pipe") is None
