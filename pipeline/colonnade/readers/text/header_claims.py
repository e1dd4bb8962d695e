"""What the lines above a block of numbers say about it: count, interval, unit and format."""

from __future__ import annotations

import re
from dataclasses import dataclass

from colonnade.arrays import Array
from colonnade.readers.clock import even_times

_NUMBER = r"(\d*\.\d+|\d+\.?)"
_STEPS = r"(?:spacing|interval|steps?|increments?)"
STEP = re.compile(
    rf"(?:\bdt\b|\bdelta\s*t\b|\b(?:time|sampl[a-z]*)[\W_]+{_STEPS})[^\d.\n]{{0,20}}{_NUMBER}\s*(?:s\b|sec|,|$)"
    rf"|{_STEPS}[^\d.\n]{{0,20}}{_NUMBER}\s*s(?:\b|ec)"  # a load step has a number, too, but no unit
    rf"|{_NUMBER}\s*s(?:ec(?:onds?)?)?\s*{_STEPS}",
    re.IGNORECASE | re.MULTILINE,
)
UNIT = re.compile(
    r"\bunits?\b[^\n\w]{0,5}(?:are|is|of|:|=)?\s*[(\[]?\s*(cm/s(?:ec)?/s(?:ec)?|cm/s(?:ec)?(?:\^|\*\*)?2|mm/s(?:ec)?(?:\^|\*\*)?2"
    r"|m/s(?:ec)?/s(?:ec)?|m/s(?:ec)?(?:\^|\*\*)?2|gals?|g's|g)(?![\w/])",
    re.IGNORECASE,
)
FORTRAN_FORMAT = re.compile(r"\b(?:\d+P,?)?(\d{1,3})[FEG](\d{1,3})\.\d+\b", re.IGNORECASE)
_COUNTED = r"(?:points?|samples?|pts\.?|values|ordinates|readings)"
COUNTS = re.compile(
    rf"\b(\d{{2,9}})\s+(?:\w+\s+)?{_COUNTED}\b"
    rf"|\b(?:npts|(?:no\.?|number)\s+of\s+(?:\w+\s+)?{_COUNTED}|{_COUNTED})\s*[:=]?\s*(\d{{2,9}})\b",
    re.IGNORECASE,
)
PER_ROW = re.compile(
    rf"\b(\d{{1,3}})\s+(?:\w+\s+)?{_COUNTED}?\s*(?:across|(?:per|a|each|in a|in each|to a|on each)\s+(?:row|line))\b",
    re.IGNORECASE,
)


@dataclass(frozen=True)
class HeaderClaims:
    """
    What a text says of the numbers below it.

    Attributes
    ----------
    counts : tuple of int
        How many points there are; several where several are given.
    per_row : int or None
        How many are in a row, if it says so in words.
    fields, width : int or None
        Fields of a row and characters of a field, as in `8F10.5`.
    step : float or None
        s.
    unit : str or None
    """

    counts: tuple[int, ...] = ()
    per_row: int | None = None
    fields: int | None = None
    width: int | None = None
    step: float | None = None
    unit: str | None = None

    def times(self, count: int) -> Array | None:
        """Times of so many numbers at the interval that the text gives, s; None if it gives none."""
        return None if self.step is None else even_times(count, self.step)

    @property
    def clock_note(self) -> str:
        """What these times come from."""
        return "no clock" if self.step is None else f"clock: {self.step:g} s, as the header says"


def header_claims(text: str) -> HeaderClaims:
    """
    Take from the lines above a block of numbers what they say of it.

    Examples
    --------
    >>> header_claims("1559 points at equal spacing of 0.02 sec, in the format of 8F10.5. The units are (g)")
    HeaderClaims(counts=(1559,), per_row=None, fields=8, width=10, step=0.02, unit='g')
    """
    form, across = FORTRAN_FORMAT.search(text), PER_ROW.search(text)
    step = float(_first_group(STEP, text) or "nan")
    return HeaderClaims(
        tuple(int(match[1] or match[2]) for match in COUNTS.finditer(text)),
        int(across[1]) if across else None,
        int(form[1]) if form else None,
        int(form[2]) or None if form else None,
        step if step > 0 else None,
        _first_group(UNIT, text),
    )


def _first_group(pattern: re.Pattern[str], text: str) -> str | None:
    match = pattern.search(text)
    return next((group for group in match.groups() if group), None) if match else None
