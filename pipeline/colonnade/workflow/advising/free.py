"""Advice on the free vibrations of a specimen: whether e needs another, and from which angle."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from colonnade.campaign import Campaign
from colonnade.campaign.forms.summary import TestSummary
from colonnade.identification.advice.restitution import LAST_PEAK, advise_free_vibration
from colonnade.store.records.advice import Advice
from colonnade.units import format_uncertain
from colonnade.units.text import number

if TYPE_CHECKING:
    import xarray as xr

LARGEST_RELEASE = 0.6
"""|θ|/α from which a specimen is released at most: large first amplitudes disagree with every model."""


def advise_free(
    campaign: Campaign, specimen: str, pooled: xr.Dataset, tests: Mapping[str, TestSummary]
) -> Advice | None:
    """
    Advise on the next free vibration.

    Parameters
    ----------
    campaign : Campaign
    specimen : str
        Its id.
    pooled : xr.Dataset
        Its e, as the stage `specimen` gives it.
    tests : mapping of str to TestSummary
        Records of the campaign's tests.

    Returns
    -------
    advice : Advice or None
        None if e is given in the campaign file.
    """
    if pooled.attrs["restitution_source"] == "given":
        return None
    wanted = campaign.next.restitution_width
    released = _released(pooled, tests)
    if not released:
        reason = "e is not identified, so predictions use the rigid-body value"
        return Advice(specimen, "free-vibration", f"release from {LARGEST_RELEASE:g} α", False, reason)
    names, angles = list(released), np.array(list(released.values()))
    places = [list(pooled["test_id"].to_numpy()).index(name) for name in names]
    advised = advise_free_vibration(
        pooled["test_restitution"].to_numpy()[places],
        pooled["test_restitution_standard_error"].to_numpy()[places],
        angles,
        wanted_half_width=wanted / 2,
        largest_release=LARGEST_RELEASE,
        level=float(pooled["level"]),
    )
    known = f"e {format_uncertain(advised.pooled.value, advised.half_width)} from {len(names)}"
    after = format_uncertain(advised.pooled.value, float(advised.predicted_half_width[0]))
    limit = "the scatter between tests" if advised.limited_by == "scatter" else "the error of a single test"
    return Advice(
        specimen=specimen,
        kind="free-vibration",
        test=f"release from {number(abs(advised.release_ratio), 2)} α",  # the records keep no side
        is_enough=advised.is_enough,
        reason=known
        + (", as narrow as wanted" if advised.is_enough else f"; one more test: about {after}; limited by {limit}"),
        left=advised.needed,
        values={
            "restitution": advised.pooled.value,
            "half_width": advised.half_width,
            "half_width_after": float(advised.predicted_half_width[0]),
            "release_ratio": abs(advised.release_ratio),
        },
    )


def _released(pooled: xr.Dataset, tests: Mapping[str, TestSummary]) -> dict[str, float]:
    """Give |θ|/α of the release of each free vibration whose e is pooled."""
    names = [str(name) for name in pooled["test_id"].to_numpy()] if "test_id" in pooled else []
    ratios = {name: tests[name].release_ratio or tests[name].peak_ratio for name in names if name in tests}
    return {name: ratio for name, ratio in ratios.items() if ratio is not None and LAST_PEAK < ratio < 1.0}
