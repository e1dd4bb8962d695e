"""What every raw format says of itself."""

from dataclasses import FrozenInstanceError
from importlib.util import find_spec

import pytest
from pydantic import ValidationError

from colonnade.readers.format import Format, Options, Recognition
from colonnade.readers.recording import Recording
from colonnade.readers.registry import formats
from every import every

NAMES = tuple(formats())
RANDOM = bytes((37 * k * k + 11 * k) % 251 for k in range(4096))
"""Bytes of no format."""


class Spaced(Options):
    """Options of a format that adds one."""

    rows: int = 3


def made_up():
    """A format with only what each has to give."""

    def read(path, options):
        return Recording(path, "made-up", ())

    return Format("made-up", "A format of this test.", (".x",), lambda path: Recognition(False, "never"), read)


@every("options", [Options, Spaced])
def test_an_option_that_does_not_exist_is_refused(options):
    with pytest.raises(ValidationError, match="colour"):
        options(colour="red")


def test_an_option_is_checked_by_its_type_and_does_not_change():
    assert Spaced().rows == 3
    with pytest.raises(ValidationError, match="rows"):
        Spaced(rows="many")
    with pytest.raises(ValidationError, match="frozen"):
        Spaced(rows=4).rows = 5


def test_a_format_that_says_no_more_is_read_whole_alone_and_in_the_bounded_process():
    plain = made_up()
    assert plain.options is Options
    assert plain.read_window is None
    assert plain.companions is None
    assert not plain.in_process
    with pytest.raises(FrozenInstanceError):
        plain.in_process = True


def test_an_unrecognised_file_leaves_the_other_formats_their_turn():
    assert not Recognition(False, "no header").is_known


@every("name", NAMES)
def test_a_format_describes_itself_in_one_line_under_its_own_name(name):
    known = formats()[name]
    assert known.name == name
    assert known.summary.strip() == known.summary != ""
    assert "\n" not in known.summary
    assert all(suffix.startswith(".") and suffix == suffix.lower() for suffix in known.suffixes)


@every("name", NAMES)
def test_every_option_of_a_format_is_optional_and_no_other_is_known(name):
    options = formats()[name].options
    assert issubclass(options, Options)
    assert options() == options.model_validate({})
    with pytest.raises(ValidationError, match="no_such_option"):
        options.model_validate({"no_such_option": 1})


@every("name", NAMES)
def test_the_modules_that_a_format_loads_late_exist(name):
    assert [module for module in formats()[name].modules if find_spec(module) is None] == []


@every("content", [b"\0", RANDOM, b"PK\x03\x04", b"\x89HDF\r\n\x1a\n"])
@every("name", NAMES)
def test_a_format_gives_its_reason_for_a_file_of_whatever_it_is(tmp_path, name, content):
    path = tmp_path / "record.bin"
    path.write_bytes(content)
    found = formats()[name].recognise(path)
    assert found.reason.strip() == found.reason != ""
    assert not (found.yes and found.is_known)
    assert not (found.yes and content == RANDOM)
