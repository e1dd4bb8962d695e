"""Likelihoods: how often the pattern comes, with intervals."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import stats

from colonnade.arrays import Array, Mask
from span_two_and_a_half.criterion import AS_FIXED
from span_two_and_a_half.design import (
    ABOUT,
    BOTH,
    CAUSES,
    DECISIVE,
    EVERY,
    GRADES,
    MODELS,
    ONLY,
    PLAUSIBLE,
    SPACE,
    Cell,
)
from span_two_and_a_half.members import FORWARD, REVERSE, RUN_ALL, VARIANTS, Judged

VIEWS, SCOPES = (BOTH, *MODELS), (EVERY, ONLY)
LEVEL = 0.95
PARTS = 12
"""Equal parts of the range of intensities, on a logarithmic scale."""

WITHOUT_SCOPE = ("none", "tangent")
"""Causes that are not asked to act at Span 2.5 only."""


def interval(count: int, of: int, level: float = LEVEL) -> tuple[float, float]:
    """Give the limits of a share (Clopper and Pearson)."""
    if of == 0:
        return 0.0, 1.0
    found = stats.binomtest(count, of).proportion_ci(level, method="exact")
    return float(found.low), float(found.high)


@dataclass(frozen=True)
class Strata:
    """
    Intensities in two parts, of which each has members of its own.

    Attributes
    ----------
    levels : ndarray, shape (k,)
        m/s² for each unit of Span, rising.
    first : ndarray of bool, shape (k,)
        Those of the first part, that has more members.
    """

    levels: Array
    first: Mask

    @property
    def weight(self) -> float:
        """Share of the intensities that the first part has."""
        return float(self.first.mean())

    def in_first(self, intensity: Array) -> Mask:
        """Tell which members are of the first part."""
        return np.asarray(self.first[self.place(intensity)])

    def place(self, intensity: Array) -> NDArray[np.intp]:
        """Give which of the levels each member has."""
        return np.searchsorted(self.levels, intensity * (1.0 - 1e-9))

    def counts(self, shown: Mask, intensity: Array) -> list[int]:
        """Count the members that show something, and all members, of the first part and of the second."""
        inside = self.in_first(intensity)
        return [int(shown[inside].sum()), int(inside.sum()), int(shown[~inside].sum()), int((~inside).sum())]

    def share(self, counts: list[int]) -> list[float]:
        """
        Estimate a share over all intensities from `counts`, with its limits.

        Both parts hold together with 95 %: each has half of what may fail.
        """
        share = low = high = 0.0
        for count, of, weight in ((*counts[:2], self.weight), (*counts[2:], 1.0 - self.weight)):
            limits = interval(count, of, 1.0 - (1.0 - LEVEL) / 2.0)
            share += weight * count / max(of, 1)
            low, high = low + weight * limits[0], high + weight * limits[1]
        return [round(each, 7) for each in (share, low, high)]


def of_view(values: Mask, view: str) -> Mask:
    """Take one model's column of the last axis, or whether all are true."""
    return values.all(axis=-1) if view == BOTH else values[..., MODELS.index(view)]


def pattern(judged: Judged, *, view: str, scope: str, direction: int, variant: str = AS_FIXED) -> Mask:
    """Tell which members show the whole pattern: Span 2.5 misbehaves, and Spans 2.0 and 3.0 agree; shape (n,)."""
    row = list(VARIANTS).index(variant)
    agree = judged.agree[:, SCOPES.index(scope), row]
    return of_view(judged.grown[:, row, direction] & agree, view)


def agreement(judged: Judged, strata: Strata, *, view: str, scope: str, variant: str = AS_FIXED) -> list[int]:
    """Count the members whose Spans 2.0 and 3.0 agree, of those that were run at them whatever Span 2.5 shows."""
    looked = judged.number % RUN_ALL == 0
    agree = judged.agree[looked, SCOPES.index(scope), list(VARIANTS).index(variant)]
    return strata.counts(of_view(agree, view), judged.intensity[looked])


