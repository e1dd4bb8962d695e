"""Quantities in text to SI: the laboratory's spellings, and what is refused with which words."""

import contextlib

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from colonnade import units
from colonnade.errors import UnitError
from colonnade.units import COMMON, DIMENSIONS, LARGEST_POWER, expected, resolve
from every import every


@every(
    ("text", "dimension", "expected"),
    [
        ("86 mm", "length", 0.086),
        ("-0.13mm", "length", -0.00013),
        ("−1.5e-3 m", "length", -0.0015),
        ("1 in", "length", 0.0254),
        ("26.10 kg", "mass", 26.10),
        ("2 g", "acceleration", 19.6133),  # CGPM 1901: 9.80665 m/s²
        ("980.665 Gal", "acceleration", 9.80665),
        ("9.81 m/s^2", "acceleration", 9.81),
        ("9.81 m s-2", "acceleration", 9.81),
        ("9.81 m·s⁻²", "acceleration", 9.81),
        ("9.81 m/(s*s)", "acceleration", 9.81),
        ("1 1/s", "frequency", 1.0),
        ("2 m/m", "dimensionless", 2.0),
        ("41.2 kg m^2", "inertia", 41.2),
        ("41.2 kg·m²", "inertia", 41.2),
        ("180°", "angle", 3.141592653589793),
        ("2 ms", "time", 0.002),
        ("200 Hz", "frequency", 200.0),
        ("0.9", "dimensionless", 0.9),
        ("50 %", "dimensionless", 0.5),
    ],
)
def test_quantity_becomes_si(text, dimension, expected):
    assert units.to_si(text, dimension) == pytest.approx(expected, rel=1e-14)


@every(
    ("text", "dimension", "words"),
    [
        ("86", "length", ["has no unit", '"86 mm"']),
        ("86 s", "length", ["unit of a time", "A length was expected"]),
        ("86,5 mm", "length", ["decimal comma", '"86.5 mm"']),
        ("mm", "length", ["not a quantity"]),
        ("", "length", ["not a quantity"]),
        ("nan mm", "length", ["not a quantity"]),
        ("1e999 mm", "length", ["too large"]),
        ("26 gram", "mass", ["gram", "Unknown unit", "A mass was expected"]),
        ("26 g", "mass", ["unit of an acceleration", "A mass was expected"]),
        ("3 rad/s", "frequency", ["unit of an angular velocity", "A frequency was expected"]),
        ("3 gallon", "acceleration", ["Unknown unit"]),
        ("5 mm^99", "length", ["Unknown unit"]),
    ],
)
def test_what_is_not_such_a_quantity_is_refused_in_words(text, dimension, words):
    with pytest.raises(UnitError) as caught:
        units.to_si(text, dimension)
    assert all(word in str(caught.value) for word in words), str(caught.value)


USUAL = {
    "g": ("g's", "G"),
    "V": ("Volts", "VOLTS"),
    "m/s^2": ("m/s²", "m/s^2", "m/sec2", "m/s/s"),
    "mm": ("mm.", "MM", "Mm"),
    "s": ("seconds", "sec."),
    "deg": ("°", "deg", "degrees"),
    "Gal": ("gal",),
    "kg": ("Kg",),
    "N m": ("N.m", "Nm", "N·m"),
    "kN m": ("kNm",),
    "kN": ("KN", "kn"),
    "MPa": ("MPA", "Mpa"),
    "kPa": ("KPA",),
    "mg": ("MG", "Mg"),
    "mV": ("MV",),
    "ms": ("MSEC", "Ms"),
    "": ("",),
}


@every(("spelling", "usual"), [(spelling, usual) for usual, spellings in USUAL.items() for spelling in spellings])
def test_spellings_of_recorders_are_understood(spelling, usual):
    assert resolve(spelling).symbol == usual


@every(
    ("spelling", "factor", "si_unit"),
    [
        ("KN", 1e3, "kg m s-2"),
        ("MPA", 1e6, "kg m-1 s-2"),
        ("MG", 1e-3 * 9.80665, "m s-2"),
        ("mN", 1e-3, "kg m s-2"),
        ("MN", 1e6, "kg m s-2"),
        ("kg", 1.0, "kg"),  # not a thousand gravities
    ],
)
def test_capitals_are_those_of_the_unit_that_a_laboratory_records(spelling, factor, si_unit):
    found = resolve(spelling)
    assert (found.factor, found.si_unit) == (pytest.approx(factor, rel=1e-14), si_unit)


@pytest.mark.parametrize(
    ("gain", "recorded", "dimension", "factor"),
    [
        ("10.02 mm/V", "V", "length", 0.01002),
        ("10.02 mm/V", "mV", "length", 1.002e-5),
        ("10.02 mm / V", "Volts", "length", 0.01002),
        ("0.5 g/V", "V", "acceleration", 4.903325),
        ("5 mm/(mV/V)", "mV/V", "length", 0.005),
        ("-1", "mm", "length", -0.001),
        ("2 mm/count", "count", "length", 0.002),
    ],
)
def test_gain_gives_si_per_recorded_unit(gain, recorded, dimension, factor):
    assert units.gain_to_si(gain, recorded, dimension) == pytest.approx(factor, rel=1e-14)


