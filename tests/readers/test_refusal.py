"""What is said of a file that cannot be opened, and of one that its parser stumbles over."""

from __future__ import annotations

import errno
import os
from pathlib import Path

import pytest

from colonnade.errors import ReadError
from colonnade.readers.refusal import in_one_line, refusing, unreachable

PATH = Path("raw/free-01.tdms")


@pytest.mark.parametrize(
    ("error", "told"),
    [
        (
            ValueError("half a\n block"),
            "(ValueError: half a block). The file is damaged, was cut off, or is of an unknown version",
        ),
        (KeyError(), "(KeyError). The file is damaged"),
        (OSError("no block"), "(OSError: no block). The file is damaged"),
        (OSError(errno.EINVAL, "Invalid argument"), "Invalid argument). The file is damaged"),
        (PermissionError(errno.EACCES, os.strerror(errno.EACCES)), "Check its permissions and that its disk is"),
        (FileNotFoundError(errno.ENOENT, "x"), "there is no such file"),
    ],
    ids=["a message", "none", "of the parser", "a place before the start", "of the machine", "missing"],
)
def test_what_a_parser_raises_becomes_a_message_of_what_to_do(error: Exception, told: str) -> None:
    with pytest.raises(ReadError) as refused, refusing(PATH, '"tdms"'):
        raise error
    assert str(refused.value).startswith("free-01.tdms: ")
    assert told in str(refused.value)
    of_the_machine = isinstance(error, OSError) and error.errno not in (None, errno.EINVAL)
    assert isinstance(refused.value.__cause__, OSError) == of_the_machine  # such a file is tried again


@pytest.mark.parametrize("error", [ReadError("a.csv: no"), MemoryError(), KeyboardInterrupt()], ids=repr)
def test_a_refusal_and_what_is_not_the_files_fault_pass(error: BaseException) -> None:
    with pytest.raises(type(error)) as raised, refusing(PATH, "SAC"):
        raise error
    assert raised.value is error


def test_a_long_message_is_cut() -> None:
    assert len(in_one_line(ValueError("x" * 5000))) < 250


def test_a_missing_file_is_told_with_the_nearest_name(tmp_path: Path) -> None:
    (tmp_path / "free-01.csv").touch()
    error = FileNotFoundError(errno.ENOENT, "x")
    assert 'Did you mean "free-01.csv"?' in unreachable(tmp_path / "free-10.csv", error)
    assert "as there is no folder" in unreachable(tmp_path / "raw" / "free-01.csv", error)
