"""Units as recorders spell them, looked up in one registry."""

from __future__ import annotations

import pytest
from hypothesis import example, given
from hypothesis import strategies as some

from colonnade import units
from colonnade.errors import UnitError
from colonnade.units.registry import (
    COMMON,
    DIMENSIONS,
    LARGEST_POWER,
    LONGEST,
    QUANTITY_DIMENSIONS,
    article,
    collected,
    expected,
    resolve,
    words,
)
from every import every

NAMES = some.sampled_from([name for name in COMMON if "/" not in name])
POWERS = some.integers(-3, 3)


@given(some.lists(some.tuples(NAMES, POWERS), min_size=1, max_size=3))
def test_a_product_of_units_has_the_product_of_their_factors(parts: list[tuple[str, int]]) -> None:
    found = resolve("*".join(f"{name}^{power}" for name, power in parts))
    factor, powers = 1.0, collected(())
    for name, power in parts:
        one = resolve(name)
        factor *= one.factor**power
        powers = collected((*powers.items(), *((base, each * power) for base, each in one.dimension)))
    assert found.factor == pytest.approx(factor, rel=1e-12)
    assert dict(found.dimension) == powers


@given(some.lists(some.tuples(NAMES, POWERS), min_size=1, max_size=3))
def test_the_usual_spelling_of_a_unit_is_the_same_unit(parts: list[tuple[str, int]]) -> None:
    found = resolve("*".join(f"{name}^{power}" for name, power in parts))
    again = resolve(found.symbol)
    assert again.dimension == found.dimension
    assert again.factor == pytest.approx(found.factor, rel=1e-12)


@every(
    ("one", "other"),
    [
        ("m/s²", "m s^-2"),
        ("m/(s*s)", "m/s/s"),
        ("°/s", "deg/s"),
        ("kNm", "kN m"),
        ("g's", "G"),
        ("Volts", "v"),
        ("1/s", "s^-1"),
        ("N·m", "Nm"),
        ("m/m", "1"),
    ],
)
def test_two_spellings_are_one_unit(one: str, other: str) -> None:
    assert (resolve(one).factor, resolve(one).dimension) == (resolve(other).factor, resolve(other).dimension)


@every("text", ["m/", "(m", "m)", "()", "m^10", "m^^2", "mm furlong", "x" * (LONGEST + 1), "2m"])
def test_a_unit_that_is_none_is_refused(text: str) -> None:
    with pytest.raises(UnitError, match="Unknown unit"):
        resolve(text)


def test_a_hint_is_given_for_a_longer_name_only() -> None:
    with pytest.raises(UnitError, match=r'Unknown unit "mmm". Did you mean "mm"\?'):
        resolve("mmm")
    with pytest.raises(UnitError) as refused:
        resolve("q")
    assert "Did you mean" not in str(refused.value)


def test_powers_are_bounded() -> None:
    assert resolve("*".join(["m"] * LARGEST_POWER)).dimension == (("m", LARGEST_POWER),)
    with pytest.raises(UnitError):
        resolve("*".join(["m"] * (LARGEST_POWER + 1)))


@given(some.text(max_size=30))
@example("9**9**9**9")
@example("m" * 5000)
def test_any_text_is_a_unit_or_refused(text: str) -> None:
    try:
        assert resolve(text).factor > 0
    except UnitError as error:
        assert "Unknown unit" in str(error)  # noqa: PT017 - either outcome is right


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