@pytest.mark.parametrize(
    ("gain", "recorded", "hint"),
    [
        ("10 mm", "V", '"mm per V"'),
        ("10 mm/V", "mm", '"mm per mm"'),
        ("10 mm/V", "Volt/mm", '"mm per V/mm"'),
        ("1", "V", '"mm per V"'),
    ],
)
def test_gain_that_does_not_lead_to_the_quantity_is_refused_with_the_right_one(gain, recorded, hint):
    with pytest.raises(UnitError, match="was expected") as caught:
        units.gain_to_si(gain, recorded, "length")
    assert hint in str(caught.value)


UNITS_OF = {
    "length": ("mm", "µm"),
    "acceleration": ("g", "Gal"),
    "angle": ("mrad", "deg"),
    "force": ("kN",),
    "time": ("ms", "min"),
    "frequency": ("kHz",),
    "angular_velocity": ("deg/s",),
}
UNITS_OF_A_DIMENSION = [(unit, dimension) for dimension, names in UNITS_OF.items() for unit in names]


@given(st.sampled_from(UNITS_OF_A_DIMENSION), st.floats(-1e6, 1e6).filter(lambda value: abs(value) > 1e-6))
def test_a_quantity_survives_the_way_to_si_and_back(unit, value):
    name, dimension = unit
    assert units.from_si(units.to_si(f"{value!r} {name}", dimension), name) == pytest.approx(value, rel=1e-12)


UNIT_PIECES = st.lists(
    st.sampled_from([*"mkgsVNµ°/*^().-+ 0123456789", "mm", "Hz", "g", "**", "²", "'s", "rad", "Mm^9", "in", "if"]),
    max_size=12,
)


@given(st.one_of(st.text(max_size=30), UNIT_PIECES.map(lambda pieces: "12" + "".join(pieces))))
@example("1 9**9**9**9")
@example("1 " + "m" * 5000)
def test_any_text_is_a_length_or_a_unit_error(text):
    with contextlib.suppress(UnitError):
        assert isinstance(units.to_si(text, "length"), float)


NAMES = st.sampled_from([name for name in COMMON if "/" not in name])
POWERS = st.integers(-3, 3)


@given(st.lists(st.tuples(NAMES, POWERS), min_size=1, max_size=3))
def test_a_product_of_units_has_the_product_of_their_factors(parts):
    found = resolve("*".join(f"{name}^{power}" for name, power in parts))
    factor, product = 1.0, resolve("")
    for name, power in parts:
        factor *= resolve(name).factor ** power
        product = units.product(product.symbol, f"{name}^{power}")
    assert found.factor == pytest.approx(factor, rel=1e-12)
    assert found.si_unit == product.si_unit


@given(st.lists(st.tuples(NAMES, POWERS), min_size=1, max_size=3))
def test_the_usual_spelling_of_a_unit_is_the_same_unit_and_its_own(parts):
    text = "*".join(f"{name}^{power}" for name, power in parts)
    found = resolve(text)
    usual, again = found.symbol, resolve(found.symbol)
    assert again.si_unit == found.si_unit
    assert again.factor == pytest.approx(found.factor, rel=1e-12)
    assert again.symbol == usual
    assert units.same_unit(usual, text)


@every("text", ["m/", "(m", "m)", "()", "m^10", "m^^2", "mm furlong", "x" * 101, "2m"])
def test_a_unit_that_is_none_is_refused(text):
    with pytest.raises(UnitError, match="Unknown unit"):
        resolve(text)


def test_a_hint_is_given_for_a_longer_name_only():
    with pytest.raises(UnitError, match=r'Unknown unit "mmm". Did you mean "mm"\?'):
        resolve("mmm")
    with pytest.raises(UnitError) as refused:
        resolve("q")
    assert "Did you mean" not in str(refused.value)


def test_powers_are_bounded():
    assert resolve("*".join(["m"] * LARGEST_POWER)).si_unit == f"m{LARGEST_POWER}"
    with pytest.raises(UnitError):
        resolve("*".join(["m"] * (LARGEST_POWER + 1)))


@every("dimension", DIMENSIONS)
def test_the_example_of_a_dimension_has_that_dimension(dimension):
    si_unit, example, name = DIMENSIONS[dimension]
    assert units.factor_to_si(si_unit, dimension) == 1
    assert units.factor_to_si(example, dimension) > 0
    assert name in expected(dimension).casefold()


def test_an_expectation_repeats_the_number_that_was_given():
    assert expected("length") == 'A length was expected, such as "mm".'
    assert expected("length", 86) == 'A length was expected, such as "86 mm".'
    assert expected("dimensionless") == "A plain number was expected."
