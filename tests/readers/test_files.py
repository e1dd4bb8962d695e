"""What a path leads to, what it hashes to, and what is said of one that cannot be opened."""

import errno
import os
from pathlib import Path

import pytest

from colonnade.errors import ReadError
from colonnade.readers.files import in_one_line, irregular, refusing, sha256_of
from every import every


def test_the_hash_is_that_of_the_content(tmp_path):
    (tmp_path / "a.csv").write_bytes(b"abc")
    # The SHA-256 of "abc": FIPS 180-2, B.1.
    expected = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"
    assert sha256_of(tmp_path / "a.csv") == expected

    assert irregular(tmp_path / "a.csv") == ""


@every(("name", "what"), [(".", "a folder"), ("pipe", "a named pipe"), (os.devnull, "a device"), ("missing.csv", "")])
def test_what_is_no_file_is_named_and_has_no_hash(tmp_path, name, what):
    if name == "pipe" and not hasattr(os, "mkfifo"):
        pytest.skip("this system has no named pipes")
    if name == "pipe":
        os.mkfifo(tmp_path / name)  # opening it would wait for a writer for ever
    assert irregular(tmp_path / name) == what
    assert sha256_of(tmp_path / name) is None


PATH = Path("raw/free-01.tdms")


@every(
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
)
def test_what_a_parser_raises_becomes_a_message_of_what_to_do(error, told):
    with pytest.raises(ReadError) as refused, refusing(PATH, '"tdms"'):
        raise error
    assert str(refused.value).startswith("free-01.tdms: ")
    assert told in str(refused.value)
    of_the_machine = isinstance(error, OSError) and error.errno not in (None, errno.EINVAL)
    assert isinstance(refused.value.__cause__, OSError) == of_the_machine  # such a file is tried again


@every("error", [ReadError("a.csv: no"), MemoryError(), KeyboardInterrupt()])
def test_a_refusal_and_what_is_not_the_files_fault_pass(error):
    with pytest.raises(type(error)) as raised, refusing(PATH, "SAC"):
        raise error
    assert raised.value is error


def test_a_long_message_is_cut():
    assert len(in_one_line(ValueError("x" * 5000))) < 250
