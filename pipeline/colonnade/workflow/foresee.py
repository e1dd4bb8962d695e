"""Forecasts of a specimen on one base motion at several levels, with what is known so far, each kept in its file."""

from __future__ import annotations

import hashlib
import re
from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

import colonnade
from colonnade.campaign import Campaign, Test
from colonnade.campaign.forms import forecast as forms
from colonnade.campaign.syntax.fields import PLAIN, PositiveNumber, Quantity, Several, Text, outside
from colonnade.campaign.syntax.table import Problems, Table
from colonnade.dynamics.models import PLANE_MODELS
from colonnade.dynamics.motion import Motion
from colonnade.errors import CampaignError
from colonnade.interruption import expect_none
from colonnade.store.forecasts import write_forecast
from colonnade.store.layout import Layout
from colonnade.store.results import WITHOUT_PREDICTION
from colonnade.workflow.asked import AskedMotion, motion_asked_for
from colonnade.workflow.graph import Graph, expect_known, one_specimen, restitution_taken
from colonnade.workflow.product import Catalogue, stored_attributes

if TYPE_CHECKING:
    from colonnade.dynamics.history import History

MADE_BY = ("colonnade.workflow.foresee", "colonnade.workflow.asked", "colonnade.stages.forecast")
"""Modules whose code makes forecasts; what they import counts too."""

SEED = 0
"""The same in all forecasts of a campaign: member k draws the same errors in each, as its tests share them."""

LEAST_MEMBERS = 2
"""Of a forecast, however few an ensemble has: their spread is what it says."""

_FACTOR = re.compile(r"\s*([0-9]*\.?[0-9]+(?:[eE][-+]?[0-9]+)?)\s*[x×]\s*", re.IGNORECASE)


class AskedForecast(Table):
    """What a forecast is asked for with."""

    motion: Text
    """A test that recorded it, a motion that tests name, one of [motions], or a file."""
    levels: Several
    """Peak acceleration of the table, "0.3 g", or a factor on a recorded motion, 1.5x; with --test one."""
    specimen: str | None = None
    """The specimen; needed if there are several and nothing else names it."""
    test: str | None = None
    """The test that the forecast is for, such as one with planned = true."""
    time_scale: PositiveNumber | None = None
    """On the motion's own time; by default that of the test, else 1."""

    def contradictions(self) -> Problems:
        """Say that a test has one level."""
        if self.test is not None and len(self.levels) > 1:
            yield ("levels",), f"{len(self.levels)} were found. A forecast of a test, here of {self.test}, has one."


def foresee(campaign: Campaign, layout: Layout, asked: AskedForecast) -> dict[Path, forms.ForecastFile]:
    """
    Forecast what a specimen does on a base motion, with what is known so far.

    Parameters
    ----------
    campaign : Campaign
    layout : Layout
    asked : AskedForecast

    Returns
    -------
    forecasts : dict of Path to ForecastFile
        By their files, one a level, in their order. Nothing is written before all levels are found valid.

    Raises
    ------
    CampaignError
        If something that is asked for is not usable.
    StoreError
        If a file cannot be written.
    """
    own = None if asked.test is None else _test(campaign, asked.test)
    name = one_specimen(campaign, asked.specimen or (None if own is None else own.specimen))
    if own is not None and own.specimen != name:
        raise CampaignError(f"{own.id} is a test of {own.specimen}, not of {name}.")
    base = motion_asked_for(asked.motion, campaign, layout, by_shape=True)
    time_scale = asked.time_scale or _time_scale(own, base.test)
    factors = {level: factor_of(level, base) for level in asked.levels}
    setup = own or base.test
    tilt = (campaign.setups[setup.setup].table_tilt or 0.0) if setup is not None else 0.0
    models = [model for model in campaign.processing.predict.models if model in PLANE_MODELS]
    if not models:
        raise CampaignError(
            "processing.predict.models: forecasts need a model in the plane, linear or nonlinear, among them."
        )
    inputs, catalogue = inputs_of(campaign, layout, name, tilt), Catalogue(layout)
    code, there = catalogue.code(MADE_BY), _raw_files(campaign, layout, catalogue, own)
    found: dict[Path, forms.ForecastFile] = {}
    for level, factor in factors.items():
        expect_none()
        moved = Motion(factor * base.motion.acceleration, base.motion.dt * time_scale)
        forecast = forms.ForecastFile(
            made=datetime.now(UTC).replace(microsecond=0),
            colonnade=colonnade.__version__,
            code=code,
            test=asked.test,
            specimen=name,
            level=level,
            motion=forms.ForecastMotion(
                name=asked.motion,
                source=base.source,
                sha256=hashlib.sha256(moved.acceleration.astype("<f8").tobytes()).hexdigest(),
                interval=moved.dt,
                samples=moved.acceleration.size,
                time_scale=time_scale,
            ),
            table=_table(moved),
            inputs=inputs,
            models={model: _by_model(inputs, model, moved) for model in models},
            raw_files=there,
        )
        found[write_forecast(layout, forecast)] = forecast
    return found


