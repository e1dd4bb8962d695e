"""Forecasts in the summary: of each test the last that was blind, with its scores, and all together."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from colonnade.campaign import Campaign
from colonnade.campaign.forms.forecast import ModelForecast
from colonnade.campaign.forms.foreseen import (
    ForecastEntry,
    ForecastOfModel,
    ForecastScores,
    ForecastsSummary,
    TestForecast,
)
from colonnade.findings import Finding, warning
from colonnade.store.forecasts import Forecasts, Known, Refused
from colonnade.store.layout import Layout
from colonnade.workflow.product import read_done
from colonnade.workflow.raw_files import RawFiles

if TYPE_CHECKING:
    import xarray as xr

NOT_BLIND = "not blind: the raw file of the test was there when it was made"
NOT_MEASURED = "the test has no result yet"


@dataclass(frozen=True)
class Chosen:
    """
    The forecasts of a campaign by what they are for.

    Attributes
    ----------
    blind : dict of str to bool
        By file, of those that are for a test: whether it is blind.
    counts : dict of str to Known
        By test the one that counts: the last one that is blind, else the last one.
    """

    blind: dict[str, bool]
    counts: dict[str, Known]

    @property
    def scored(self) -> dict[str, Known]:
        """Those of `counts` that are blind."""
        return {test: known for test, known in self.counts.items() if self.blind[known.name]}


def choose(campaign: Campaign, forecasts: Forecasts, raw: Mapping[str, RawFiles]) -> Chosen:
    """
    Find the forecast of each test that counts.

    Parameters
    ----------
    campaign : Campaign
    forecasts : Forecasts
        A forecast is for the test that it names, if that is still one of its specimen.
    raw : mapping of str to mapping of str to RawFile
        Raw files by test.
    """
    blind, counts = {}, dict[str, Known]()
    for known in forecasts.known:
        test = campaign.tests.get(known.forecast.test or "")
        if test is None or test.specimen != known.forecast.specimen:
            continue
        blind[known.name] = is_blind(known, raw[test.id])
        earlier = counts.get(test.id)
        if earlier is None or blind[known.name] or not blind[earlier.name]:
            counts[test.id] = known
    return Chosen(blind, counts)


def is_blind(known: Known, raw: RawFiles) -> bool:
    """Whether none of a test's raw files was there when a forecast was made, by name or by content."""
    there = known.forecast.raw_files
    content = {file.sha256 for file in raw.values() if file.sha256 is not None}
    return not (raw.keys() & there.keys() or content & set(there.values()))


Foreseen = tuple[Mapping[str, TestForecast], ForecastsSummary | None]
"""What the summary says of forecasts: by test, and of all together."""


def finding_of(refused: Refused) -> Finding:
    """Make a finding of a file that cannot be taken as a forecast."""
    return warning("forecast", f"forecasts/{refused.name}: {refused.reason} It is left out.")


def foreseen_of(layout: Layout, forecasts: Forecasts, chosen: Chosen, left_out: Collection[str]) -> Foreseen:
    """
    Gather what the summary says of forecasts.

    Parameters
    ----------
    layout : Layout
    forecasts : Forecasts
    chosen : Chosen
    left_out : collection of str
        Tests without results that are up to date: their forecasts have no scores.
    """
    scored, records = {}, {}
    for test, known in chosen.counts.items():
        blind, reason = chosen.blind[known.name], NOT_BLIND
        scores = _scores(layout, test, known) if blind and test not in left_out else None
        if blind:
            reason = NOT_MEASURED if scores is None else str(scores.attrs["reason"])
        if scores is not None and "observed_amplitude" in scores:
            scored[test] = scores
        records[test] = _record(known, blind=blind, scores=scored.get(test), reason=reason)
    return records, _together(forecasts, chosen, scored)


def _scores(layout: Layout, test: str, known: Known) -> xr.Dataset | None:
    """Read the scores of a forecast; None if there are none, or those of another."""
    scores = read_done(layout.stage(test, "forecast"))
    return None if scores is None or scores.attrs["file"] != known.name else scores


def _record(known: Known, *, blind: bool, scores: xr.Dataset | None, reason: str) -> TestForecast:
    forecast = known.forecast
    return TestForecast(
        file=known.name,
        made=f"{forecast.made:%Y-%m-%dT%H:%M:%SZ}",
        level=forecast.level,
        blind=blind,
        reason=reason or None,
        models={name: _of_model(name, model, scores) for name, model in forecast.models.items()},
    )


def _together(forecasts: Forecasts, chosen: Chosen, scored: Mapping[str, xr.Dataset]) -> ForecastsSummary | None:
    """Return what is said of all forecasts, given the scores by test; None if there is no file."""
    if not (forecasts.known or forecasts.refused):
        return None
    from colonnade.store.records.forecast import judge

    names = {chosen.counts[test].name for test in scored}
    return ForecastsSummary(
        count=len(forecasts.known),
        blind=sum(chosen.blind.values()),
        models=judge({test: chosen.counts[test].forecast for test in scored}, scored) if scored else {},
        files=(
            *(
                ForecastEntry(
                    file=known.name,
                    sha256=known.sha256,
                    test=known.forecast.test,
                    blind=chosen.blind.get(known.name),
                    scored=known.name in names,
                )
                for known in forecasts.known
            ),
            *(ForecastEntry(file=each.name, refused=each.reason) for each in forecasts.refused),
        ),
    )


def _of_model(name: str, model: ModelForecast, scores: xr.Dataset | None) -> ForecastOfModel:
    widest = max(model.bands, key=lambda band: band.probability)
    found: dict[str, Any] = {}
    pit = None
    if scores is not None:
        own = scores.sel(model=name)
        pit = float(own["forecast_pit"].sel(basis="on_target"))
        for basis in map(str, own["basis"].to_numpy()):
            at = own.sel(basis=basis)
            values = ForecastScores(**{key: float(at[f"forecast_{key}"]) for key in ForecastScores.model_fields})
            found[basis] = None if values.crps is None else values
    return ForecastOfModel(
        **{share: getattr(model, share) for share in ("no_rocking", "rocking", "overturned")},
        low=widest.low,
        high=widest.high,
        pit=pit,
        **found,
    )
