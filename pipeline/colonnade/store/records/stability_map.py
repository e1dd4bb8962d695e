"""A stability map as it is stored, and back as the library gives it."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import xarray as xr

    from colonnade.dynamics.maps import StabilityMap


CELLS = {"outcome": "outcome", "overturning_fraction": "overturning_fraction"}
LIMITS = {"no_rocking_limit": "no_rocking", "lower_limit": "lower", "upper_limit": "upper"}
INTERVALS = {name: name for name in ("interval_frequency_ratio", "interval_start", "interval_end")}
"""Stored variables over Ω and A, over Ω, and of intervals, with the field of the map that each holds."""


def as_dataset(chart: StabilityMap) -> xr.Dataset:
    """Return a map in its stored form: outcomes over Ω and A, limits over Ω, the options as attributes."""
    import xarray as xr

    shapes = {("frequency_ratio", "amplitude_ratio"): CELLS, "frequency_ratio": LIMITS, "interval": INTERVALS}
    return xr.Dataset(
        {name: (over, getattr(chart, own)) for over, names in shapes.items() for name, own in names.items()},
        coords={"frequency_ratio": chart.frequency_ratio, "amplitude_ratio": chart.amplitude_ratio},
        attrs=chart.options,
    )


def as_map(stored: xr.Dataset) -> StabilityMap:
    """Return a stored map as the library gives it."""
    from colonnade.dynamics.maps import StabilityMap

    names = CELLS | LIMITS | INTERVALS | {name: name for name in ("frequency_ratio", "amplitude_ratio")}
    values = {own: stored[name].to_numpy() for name, own in names.items()}
    return StabilityMap(**values, options=json.loads(stored.attrs["settings"]))
