"""The dimensions and their words in messages."""

from __future__ import annotations

from colonnade import units
from colonnade.units.dimensions import DIMENSIONS, QUANTITY_DIMENSIONS, article, expected, words
from every import every


@every("dimension", DIMENSIONS)
def test_the_example_of_a_dimension_has_that_dimension(dimension: str) -> None:
    si_unit, example = DIMENSIONS[dimension]
    assert units.factor_to_si(si_unit, dimension) == 1
    assert units.factor_to_si(example, dimension) > 0
    assert words(dimension) in expected(dimension).casefold() or dimension == "dimensionless"


def test_every_quantity_has_a_known_dimension() -> None:
    assert {dimension for dimension in QUANTITY_DIMENSIONS.values() if dimension} <= DIMENSIONS.keys()


def test_an_expectation_repeats_the_number_that_was_given() -> None:
    assert expected("length") == 'A length was expected, such as "mm".'
    assert expected("length", 86) == 'A length was expected, such as "86 mm".'
    assert expected("dimensionless") == "A plain number was expected."
    assert [article(each) for each in ("acceleration", "inertia", "mass")] == [
        "an acceleration",
        "a moment of inertia",
        "a mass",
    ]
