"""
The one table of variables, `variables.csv`: units, names, CF attributes and stages of everything that colonnade stores.

A stage returns values; `store.description` says by this table what they are. A unit that is empty stands for text and
flags. A result has those variables of its stage that its test and its campaign give rise to.
"""

from __future__ import annotations

import csv
from dataclasses import dataclass
from pathlib import Path
from typing import Any

MEASURED = "physicalMeasurement"
MODELLED = "modelResult"
AUXILIARY = "auxiliaryInformation"
QUALITY = "qualityInformation"
COORDINATE = "coordinate"


@dataclass(frozen=True)
class Variable:
    """
    How one variable is stored and described.

    Attributes
    ----------
    long_name : str
        In words.
    units : str or None
        UDUNITS spelling; "1" for a number, None for text and flags.
    content : str
        ACDD coverage_content_type.
    standard_name : str or None
        Where CF has one; rocking has almost none.
    dtype : str
        numpy's name; "str" for text.
    comment : str or None
        Sign, frame or definition, where the name does not say it.
    stages : tuple of str
        Whose results may have it.
    """

    long_name: str
    units: str | None = "1"
    content: str = AUXILIARY
    standard_name: str | None = None
    dtype: str = "float64"
    comment: str | None = None
    stages: tuple[str, ...] = ()

    def attributes(self) -> dict[str, Any]:
        """CF and ACDD attributes, those that are not given left out."""
        given = {
            "long_name": self.long_name,
            "standard_name": self.standard_name,
            "units": self.units,
            "coverage_content_type": self.content,
            "comment": self.comment,
        }
        return {name: value for name, value in given.items() if value is not None}


_CONTENTS = {
    "measured": MEASURED,
    "modelled": MODELLED,
    "auxiliary": AUXILIARY,
    "quality": QUALITY,
    "coordinate": COORDINATE,
}
"""ACDD's words for the column `content`."""


def _table() -> dict[str, Variable]:
    with Path(__file__).with_suffix(".csv").open(encoding="utf-8", newline="") as stream:
        return {
            row["name"]: Variable(
                row["long_name"],
                row["units"] or None,
                _CONTENTS[row["content"]],
                row["standard_name"] or None,
                row["dtype"],
                row["comment"] or None,
                tuple(row["stages"].split()),
            )
            for row in csv.DictReader(stream)
        }


VARIABLES = _table()