def factor_of(level: str, base: AskedMotion) -> float:
    """
    Read a level: give what the motion is multiplied by.

    Parameters
    ----------
    level : str
        A peak acceleration with its unit, "0.3 g", or a factor on a recorded motion, "1.5x".
    base : AskedMotion

    Raises
    ------
    CampaignError
        If it is neither, out of its range, or a factor on a motion of which only the shape counts.
    """
    found = _FACTOR.fullmatch(level)
    if found and base.is_shape:
        raise CampaignError(
            f'--level {level}: only the shape of "{base.name}" counts ({base.source}), so a factor on it says '
            'nothing. Give the peak acceleration, such as "0.3 g".'
        )
    if found and (expected := outside(float(found[1]), PLAIN)):
        raise CampaignError(f"--level {level}: {expected}")
    if found:
        return float(found[1])
    try:
        return base.factor_to(Quantity("acceleration").take(level))
    except ValueError as error:
        raise CampaignError(f'--level {level}: {error} Or a factor on a recorded motion, such as "1.5x".') from None


def _time_scale(test: Test | None, recorded: Test | None) -> float:
    """Factor on the time of a motion for a test: its own, over that of the test in which the motion was recorded."""
    wanted = None if test is None else test.time_scale
    own = 1.0 if recorded is None else recorded.time_scale
    return wanted / own if wanted is not None and own is not None else 1.0


def _test(campaign: Campaign, name: str) -> Test:
    expect_known(campaign, "test", [name], " A test that has yet to be run is entered with planned = true.")
    test = campaign.tests[name]
    if test.kind in (*WITHOUT_PREDICTION, "free-vibration"):
        raise CampaignError(f"{name} is a {test.kind} test. Forecasts are of tests on a moving table.")
    return test


def inputs_of(campaign: Campaign, layout: Layout, specimen: str, tilt: float) -> forms.ForecastInputs:
    """Put together what a forecast of a specimen runs the models with, on a table of this tilt (rad)."""
    from colonnade.stages.predict import sides
    from colonnade.stages.specimen import centre, spread_of

    pooled, settings = restitution_taken(campaign, layout, specimen), campaign.ensemble_settings(specimen)
    block = campaign.block(specimen)
    spread = replace(spread_of(pooled, settings), gain=settings.gain, clock=settings.clock)
    ends = {name: float(pooled[f"restitution_{name}"]) for name in ("low", "high")}
    return forms.ForecastInputs(
        block=forms.ForecastBlock.of(centre(pooled, block)),
        restitution=forms.ForecastRestitution(
            value=sides(pooled),
            **{name: min(max(end, 0.0), 1.0) if np.isfinite(end) else None for name, end in ends.items()},
            level=float(pooled["level"]),
            source=pooled.attrs["restitution_source"],
            rigid_body=(block.restitution, block.restitution),
        ),
        spread=forms.ForecastSpread.model_validate(spread, from_attributes=True),
        table_tilt=tilt,
        rest_angle=campaign.processing.predict.rest_angle,
        members=max(settings.members, LEAST_MEMBERS),
        seed=SEED,
    )


def _raw_files(campaign: Campaign, layout: Layout, catalogue: Catalogue, test: Test | None) -> dict[str, str]:
    """List the raw files that are there, and those that a stored result of the test was made from."""
    graph, found = Graph(campaign, layout, catalogue), dict[str, str]()
    if test is not None:
        stored = stored_attributes(layout.stage(test.id, "ingest"))
        names, digests = (np.atleast_1d(stored.get(key, [])).tolist() for key in ("raw_files", "raw_sha256"))
        found |= {name: digest for name, digest in zip(names, digests, strict=False) if digest}
    for each in campaign.tests.values():
        looked_at = graph.raw(each)
        found |= {name: file.sha256 for name, file in looked_at.items() if file.sha256 is not None}
    return dict(sorted(found.items()))


def _table(motion: Motion) -> forms.ForecastTable:
    from colonnade.assessment.measures import table_measures

    measured, drift = table_measures(motion.acceleration, motion.dt)
    return forms.ForecastTable(
        peak_acceleration=motion.peak,
        peak_velocity=_known(measured["pgv"]),
        peak_displacement=_known(measured["pgd"]),
        drift=drift,
    )


def _by_model(inputs: forms.ForecastInputs, model: str, motion: Motion) -> forms.ModelForecast:
    from colonnade.identification.forecasts import BANDS, OUTCOMES, forecast_of
    from colonnade.stages.forecast import felt, plan_of

    shaken = felt(inputs, motion)
    plan, reference = plan_of(inputs, model, shaken), plan_of(inputs, model, shaken, rigid_body=True)
    peaks = plan.run().peak_ratio
    expected = forecast_of(peaks)
    shares = {
        outcome.replace("-", "_"): float(np.mean(expected.outcomes == place)) for place, outcome in enumerate(OUTCOMES)
    }
    ends = [((1 - share) / 2, (1 + share) / 2) for share in BANDS]
    bands = np.quantile(expected.amplitudes, ends, method="inverted_cdf").tolist()
    half, most, widest = (
        forms.ForecastBand(probability=share, low=low, high=high)
        for share, (low, high) in zip(BANDS, bands, strict=True)
    )
    return forms.ModelForecast(
        **shares,
        bands=(half, most, widest),
        required_friction=_friction(plan.central(), shaken),
        peak_ratio=tuple(map(_known, peaks.tolist())),
        rigid_body_peak_ratio=tuple(map(_known, reference.run().peak_ratio.tolist())),
    )


def _friction(history: History, motion: Motion) -> float | None:
    from colonnade.dynamics.plane.reactions import reactions

    required, has_fallen = reactions(history, motion).required_friction, history.time > history.overturning_time
    return _known(float(np.nanmax(required[~has_fallen])))


def _known(value: float) -> float | None:
    return value if np.isfinite(value) else None