def likelihoods(found: dict[Cell, Judged], strata: Strata) -> list[dict[str, Any]]:
    """Give a row for each cell and scope."""
    return [
        _row(cell, judged, scope, strata)
        for scope in SCOPES
        for cell, judged in found.items()
        if scope == EVERY or cell.cause not in WITHOUT_SCOPE
    ]


def _row(cell: Cell, judged: Judged, scope: str, strata: Strata) -> dict[str, Any]:
    row: dict[str, Any] = {
        "cause": cell.cause,
        "grade": "" if len(CAUSES[cell.cause].sizes) == 1 else GRADES[cell.grade],
        "scope": scope,
        "members": int(judged.number.size),
    }
    for view in VIEWS:
        shown = {
            name: {
                each: strata.counts(
                    pattern(judged, view=view, scope=scope, direction=way, variant=each), judged.intensity
                )
                for each in VARIANTS
            }
            for name, way in (("pattern", FORWARD), ("reverse", REVERSE))
        }
        here = pattern(judged, view=view, scope=scope, direction=FORWARD)
        grown = strata.counts(of_view(judged.grown[:, 0, FORWARD], view), judged.intensity)
        agree = agreement(judged, strata, view=view, scope=scope)
        row[view] = {
            **shown,
            "likelihood": strata.share(shown["pattern"][AS_FIXED]),
            "reverse_likelihood": strata.share(shown["reverse"][AS_FIXED]),
            "span_2.5_alone": strata.share(grown),
            "agree": strata.share(agree),
            "by_intensity": _by_intensity(judged, here, strata),
            **_places(judged, here, view),
        }
    return row


def _by_intensity(judged: Judged, shown: Mask, strata: Strata) -> list[float]:
    """Give the share of the members that show it in each part of the range of intensities."""
    place = strata.place(judged.intensity)
    size = strata.levels.size
    each = np.bincount(place[shown], minlength=size) / np.bincount(place, minlength=size)
    return [round(float(part.mean()), 6) for part in np.array_split(each, min(PARTS, size))]


def _places(judged: Judged, shown: Mask, view: str) -> dict[str, Any]:
    """Give where it happens: quantiles in s, and how many at "about 6 s"."""
    column = MODELS.index(MODELS[-1] if view == BOTH else view)
    places = judged.place[shown, FORWARD, column]
    if places.size == 0:
        return {"place": None, "about_6_s": 0}
    low, high = ABOUT
    return {
        "place": [round(float(each), 2) for each in np.quantile(places, (0.05, 0.5, 0.95))],
        "about_6_s": int(np.sum((places >= low) & (places <= high))),
    }


def best_and_worst(rows: list[dict[str, Any]], view: str, scope: str) -> dict[str, dict[str, float]]:
    """
    Give by cause the largest lower limit and the largest upper limit of its likelihood over the plausible sizes.

    A cause without sizes counts with its only one.
    """
    found: dict[str, dict[str, float]] = {}
    for row in rows:
        if row["scope"] != scope or (row["grade"] and row["grade"] not in PLAUSIBLE):
            continue
        low, high = row[view]["likelihood"][1:]
        before = found.setdefault(row["cause"], {"low": 0.0, "high": 0.0})
        before["low"], before["high"] = max(before["low"], low), max(before["high"], high)
    return found


def decided(limits: dict[str, dict[str, float]]) -> list[tuple[str, str]]:
    """Give the pairs of causes of which the first is preferred to the second by the rule that was fixed."""
    return [
        (one, other)
        for one, first in limits.items()
        for other, second in limits.items()
        if one != other and first["low"] >= DECISIVE * second["high"]
    ]


def causes_of(rows: list[dict[str, Any]]) -> list[str]:
    """Give the causes of rows, in the order of the design."""
    present = {row["cause"] for row in rows}
    return [name for name in {**CAUSES, **SPACE} if name in present]
