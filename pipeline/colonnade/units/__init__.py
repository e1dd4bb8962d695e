"""Quantities in text to SI and back; inside colonnade all numbers are SI."""

from colonnade.units.quantity import DIMENSIONS as DIMENSIONS
from colonnade.units.quantity import NUMBER_PATTERN as NUMBER_PATTERN
from colonnade.units.quantity import QUANTITY_DIMENSIONS as QUANTITY_DIMENSIONS
from colonnade.units.quantity import factor_to_si as factor_to_si
from colonnade.units.quantity import from_si as from_si
from colonnade.units.quantity import gain_to_si as gain_to_si
from colonnade.units.quantity import is_of as is_of
from colonnade.units.quantity import is_physical as is_physical
from colonnade.units.quantity import normalise_unit as normalise_unit
from colonnade.units.quantity import parse as parse
from colonnade.units.quantity import same_unit as same_unit
from colonnade.units.quantity import si_factor as si_factor
from colonnade.units.quantity import to_si as to_si
from colonnade.units.text import PERCENT as PERCENT
from colonnade.units.text import format_percent as format_percent
from colonnade.units.text import format_uncertain as format_uncertain
from colonnade.units.text import with_minus as with_minus
