"""Trials of the study of the verdict: random tests whose truth is known, through the stages up to the verdict."""

from __future__ import annotations

import itertools
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import xarray as xr
from scipy import signal

from colonnade import campaign as campaigns
from colonnade.arrays import Array
from colonnade.campaign import Campaign, Test
from colonnade.dynamics.block import Block
from colonnade.dynamics.kinematics import point_displacement
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.rock import rock
from colonnade.dynamics.uncertainty import INPUTS, Uncertainty, draw_inputs, member_block, member_restitution
from colonnade.errors import StageError
from colonnade.readers.recording import RecordedChannel, Recording
from colonnade.stages import condition as conditioning
from colonnade.stages import ensemble as running
from colonnade.stages import ingest as ingesting
from colonnade.stages import restitution as identifying
from colonnade.stages import rocking as rocking_stage

KINDS = ("noise", "sine", "pulse", "free-vibration")
"""Motions, in turn: bands of random noise, sines, single sine pulses, and a release without any motion."""

HEIGHTS = {"small": 0.3, "middle": 0.6, "large": 1.5}
"""Of the prisms, m."""

SLENDERNESS = 5.0
RESTITUTION = (0.86, 0.97)
"""Range of e."""

RESTITUTION_ERROR = 0.002
"""Standard deviation of the identified e, as its interval says."""

RATE = 250.0
"""Samples a second."""

DURATION = 12.0
"""s."""

FINER = 4
"""Steps of the true motion in a sampling interval of the record."""

ACCELEROMETER_NOISE = 0.01
"""m/s², before the low-pass."""

TRANSDUCER_NOISE = 1e-4
"""Of the displacement of the upper transducer at α, before the low-pass."""

GRAVITY = 9.81

DISPLACEMENT = 'quantity = "displacement", unit = "m", on = "specimen", direction = [1, 0, 0], relative_to = "table"'
ACCELERATION = 'column = "TABLE", quantity = "acceleration", unit = "m/s^2", on = "table", direction = [1, 0, 0]'


def campaign_text() -> str:
    """Write the campaign file of all specimens and kinds."""
    lines = ["schema = 1", 'campaign = "verdicts"', 'title = "Tests whose truth is known"']
    for name, height in HEIGHTS.items():
        width = height / SLENDERNESS
        size = f'width = "{width} m", depth = "{width} m", height = "{height} m", mass = "100 kg"'
        lines.append(f'specimens.{name} = {{shape = "prism", {size}}}')
        for channel, above in {"top": 0.9 * height, "bottom": 0.05 * height}.items():
            own = f'column = "{channel.upper()}", at = ["{width / 2} m", "0 m", "{above} m"]'
            lines.append(f"setups.{name}.channels.{channel} = {{{own}, {DISPLACEMENT}}}")
        lines.append(f"setups.{name}.channels.table_acceleration = {{{ACCELERATION}}}")
    for name, kind in itertools.product(HEIGHTS, KINDS):
        lines += ["[[tests]]", f'id = "{name}-{kind}"', f'kind = "{kind}"', f'specimen = "{name}"']
        lines += [f'setup = "{name}"', 'file = "none.csv"']
    return "\n".join(lines) + "\n"


@dataclass(frozen=True)
class Draw:
    """
    One test.

    Attributes
    ----------
    specimen, kind : str
    block : Block
        As the campaign has it.
    restitution : float
        As the laboratory has identified it, before any error of the study's own.
    recording : Recording
        What the recorder wrote.
    outcome : str
        Of the truth.
    """

    specimen: str
    kind: str
    block: Block
    restitution: float
    recording: Recording
    outcome: str


