"""Columns among the variables of a MATLAB file: vectors, matrices, structs, cells."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as some

from colonnade.readers.binary.matlab import find_columns
from colonnade.readers.binary.numbers import MOST_COLUMNS, Told
from every import every

VECTOR = np.arange(50.0).reshape(-1, 1)


def columns(variables):
    return find_columns(variables, Told())[0]


def test_vectors_in_structs_and_cells_have_the_path_that_matlab_would_write():
    inner = {"top": VECTOR, "inner": {"t": VECTOR}}
    found = columns({"x": VECTOR, "run": inner, "c": [VECTOR, "text", VECTOR], "s": [{"v": VECTOR}, {"v": VECTOR}]})
    names = ["x", "run.top", "run.inner.t", "c{1}", "c{3}", "s(1).v", "s(2).v"]
    assert [column.heading for column in found] == names
    assert [column.scope for column in found][1:3] == [("run",), ("run", "run.inner")]


@every(
    ("shape", "beside", "count"),
    [((50, 3), True, 3), ((3, 50), True, 3), ((40, 60), False, 40), ((60, 40), False, 40), ((50, 60), True, 60)],
)
def test_a_matrix_has_its_samples_along_the_vector_else_along_its_longer_side(shape, beside, count):
    variables = {"m": np.zeros(shape), **({"t": VECTOR} if beside else {})}
    found = [column for column in columns(variables) if column.heading.startswith("m[")]
    assert len(found) == count
    assert {column.values.size for column in found} == {max(shape) if not beside else 50}


def test_name_and_unit_beside_the_numbers_are_theirs():
    (found,) = columns({"one": {"values": VECTOR, "Label": " top ", "unit": "mm"}})
    assert (found.name, found.unit) == ("top", "mm")


def test_single_numbers_are_kept_and_what_is_no_table_is_left_out():
    wide, told = np.zeros((MOST_COLUMNS + 2, MOST_COLUMNS + 1)), Told()
    found = find_columns({"fs": np.array([[200.0]]), "cube": np.zeros((2, 3, 4)), "wide": wide}, told)
    assert found == ([], {"fs": 200.0})
    assert told.left_out["cube"].startswith("an array of 2 × 3 × 4; vectors")
    assert "matrices of up to 1000 channels" in told.left_out["wide"]


NODES = some.recursive(
    some.just("text") | some.tuples(some.integers(0, 4), some.integers(0, 4)).map(np.zeros),
    lambda inner: some.lists(inner, max_size=3) | some.dictionaries(some.sampled_from("abc"), inner, max_size=3),
    max_leaves=8,
)


@given(some.dictionaries(some.sampled_from("xyz"), NODES))
def test_any_nest_of_variables_gives_columns_of_several_numbers(variables):
    found = columns(variables)
    assert all(column.values.ndim == 1 and column.values.size > 0 for column in found)
    assert len({column.heading for column in found}) == len(found)
