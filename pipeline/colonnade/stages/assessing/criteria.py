"""Criteria of practice against the computed outcomes of an assessment."""

from __future__ import annotations

import numpy as np

from colonnade.arrays import Array
from colonnade.assessment.cases import Outcomes, in_plane
from colonnade.assessment.criteria import CRITERIA, Demands, agreement, spectral_velocity
from colonnade.assessment.ground import Ground
from colonnade.assessment.study import Study
from colonnade.campaign.assessing.assessed import JudgedCriterion


def judged_criteria(
    study: Study, outcomes: Outcomes, *, drift: float, overturned: float
) -> tuple[JudgedCriterion, ...]:
    """
    Compare what each criterion says of every scaled motion with what the column does, nothing varied.

    Parameters
    ----------
    study : Study
    outcomes : Outcomes
        Of its cases; the first draw has nothing varied.
    drift : float
        Up to which a record has a velocity.
    overturned : float
        As of `judge`.
    """
    run = np.asarray(outcomes.is_run[:, :, 0].any(axis=2))
    happened = {
        # However little: what is called rocking elsewhere begins at a thousandth of α.
        "rocking": np.asarray(outcomes.exceeds(np.finfo(np.float64).tiny)[:, :, 0].any(axis=2))[run],
        "overturning": np.asarray(outcomes.exceeds(overturned)[:, :, 0].any(axis=2))[run],
    }
    recorded = _recorded(study, drift)
    demands = Demands(*((each[:, None, :] * study.cases.factors)[run] for each in recorded))
    block = study.cases.prototype.block
    return tuple(
        JudgedCriterion(
            criterion=criterion.id, **agreement(criterion.ratio(block, demands), happened[criterion.predicts])
        )
        for criterion in CRITERIA
    )


def _recorded(study: Study, drift: float) -> tuple[Array, Array, Array]:
    """Peak acceleration, peak velocity and level of the velocity spectrum of each record and component."""
    found = np.full((3, *study.cases.factors.shape[::2]), np.nan)
    for record, motion in enumerate(study.cases.motions):
        for place in range(found.shape[2]):
            along = in_plane(motion, place, 1.0)
            if along is None:
                continue
            ground = Ground(along.acceleration, along.dt)
            velocity = float(np.abs(ground.velocity).max()) if ground.drift <= drift else np.nan
            found[:, record, place] = along.peak, velocity, spectral_velocity(along.acceleration, along.dt)
    return found[0], found[1], found[2]
