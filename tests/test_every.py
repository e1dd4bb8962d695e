"""A test that loops over its cases reports every one that fails, named."""

import pytest

from every import every


@every(("first", "second"), [(1, 1), (1, 2), (3, 3)])
def tried(tmp_path, first, second):
    assert tmp_path == "folder"
    assert first == second
    if first == 3:
        pytest.fail("a failure that is told of")


def test_all_that_fail_are_named_with_their_cases_and_the_others_pass():
    with pytest.raises(BaseExceptionGroup) as found:
        tried(tmp_path="folder")
    assert [(type(each).__name__, each.__notes__) for each in found.value.exceptions] == [
        ("AssertionError", ["first = 1, second = 2"]),
        ("Failed", ["first = 3, second = 3"]),
    ]


def test_a_flood_without_a_case_is_refused():
    with pytest.raises(AssertionError, match="no case"):
        every("size", [])
