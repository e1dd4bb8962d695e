"""Quantities in text to SI and back; inside colonnade all numbers are SI."""

from colonnade.units.conversion import NUMBER_PATTERN as NUMBER_PATTERN
from colonnade.units.conversion import factor_to_si as factor_to_si
from colonnade.units.conversion import from_si as from_si
from colonnade.units.conversion import gain_to_si as gain_to_si
from colonnade.units.conversion import is_of as is_of
from colonnade.units.conversion import is_physical as is_physical
from colonnade.units.conversion import normalise_unit as normalise_unit
from colonnade.units.conversion import parse as parse
from colonnade.units.conversion import same_unit as same_unit
from colonnade.units.conversion import si_factor as si_factor
from colonnade.units.conversion import to_si as to_si
from colonnade.units.registry import DIMENSIONS as DIMENSIONS
from colonnade.units.registry import QUANTITY_DIMENSIONS as QUANTITY_DIMENSIONS
from colonnade.units.writing import PERCENT as PERCENT
from colonnade.units.writing import format_percent as format_percent
from colonnade.units.writing import format_quantity as format_quantity
from colonnade.units.writing import format_uncertain as format_uncertain
from colonnade.units.writing import with_minus as with_minus
