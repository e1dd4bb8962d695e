"""Columns of whole numbers with a point or a comma between their thousands, which look like decimals: 998, 1.012."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

import numpy as np

from colonnade.arrays import Array
from colonnade.readers.text.lines.cells import MARKED, Dialect

if TYPE_CHECKING:
    import pandas as pd

_WHOLE = re.compile(r"[+\-\N{MINUS SIGN}]?\d{1,3}", re.ASCII)
LARGE, THOUSAND = 100.0, 1000.0
"""A number without a mark between thousands is below the second; some above the first are on the way there."""
MANY = 50
"""Different numbers that have a mark, so many that decimals would differ in their number of digits."""


class Grouping:
    """
    What speaks for and against thousands that are marked in a column.

    All numbers from 1000 on have three digits after each mark, and those below have no mark. Decimals would have other
    numbers of digits, too, unless all have three.
    """

    def __init__(self, dialect: Dialect) -> None:
        self._dialect, self._signs = dialect, set[str]()
        self._has_small = self._has_large = self._is_refuted = False
        self._marked = 0

    @property
    def sign(self) -> str | None:
        """The mark; None if nothing speaks for one."""
        is_likely = self._has_small and (self._has_large or self._marked >= MANY) and not self._is_refuted
        return next(iter(self._signs)) if is_likely and len(self._signs) == 1 else None

    def look(self, cells: pd.Series, values: Array) -> None:
        """Look at further cells: as text, or as the numbers that they were read as."""
        if self._is_refuted:
            return
        if cells.dtype.kind in "biuf":
            self._look_at_numbers(np.abs(values[np.isfinite(values)]))
            return
        for cell in cells.dropna().unique():
            text = str(cell).strip().strip('"')
            if marked := MARKED.fullmatch(text):
                self._signs.add(marked[1])
                self._marked += 1
            elif _WHOLE.fullmatch(text):
                self._has_small = True
                self._has_large |= abs(self._dialect.number(text)) >= LARGE
            elif any(map(str.isdecimal, text)):
                self._is_refuted = True
                return

    def _look_at_numbers(self, sizes: Array) -> None:
        whole = sizes == np.rint(sizes)
        thousandths = np.unique(THOUSAND * sizes[~whole])
        far = (sizes >= THOUSAND).any() or (thousandths < THOUSAND).any()
        self._is_refuted = bool(far or (np.abs(thousandths - np.rint(thousandths)) > 1e-6).any())
        self._has_small |= bool(whole.any())
        self._has_large |= bool((sizes[whole] >= LARGE).any())
        self._marked += thousandths.size
        self._signs |= {self._dialect.decimal} if thousandths.size else set()
