"""Forecasts of a specimen on one base motion at several levels, with what is known so far, each kept in its file."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

import colonnade
from colonnade.arrays import Array
from colonnade.campaign import Campaign, Test, load
from colonnade.campaign.forms.forecast import (
    ForecastBand,
    ForecastBlock,
    ForecastFile,
    ForecastInputs,
    ForecastMotion,
    ForecastRestitution,
    ForecastSpread,
    ForecastTable,
    ModelForecast,
)
from colonnade.campaign.syntax.fields import PLAIN, outside
from colonnade.dynamics.models import MODELS
from colonnade.dynamics.motion import Motion
from colonnade.errors import CampaignError
from colonnade.interruption import expect_none
from colonnade.store.forecasts import write_forecast
from colonnade.store.layout import Layout
from colonnade.store.results import WITHOUT_PREDICTION
from colonnade.workflow.executors import Counted
from colonnade.workflow.motions import AskedMotion, level_of, motion_asked_for
from colonnade.workflow.pooling import expect_known, one_specimen, restitution_taken
from colonnade.workflow.product import Catalogue, stored_attributes
from colonnade.workflow.raw_files import raw_files

if TYPE_CHECKING:
    from colonnade.dynamics.ensemble import Ensemble
    from colonnade.dynamics.history import History

MADE_BY = ("colonnade.workflow.foresee", "colonnade.workflow.motions", "colonnade.stages.forecast")
"""Modules whose code makes forecasts; what they import counts too."""

SEED = 0
"""The same in all forecasts of a campaign: member k draws the same errors in each, as its tests share them."""

LEAST_MEMBERS = 2

SPREAD = ("restitution", "restitution_freedom", "critical_angle", "p", "correlations")
"""Of an `Uncertainty`, what is known of the specimen."""


@dataclass(frozen=True)
class Forecast:
    """A forecast, and its file."""

    path: Path
    forecast: ForecastFile


def foresee(
    campaign: Path | str,
    *,
    motion: str,
    levels: Sequence[str],
    specimen: str | None = None,
    test: str | None = None,
    time_scale: float | None = None,
    results: Path | str | None = None,
    progress: Counted = lambda done, total: None,
) -> list[Forecast]:
    """
    Forecast what a specimen does on a base motion, with what is known so far.

    Parameters
    ----------
    campaign : Path or str
        A campaign.toml or its folder.
    motion : str
        See `motion_asked_for`.
    levels : sequence of str
        See `level_of`; of a test one.
    specimen : str, optional
        Default: that of the test, or the only one.
    test : str, optional
        Id of the test that the forecasts are for.
    time_scale : float, optional
        Factor on the motion's own time; default that of the test, else 1.
    results : Path or str, optional
        Folder that holds `processed` and `forecasts`.
    progress : callable, optional
        Called with the number of forecasts that are done and their total.

    Returns
    -------
    forecasts : list of Forecast
        One a level, in their order. Nothing is written before all levels are found valid.

    Raises
    ------
    CampaignError
        If the campaign or an argument is not usable.
    StoreError
        If a file cannot be written.
    """
    loaded = load(Path(campaign))
    layout = Layout.of(loaded.path, results)
    own = _test(loaded, test)
    name = one_specimen(loaded, specimen or (None if own is None else own.specimen))
    if own is not None and own.specimen != name:
        raise CampaignError(f"{own.id} is a test of {own.specimen}, not of {name}.")
    if time_scale is not None and (expected := outside(time_scale, PLAIN)):
        raise CampaignError(f"--time-scale {time_scale:g}: {expected}")
    asked = motion_asked_for(loaded, layout, motion, own, time_scale)
    wanted = {text.strip(): level_of(text, asked) for text in levels}
    if own is not None and len(wanted) > 1:
        raise CampaignError(f"{len(wanted)} levels were found. A forecast of a test, here of {own.id}, has one level.")
    catalogue = Catalogue(layout)
    setup = own or asked.test
    tilt = (loaded.setups[setup.setup].table_tilt or 0.0) if setup is not None else 0.0
    if loaded.processing.predict.ensemble.members < LEAST_MEMBERS:
        raise CampaignError(f"processing.predict.ensemble.members: a forecast needs at least {LEAST_MEMBERS} members.")
    inputs, models = inputs_of(loaded, layout, name, tilt), _models(loaded)
    code, there, found = catalogue.code(MADE_BY), _raw_files(loaded, layout, catalogue, own), []
    for number, (level, factor) in enumerate(wanted.items(), 1):
        expect_none()
        moved = Motion(factor * asked.motion.acceleration, asked.motion.dt)
        forecast = ForecastFile(
            made=datetime.now(UTC).replace(microsecond=0),
            colonnade=colonnade.__version__,
            code=code,
            test=None if own is None else own.id,
            specimen=name,
            level=level,
            motion=_described(asked, moved),
            table=_table(moved),
            inputs=inputs,
            models={model: _by_model(inputs, model, moved) for model in models},
            raw_files=there,
        )
        found.append(Forecast(write_forecast(layout, forecast), forecast))
        progress(number, len(wanted))
    return found


def _described(asked: AskedMotion, moved: Motion) -> ForecastMotion:
    return ForecastMotion(
        name=asked.name,
        source=asked.source,
        sha256=hashlib.sha256(moved.acceleration.astype("<f8").tobytes()).hexdigest(),
        interval=moved.dt,
        samples=moved.acceleration.size,
        time_scale=asked.time_scale,
    )


def _models(campaign: Campaign) -> list[str]:
    models = [model for model in campaign.processing.predict.models if not MODELS[model].in_space]
    if not models:
        raise CampaignError(
            "processing.predict.models: forecasts need a model in the plane, linear or nonlinear, among them."
        )
    return models


def _test(campaign: Campaign, name: str | None) -> Test | None:
    if name is None:
        return None
    expect_known(campaign, "test", [name], " A test that has yet to be run is entered with planned = true.")
    test = campaign.tests[name]
    if test.kind in (*WITHOUT_PREDICTION, "free-vibration"):
        raise CampaignError(f"{name} is a {test.kind} test. Forecasts are of tests on a moving table.")
    return test


def inputs_of(campaign: Campaign, layout: Layout, specimen: str, tilt: float) -> ForecastInputs:
    """Put together what a forecast of a specimen runs the models with, on a table of this tilt (rad)."""
    from colonnade.stages.predict import sides
    from colonnade.stages.specimen import centre, spread_of

    pooled, settings = restitution_taken(campaign, layout, specimen), campaign.ensemble_settings(specimen)
    block = campaign.block(specimen)
    spread = spread_of(pooled, settings)
    negative, positive = sides(pooled)
    ends = {name: float(pooled[f"restitution_{name}"]) for name in ("low", "high")}
    return ForecastInputs(
        block=ForecastBlock.of(centre(pooled, block)),
        restitution=ForecastRestitution(
            value=(max(negative, 0.0), max(positive, 0.0)),
            **{name: min(max(end, 0.0), 1.0) if np.isfinite(end) else None for name, end in ends.items()},
            level=float(pooled["level"]),
            source=pooled.attrs["restitution_source"],
            rigid_body=(block.restitution, block.restitution),
        ),
        spread=ForecastSpread(
            **{name: getattr(spread, name) for name in SPREAD},
            gain=settings.gain,
            clock=settings.clock,
        ),
        table_tilt=tilt,
        rest_angle=campaign.processing.predict.rest_angle,
        members=max(settings.members, LEAST_MEMBERS),
        seed=SEED,
    )


def _raw_files(campaign: Campaign, layout: Layout, catalogue: Catalogue, test: Test | None) -> dict[str, str]:
    """List the raw files that are there, and those that a stored result of the test was made from."""
    found: dict[str, str] = {}
    if test is not None:
        stored = stored_attributes(layout.stage(test.id, "ingest"))
        names, digests = (np.atleast_1d(stored.get(key, [])).tolist() for key in ("raw_files", "raw_sha256"))
        found |= {name: digest for name, digest in zip(names, digests, strict=False) if digest}
    for each in campaign.tests.values():
        looked_at = raw_files(campaign, each, catalogue)
        found |= {name: file.sha256 for name, file in looked_at.items() if file.sha256 is not None}
    return dict(sorted(found.items()))


def _table(motion: Motion) -> ForecastTable:
    from colonnade.assessment.measures import table_measures

    measured, drift = table_measures(motion.acceleration, motion.dt)
    return ForecastTable(
        peak_acceleration=motion.peak,
        peak_velocity=_known(measured["pgv"]),
        peak_displacement=_known(measured["pgd"]),
        drift=drift,
    )


def _by_model(inputs: ForecastInputs, model: str, motion: Motion) -> ModelForecast:
    from colonnade.identification.calibration import BANDS
    from colonnade.identification.forecasts import OUTCOMES, forecast_of
    from colonnade.stages.forecast import felt, plan_of

    shaken = felt(inputs, motion)
    plan = plan_of(inputs, model, shaken)
    members = plan.run()
    expected = forecast_of(members.peak_ratio, members.overturning_time)
    shares = {
        outcome.replace("-", "_"): float(np.mean(expected.outcomes == place)) for place, outcome in enumerate(OUTCOMES)
    }
    half, most, widest = (_band(expected.amplitudes, band) for band in BANDS)
    return ModelForecast(
        **shares,
        bands=(half, most, widest),
        required_friction=_friction(plan.central(), shaken),
        peak_ratio=_peaks(members),
        rigid_body_peak_ratio=_peaks(plan_of(inputs, model, shaken, rigid_body=True).run()),
    )


def _band(amplitudes: Array, probability: float) -> ForecastBand:
    ends = [(1 - probability) / 2, (1 + probability) / 2]
    low, high = np.quantile(amplitudes, ends, method="inverted_cdf")
    return ForecastBand(probability=probability, low=float(low), high=float(high))


def _friction(history: History, motion: Motion) -> float | None:
    from colonnade.dynamics.plane.reactions import reactions

    fall = history.overturning_time
    required = reactions(history, motion).required_friction
    return _known(float(np.nanmax(required[history.time <= (fall if np.isfinite(fall) else np.inf)])))


def _peaks(members: Ensemble) -> tuple[float | None, ...]:
    stands = ~np.isfinite(members.overturning_time)
    return tuple(float(peak) if stood else None for peak, stood in zip(members.peak_ratio, stands, strict=True))


def _known(value: float) -> float | None:
    return value if np.isfinite(value) else None
