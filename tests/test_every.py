"""A test that loops over its cases reports every one that fails, named."""

import pytest

from every import every


@every("size", [1, 2])
@every(("first", "second"), [(1, 1), (1, 2), (3, 3)])
def tried(tmp_path, first, second, size):
    assert tmp_path == "folder"
    assert first == second
    if size == 2 and first == 3:
        pytest.fail("a failure that is told of")


def leaves(failure, above=()):
    notes = (*above, *getattr(failure, "__notes__", ()))
    if isinstance(failure, BaseExceptionGroup):
        return [leaf for each in failure.exceptions for leaf in leaves(each, notes)]
    return [(type(failure).__name__, notes)]


def test_all_that_fail_are_named_with_their_cases_and_the_others_pass():
    with pytest.raises(BaseExceptionGroup) as found:
        tried(tmp_path="folder")
    assert leaves(found.value) == [
        ("AssertionError", ("size = 1", "first = 1, second = 2")),
        ("AssertionError", ("size = 2", "first = 1, second = 2")),
        ("Failed", ("size = 2", "first = 3, second = 3")),
    ]


def test_a_flood_without_a_case_is_refused():
    with pytest.raises(AssertionError, match="no case"):
        every("size", [])
