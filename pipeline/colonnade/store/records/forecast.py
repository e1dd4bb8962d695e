"""A forecast in words: what the table has to do, probabilities and bands."""

from __future__ import annotations

from colonnade.campaign.forms.forecast import ForecastBand, ForecastTable, ModelForecast
from colonnade.units import format_percent
from colonnade.units.text import number, quantity

FORESEEN = (
    *("no rocking", "rocking", "overturned"),
    *("50 % of max |θ|/α", "80 % of max |θ|/α", "95 % of max |θ|/α", "friction needed"),
)
"""What `shown_model` writes."""


def shown_table(table: ForecastTable) -> tuple[str, str, str]:
    """Write peak acceleration, velocity and displacement of the table; of an integral that drifts, its drift."""
    drifts = f"not known, drifts by {format_percent(table.drift)}"
    velocity, displacement = table.peak_velocity, table.peak_displacement
    return (
        quantity(table.peak_acceleration, "g"),
        drifts if velocity is None else quantity(velocity, "mm/s"),
        "–" if velocity is None else drifts if displacement is None else quantity(displacement, "mm"),
    )


def shown_shares(model: ModelForecast) -> tuple[str, str, str]:
    """Write the probabilities of no rocking, rocking and overturning."""
    return format_percent(model.no_rocking), format_percent(model.rocking), format_percent(model.overturned)


def shown_band(band: ForecastBand) -> str:
    """
    Write a band of the peak; 1 is overturned.

    Examples
    --------
    >>> shown_band(ForecastBand(probability=0.8, low=0.213, high=1.0))
    '0.213 to overturned'
    """
    low, high = ("overturned" if end == 1.0 else number(end) for end in (band.low, band.high))
    return low if low == high else f"{low} to {high}"


def shown_model(model: ModelForecast) -> tuple[str, ...]:
    """Write what a model foresees, as of `FORESEEN`: probabilities, bands of the peak, friction needed."""
    friction = "lifts off" if model.required_friction is None else number(model.required_friction, 2)
    return (*shown_shares(model), *map(shown_band, model.bands), friction)
