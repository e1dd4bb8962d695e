"""One virtual campaign: its tests, what was truly observed, and forecasts of each."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from colonnade.dynamics.ensembles.ensemble import ensemble
from colonnade.dynamics.ensembles.uncertainty import MotionDraws, Uncertainty
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.rock import rock
from colonnade.identification.verification.responses import Forecast, Response, forecast_of
from forecasts.design import KINDS, SCATTER, Specimen, draw_motion, draw_specimen

MODEL = "nonlinear"

WRONG = 0.01
"""Error of e in the forecasts that have to be found wrong, up and down."""

FORECASTS = {"identified": 0.0, "too high": WRONG, "too low": -WRONG}
"""What is added to the identified e. The last forecast, "rigid", uses e of a rigid body, without a scatter of e."""

RIGID = "rigid"

LEVELS = np.geomspace(1.0, 8.0, 16)
"""Largest accelerations that are tried, over that of uplift."""

PILOTS = 6
"""Runs at each of them."""

CLEAR = (0.6, 1.3)
"""Range of the level of one test in `EVERY`, whatever it is predicted to do."""

EVERY = 5


@dataclass(frozen=True)
class Tried:
    """
    A test.

    Attributes
    ----------
    kind : str
    level : float
        Largest acceleration over that of uplift.
    observed : Response
    forecasts : dict of str to Forecast
    """

    kind: str
    level: float
    observed: Response
    forecasts: dict[str, Forecast]


@dataclass(frozen=True)
class Campaign:
    """Specimen and tests."""

    specimen: Specimen
    tests: list[Tried]


def run_campaign(seed: int, number: int, tests: int, members: int) -> Campaign:
    """Draw the `number`-th campaign of a study with so many tests, and forecast each by so many members."""
    specimen = draw_specimen(np.random.default_rng((seed, number)))
    return Campaign(specimen, [_test(specimen, (seed, number, test), members) for test in range(tests)])


def _test(specimen: Specimen, place: tuple[int, int, int], members: int) -> Tried:
    random = np.random.default_rng(place)
    kind = KINDS[place[-1] % len(KINDS)]
    unit = draw_motion(kind, specimen.block, random)
    low, high = CLEAR if place[-1] % EVERY == EVERY - 1 else _undecided(specimen, unit, random)
    level = float(np.exp(random.uniform(np.log(low), np.log(high))))
    motion = _scaled(specimen, unit, level)
    forecasts = {
        name: _forecast(specimen, motion, specimen.identified.value + wrong, specimen.uncertainty, members)
        for name, wrong in FORECASTS.items()
    }
    rigid = replace(specimen.uncertainty, restitution=0.0)
    forecasts[RIGID] = _forecast(specimen, motion, specimen.block.restitution, rigid, members)
    return Tried(kind, level, _observe(specimen, motion, random), forecasts)


def _observe(specimen: Specimen, motion: Motion, random: np.random.Generator) -> Response:
    """Run the true specimen on what truly was the motion, given the recorded one."""
    known = specimen.uncertainty
    true = MotionDraws(motion, known).draw(
        random, gain=specimen.gain, clock=float(np.exp(known.clock * random.standard_normal())), cutoff=1.0
    )
    restitution = specimen.true_restitution + SCATTER * random.standard_normal()
    history = rock(specimen.true_block, true, restitution=restitution, model=MODEL)
    return Response.observed(history.outcome, history.peak_ratio)


def _forecast(
    specimen: Specimen, motion: Motion, restitution: float, uncertainty: Uncertainty, members: int
) -> Forecast:
    found = ensemble(
        specimen.block, motion, restitution=restitution, uncertainty=uncertainty, count=members, model=MODEL
    )
    return forecast_of(found.peak_ratio, found.overturning_time)


def _undecided(specimen: Specimen, unit: Motion, random: np.random.Generator) -> tuple[float, float]:
    """
    Range of one step about one of `LEVELS` between the predicted limits: some pilot runs overturn there and some stand.

    If there is none, it is the step that ends where all pilot runs overturn, or the last one.
    """
    shares = np.array([_pilot(specimen, unit, level) for level in LEVELS])
    undecided = np.flatnonzero((shares > 0) & (shares < 1))
    certain = np.flatnonzero(shares == 1)
    step = np.sqrt(LEVELS[1] / LEVELS[0])
    between = LEVELS[certain[0] if certain.size else -1] / step
    level = LEVELS[random.choice(undecided)] if undecided.size else between
    return level / step, level * step


def _pilot(specimen: Specimen, unit: Motion, level: float) -> float:
    motion = _scaled(specimen, unit, level)
    return _forecast(specimen, motion, specimen.identified.value, specimen.uncertainty, PILOTS).overturning_probability


def _scaled(specimen: Specimen, unit: Motion, level: float) -> Motion:
    return Motion(unit.acceleration * level * specimen.block.uplift_acceleration, unit.dt)
