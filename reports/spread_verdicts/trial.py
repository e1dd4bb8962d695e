"""One test through the stages that a campaign's tests go through, up to the verdict."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import xarray as xr

from colonnade import campaign as campaigns
from colonnade.campaign import Campaign, Test
from colonnade.dynamics.ensembles.uncertainty import Uncertainty
from colonnade.errors import StageError
from colonnade.stages import condition as conditioning
from colonnade.stages import ensemble as running
from colonnade.stages import ingest as ingesting
from colonnade.stages import restitution as identifying
from colonnade.stages import rocking as rocking_stage
from colonnade.stages.parts.rank import horizons_and_ranks
from spread_verdicts.design import RESTITUTION_ERROR, campaign_text, draw

MODEL = "nonlinear"


@dataclass(frozen=True)
class Trial:
    """
    What became of one test.

    Attributes
    ----------
    kind, outcome : str
        Of its motion; of the truth.
    rank : float
        As `within_spread`; NaN if there was nothing to judge.
    horizon : float
        Predicted share of the record.
    """

    kind: str
    outcome: str
    rank: float
    horizon: float


def run(seed: int, number: int, wrong: float, members: int) -> Trial:
    """
    Draw a test, and judge it by an ensemble around an e that is wrong by so much.

    Parameters
    ----------
    seed, number : int
        As of `draw`.
    wrong : float
        What is added to e, downwards in every other round of the kinds of motion.
    members : int
        Runs of the ensemble.
    """
    campaign = _campaign()
    settings = campaign.processing.predict.ensemble
    uncertainty = Uncertainty(
        restitution=RESTITUTION_ERROR,
        critical_angle=settings.critical_angle,
        p=settings.p,
        gain=settings.gain,
        clock=settings.clock,
    )
    drawn = draw(seed, number, uncertainty, angle_gain=settings.angle_gain, angle_zero=settings.angle_zero)
    test = campaign.tests[f"{drawn.specimen}-{drawn.kind}"]
    recorded = ingesting.ingest({"main": drawn.recording}, ingesting.IngestInputs.of(campaign, test))
    ready = conditioning.condition(recorded, conditioning.ConditionInputs.of(campaign, test))
    rocked = rocking_stage.rocking(ready, rocking_stage.RockingInputs.of(campaign, test))
    e = drawn.restitution + wrong * (-1) ** (number // 4)
    read = running.EnsembleInputs.of(campaign, test, MODEL)
    changed = {"members": members, "restitution": RESTITUTION_ERROR}
    read = read.model_copy(update={"settings": read.settings.model_copy(update=changed)})
    try:
        bands = running.ensemble(ready, rocked, _specimen(e), read, _identified(rocked, campaign, test))
    except StageError:
        return Trial(drawn.kind, drawn.outcome, np.nan, np.nan)
    compared = horizons_and_ranks(rocked, {MODEL: bands}, [MODEL], drawn.block)
    time = bands["elapsed"].to_numpy()
    predicted = (float(compared["horizon"][1][0]) - time[0]) / (time[-1] - time[0])
    return Trial(drawn.kind, drawn.outcome, float(compared["within_spread"][1][0]), float(predicted))


def _identified(rocked: xr.Dataset, campaign: Campaign, test: Test) -> xr.Dataset | None:
    """Identify a free vibration, for its zero offset: one that still rocks as its record ends has a wrong zero."""
    if test.kind != "free-vibration":
        return None
    return identifying.restitution(rocked, identifying.RestitutionInputs.of(campaign, test))


def _specimen(restitution: float) -> xr.Dataset:
    """Restitution of a specimen as a campaign file gives it: `RESTITUTION_ERROR` is its standard deviation."""
    return xr.Dataset(
        {"restitution": restitution, "side_restitution": ("side", [restitution, restitution])},
        attrs={"restitution_source": "given"},
    )


@lru_cache(maxsize=1)
def _campaign() -> Campaign:
    with TemporaryDirectory() as folder:
        path = Path(folder) / "campaign.toml"
        path.write_text(campaign_text(), encoding="utf-8")
        return campaigns.load(path)
