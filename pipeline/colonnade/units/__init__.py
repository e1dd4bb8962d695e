"""Quantities in text to SI and back; inside colonnade all numbers are SI."""

from colonnade.units.conversion import (
    NUMBER_PATTERN,
    factor_to_si,
    from_si,
    gain_to_si,
    is_of,
    is_physical,
    normalise_unit,
    parse,
    same_unit,
    si_factor,
    to_si,
)
from colonnade.units.registry import DIMENSIONS, QUANTITY_DIMENSIONS
from colonnade.units.writing import PERCENT, format_percent, format_quantity, format_uncertain, with_minus

__all__ = [
    "DIMENSIONS",
    "NUMBER_PATTERN",
    "PERCENT",
    "QUANTITY_DIMENSIONS",
    "factor_to_si",
    "format_percent",
    "format_quantity",
    "format_uncertain",
    "from_si",
    "gain_to_si",
    "is_of",
    "is_physical",
    "normalise_unit",
    "parse",
    "same_unit",
    "si_factor",
    "to_si",
    "with_minus",
]
