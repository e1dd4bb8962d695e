"""Columns among the variables of a MATLAB file: vectors, matrices, structs, cells."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as some

from colonnade.readers.binary.matlab_columns import MOST_COLUMNS, find_columns, numbered_channels, object_reason
from every import every

VECTOR = np.arange(50.0).reshape(-1, 1)


def test_vectors_in_structs_and_cells_have_the_path_that_matlab_would_write():
    found = find_columns({"x": VECTOR, "run": {"top": VECTOR, "inner": {"t": VECTOR}}, "c": [VECTOR, "text", VECTOR]})
    assert [column.heading for column in found.columns] == ["x", "run.top", "run.inner.t", "c{1}", "c{3}"]
    assert [column.scope for column in found.columns][1:3] == [("run",), ("run", "run.inner")]


def test_an_array_of_structs_is_counted_in_round_brackets():
    found = find_columns({"s": [{"v": VECTOR}, {"v": VECTOR}]})
    assert [column.heading for column in found.columns] == ["s(1).v", "s(2).v"]


@every(
    ("shape", "beside", "count"),
    [((50, 3), True, 3), ((3, 50), True, 3), ((40, 60), False, 40), ((60, 40), False, 40), ((50, 60), True, 60)],
)
def test_a_matrix_has_its_samples_along_the_vector_else_along_its_longer_side(shape, beside, count):
    variables = {"m": np.zeros(shape), **({"t": VECTOR} if beside else {})}
    columns = [column for column in find_columns(variables).columns if column.heading.startswith("m[")]
    assert len(columns) == count
    assert {column.values.size for column in columns} == {max(shape) if not beside else 50}


def test_names_and_units_beside_the_numbers_are_theirs():
    found = find_columns(
        {
            "one": {"values": VECTOR, "label": " top ", "unit": "mm"},
            "many": {"data": np.zeros((50, 2)), "colheaders": ["a [V]", "b"]},
        }
    )
    assert [(column.name, column.unit) for column in found.columns] == [("top", "mm"), ("a", "V"), ("b", None)]


def test_single_numbers_are_kept_and_what_is_no_table_is_left_out():
    found = find_columns(
        {"fs": np.array([[200.0]]), "cube": np.zeros((2, 3, 4)), "wide": np.zeros((MOST_COLUMNS + 2, MOST_COLUMNS + 1))}
    )
    assert found.scalars == {"fs": 200.0}
    assert found.columns == []
    assert found.left_out["cube"].startswith("an array of 2 × 3 × 4; vectors")
    assert "matrices of up to 1000 channels" in found.left_out["wide"]


NODES = some.recursive(
    some.just("text") | some.tuples(some.integers(0, 4), some.integers(0, 4)).map(np.zeros),
    lambda inner: some.lists(inner, max_size=3) | some.dictionaries(some.sampled_from("abc"), inner, max_size=3),
    max_leaves=8,
)


@given(some.dictionaries(some.sampled_from("xyz"), NODES))
def test_any_nest_of_variables_gives_columns_of_several_numbers(variables):
    found = find_columns(variables)  # type: ignore[arg-type]
    assert all(column.values.ndim == 1 and column.values.size > 0 for column in found.columns)
    paths = [column.heading for column in found.columns]
    assert len(set(paths)) == len(paths)


SINE, RISING = np.sin(np.arange(20.0)).reshape(-1, 1), np.arange(20.0).reshape(-1, 1)


def layout(first, rate="200"):
    return {
        "File_Header": {"SampleFrequency": rate},
        "Channel_1_Header": {"SignalName": " LVDT 1 ", "Unit": "mm"},
        "Channel_1_Data": first,
        "Channel_2_Data": SINE,
        "comment": "kept",
    }


@every("rate", ["", "fast", -5, np.empty((0, 0)), {}])
def test_a_rate_that_is_none_is_none(rate):
    assert numbered_channels(layout(SINE, rate))[2] == {}  # type: ignore[arg-type]


def test_a_file_of_another_layout_is_left_as_it_is():
    variables = {"x": SINE}
    assert numbered_channels(variables) == (variables, [], {}, [])


@every(("name", "told"), [("timetable", "timetable2table(x)"), ("odd", "as plain arrays")])
def test_an_object_is_refused_with_what_to_do(name, told):
    reason = object_reason(name)
    assert f"MATLAB's class {name}, which only MATLAB can open" in reason
    assert told in reason