def draw(seed: int, number: int, uncertainty: Uncertainty, *, angle_gain: float, angle_zero: float) -> Draw:
    """
    Draw the `number`-th test of a study: a truth that the uncertainty allows, and its record.

    Parameters
    ----------
    seed, number : int
    uncertainty : Uncertainty
        What the true block, motion and clock differ from the known ones by.
    angle_gain, angle_zero : float
        Standard deviations of the calibration (relative) and of the zero (of α) of the displacement transducers.
    """
    random = np.random.default_rng((seed, number))
    kind, name = KINDS[number % len(KINDS)], list(HEIGHTS)[random.integers(len(HEIGHTS))]
    height = HEIGHTS[name]
    width = height / SLENDERNESS
    block = Block.prism(width=width, depth=width, height=height, mass=100.0, gravity=GRAVITY)
    restitution = random.uniform(*RESTITUTION)
    errors = dict(zip(INPUTS, draw_inputs(uncertainty, random).tolist(), strict=True))
    finer = _motion(kind, block, random)
    # The recorder's clock counts 1/RATE between samples that are `clock` times as far apart.
    truth = rock(
        member_block(block, errors["critical_angle"], errors["p"]),
        Motion(finer, errors["clock"] / (FINER * RATE)),
        restitution=member_restitution(restitution, errors["restitution"]),
        model="nonlinear",
        theta0=random.choice([-1, 1]) * random.uniform(0.3, 0.8) * block.critical_angle if kind == KINDS[-1] else 0.0,
    )
    angle = np.clip(truth.angle[::FINER], -1.5 * block.critical_angle, 1.5 * block.critical_angle)
    points = [[width / 2, 0.0, 0.9 * height], [width / 2, 0.0, 0.05 * height]]
    moved = point_displacement(angle, points, block)[..., 0] * np.exp(angle_gain * random.standard_normal())
    # The zero is lost with the first movement: what was read at rest before is taken off.
    lost = angle_zero * block.critical_angle * random.standard_normal() * np.array([[0.9], [0.05]]) * height
    since = int(np.argmax(np.abs(angle) > 1e-6)) if np.any(angle) else angle.size
    moved[:, since:] += lost
    noise = TRANSDUCER_NOISE * 0.9 * height * block.critical_angle
    columns = {
        "TOP": ("m", moved[0] + random.normal(0.0, noise, angle.size)),
        "BOTTOM": ("m", moved[1] + random.normal(0.0, noise, angle.size)),
        "TABLE": ("m/s^2", finer[::FINER] / errors["gain"] + random.normal(0.0, ACCELEROMETER_NOISE, angle.size)),
    }
    time = np.arange(angle.size) / RATE
    channels = tuple(RecordedChannel(column, unit, values, time) for column, (unit, values) in columns.items())
    return Draw(name, kind, block, restitution, Recording(Path("none.csv"), "delimited", channels), truth.outcome)


def _motion(kind: str, block: Block, random: np.random.Generator) -> Array:
    """Base acceleration, m/s², in steps of 1/(FINER · RATE), at rest in the first and the last seconds."""
    time = np.arange(int(DURATION * RATE * FINER)) / (FINER * RATE)
    rocking = block.p / (2 * np.pi)
    ramp = np.clip(np.minimum((time - 1.0) / 0.5, (8.0 - time) / 1.0), 0.0, 1.0)
    if kind == "noise":
        band = signal.butter(4, [1.5 * rocking, 5.0 * rocking], btype="band", fs=FINER * RATE, output="sos")
        shape = signal.sosfilt(band, random.standard_normal(time.size)) * ramp
        shape /= np.abs(shape).max()
        return shape * block.uplift_acceleration * random.uniform(1.2, 3.0)
    frequency = rocking * random.uniform(1.5, 4.0)
    if kind == "sine":
        return ramp * np.sin(2 * np.pi * frequency * time) * block.uplift_acceleration * random.uniform(1.1, 2.5)
    if kind == "pulse":
        lasts = (time >= 1.0) & (time < 1.0 + 1.0 / frequency)
        return (
            lasts * np.sin(2 * np.pi * frequency * (time - 1.0)) * block.uplift_acceleration * random.uniform(1.2, 3.5)
        )
    return np.zeros(time.size)


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
    known = {name: getattr(settings, name) for name in ("critical_angle", "p", "gain", "clock")}
    uncertainty = Uncertainty(restitution=RESTITUTION_ERROR, **known)
    drawn = draw(seed, number, uncertainty, angle_gain=settings.angle_gain, angle_zero=settings.angle_zero)
    test = campaign.tests[f"{drawn.specimen}-{drawn.kind}"]
    recorded = ingesting.ingest({"main": drawn.recording}, ingesting.IngestInputs.of(campaign, test))
    ready = conditioning.condition(recorded, conditioning.ConditionInputs.of(campaign, test))
    rocked = rocking_stage.rocking(ready, rocking_stage.RockingInputs.of(campaign, test))
    e = drawn.restitution + wrong * (-1) ** (number // 4)
    read = running.EnsembleInputs.of(campaign, test, MODEL)
    changed = {"members": members, "restitution": RESTITUTION_ERROR}
    read = read.model_copy(update={"plane": read.plane.model_copy(update=changed)})
    try:
        bands = running.ensemble(rocked, read, _specimen(e), identified=_identified(rocked, campaign, test))
    except StageError:
        return Trial(drawn.kind, drawn.outcome, np.nan, np.nan)
    time = bands["elapsed"].to_numpy()
    predicted = (float(bands["horizon"]) - time[0]) / (time[-1] - time[0])
    return Trial(drawn.kind, drawn.outcome, float(bands.get("within_spread", np.nan)), float(predicted))


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
