"""A forecast in words: what the table has to do, probabilities and bands."""

from __future__ import annotations

from collections.abc import Mapping
from math import isnan
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from colonnade.arrays import Array
from colonnade.campaign.forms.forecast import ForecastBand, ForecastFile, ForecastTable, ModelForecast
from colonnade.campaign.forms.foreseen import ForecastCoverage, ForecastScores, JudgedForecasts
from colonnade.identification.forecasts import Forecast, Response, base_rates, coverage, forecast_of, score, skill
from colonnade.units.text import format_percent, number, quantity

BANDS = ["50 % of max |θ|/α", "80 % of max |θ|/α", "95 % of max |θ|/α"]
FORESEEN = ("no rocking", "rocking", "overturned", *BANDS, "friction needed")
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
    shares = map(format_percent, (model.no_rocking, model.rocking, model.overturned))
    return (*shares, *map(shown_band, model.bands), friction)


if TYPE_CHECKING:
    import xarray as xr

FEWEST = 10
"""Scored tests, for skill and coverage."""

SCORES = tuple(ForecastScores.model_fields)


class Scored(NamedTuple):
    """The scored forecasts of one model, one a test: members, what was measured, PIT, and scores by basis (n, 4)."""

    forecasts: list[Forecast]
    observed: list[Response]
    pit: Array
    scores: dict[str, Array]


def scored_of(model: str, forecasts: Mapping[str, ForecastFile], scores: Mapping[str, xr.Dataset]) -> Scored:
    """
    Gather the scored forecasts of a model.

    Parameters
    ----------
    model : str
    forecasts : mapping of str to ForecastFile
        By test.
    scores : mapping of str to xr.Dataset
        Results of `stages.forecast` by test.
    """
    tests = [test for test in scores if model in forecasts[test].models]
    own = [scores[test].sel(model=model) for test in tests]
    return Scored(
        [forecast_of(forecasts[test].models[model].peak_ratio) for test in tests],
        [Response.observed(each.attrs["outcome"], float(each["observed_amplitude"])) for each in own],
        np.array([float(each["forecast_pit"].sel(basis="on_target")) for each in own]),
        {
            str(basis): np.array([[float(each[f"forecast_{key}"].sel(basis=basis)) for key in SCORES] for each in own])
            for basis in own[0]["basis"].to_numpy()
        },
    )


def judge(forecasts: Mapping[str, ForecastFile], scores: Mapping[str, xr.Dataset]) -> dict[str, JudgedForecasts]:
    """Judge the scored forecasts by model; parameters as of `scored_of`."""
    models = dict.fromkeys(model for test in scores for model in forecasts[test].models)
    return {model: _judged(scored_of(model, forecasts, scores)) for model in models}


def _judged(found: Scored) -> JudgedForecasts:
    is_enough, own = len(found.observed) >= FEWEST, found.scores["on_target"]
    return JudgedForecasts(
        tests=len(found.observed),
        on_target=_mean(own),
        on_recorded=_mean(found.scores["on_recorded"]),
        skill_rigid_body=_skill(own, found.scores["rigid_body"]) if is_enough else None,
        skill_base_rate=_skill(own, _base_rate(found.observed)) if is_enough else None,
        coverage=_coverage(found) if is_enough else None,
    )


def _mean(scores: Array) -> ForecastScores:
    """Mean of each score over the tests that have it."""
    known = scores[~np.isnan(scores).any(axis=1)]
    means = known.mean(axis=0).tolist() if known.size else [None] * len(SCORES)
    return ForecastScores(**dict(zip(SCORES, means, strict=True)))


def _base_rate(observed: list[Response]) -> Array:
    rates = zip(base_rates(observed), observed, strict=True)
    return np.array([list(score(*pair).values()) for pair in rates])


def _skill(own: Array, reference: Array) -> ForecastScores:
    values = [skill(own[:, place], reference[:, place]) for place in range(len(SCORES))]
    return ForecastScores(**{key: None if isnan(value) else value for key, value in zip(SCORES, values, strict=True)})


def _coverage(found: Scored) -> tuple[ForecastCoverage, ...]:
    bands = coverage(found.pit, found.forecasts, np.zeros(len(found.forecasts)))
    return tuple(
        ForecastCoverage(**dict(zip(ForecastCoverage.model_fields, map(float, row), strict=True)))
        for row in zip(*bands.values(), strict=True)
    )
