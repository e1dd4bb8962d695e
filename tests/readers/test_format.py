"""What every raw format says of itself."""

from importlib.util import find_spec

import pytest
from pydantic import ValidationError

from colonnade.readers.format import Options
from colonnade.readers.registry import formats
from every import every

NAMES = tuple(formats())
RANDOM = bytes((37 * k * k + 11 * k) % 251 for k in range(4096))
"""Bytes of no format."""


@every("name", NAMES)
def test_a_format_describes_itself_in_one_line_under_its_own_name(name):
    known = formats()[name]
    assert known.name == name
    assert known.summary.strip() == known.summary != ""
    assert "\n" not in known.summary
    assert all(suffix.startswith(".") and suffix == suffix.lower() for suffix in known.suffixes)


@every("name", NAMES)
def test_every_option_of_a_format_is_optional_and_no_other_is_known_and_none_changes(name):
    options = formats()[name].options
    assert issubclass(options, Options)
    assert options() == options.model_validate({})
    with pytest.raises(ValidationError, match="no_such_option"):
        options.model_validate({"no_such_option": 1})
    with pytest.raises(ValidationError, match="frozen"):
        options().no_such_option = 1


@every("name", NAMES)
def test_the_modules_that_a_format_loads_late_exist(name):
    assert [module for module in formats()[name].modules if find_spec(module) is None] == []


@every("content", [b"\0", RANDOM, b"PK\x03\x04", b"\x89HDF\r\n\x1a\n"])
@every("name", NAMES)
def test_a_format_gives_its_reason_for_a_file_of_whatever_it_is(path, name, content):
    path.write_bytes(content)
    found = formats()[name].recognise(path)
    assert found.reason.strip() == found.reason != ""
    assert not (found.yes and found.is_known)
    assert not (found.yes and content == RANDOM)
