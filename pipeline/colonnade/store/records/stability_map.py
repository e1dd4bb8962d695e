"""A stability map as it is stored, and back as the library gives it."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import xarray as xr

    from colonnade.dynamics.maps.chart import StabilityMap


def as_dataset(chart: StabilityMap) -> xr.Dataset:
    """Return a map in its stored form: outcomes over Ω and A, limits over Ω, the options as attributes."""
    import xarray as xr

    cells = ("frequency_ratio", "amplitude_ratio")
    return xr.Dataset(
        {
            "outcome": (cells, chart.outcome),
            "overturning_fraction": (cells, chart.overturning_fraction),
            "no_rocking_limit": ("frequency_ratio", chart.no_rocking),
            "lower_limit": ("frequency_ratio", chart.lower),
            "upper_limit": ("frequency_ratio", chart.upper),
            "interval_frequency_ratio": ("interval", chart.interval_frequency_ratio),
            "interval_start": ("interval", chart.interval_start),
            "interval_end": ("interval", chart.interval_end),
        },
        coords={"frequency_ratio": chart.frequency_ratio, "amplitude_ratio": chart.amplitude_ratio},
        attrs=chart.options,
    )


def as_map(stored: xr.Dataset) -> StabilityMap:
    """Return a stored map as the library gives it."""
    from colonnade.dynamics.maps.chart import StabilityMap

    return StabilityMap(
        stored["frequency_ratio"].to_numpy(),
        stored["amplitude_ratio"].to_numpy(),
        stored["outcome"].to_numpy(),
        stored["overturning_fraction"].to_numpy(),
        stored["no_rocking_limit"].to_numpy(),
        stored["lower_limit"].to_numpy(),
        stored["upper_limit"].to_numpy(),
        stored["interval_frequency_ratio"].to_numpy(),
        stored["interval_start"].to_numpy(),
        stored["interval_end"].to_numpy(),
        json.loads(stored.attrs["settings"]),
    )
