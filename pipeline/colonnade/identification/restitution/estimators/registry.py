"""Every estimator of e, in the order in which results are given."""

from __future__ import annotations

from typing import Any

from colonnade.identification.restitution.estimators.estimator import Estimator
from colonnade.identification.restitution.estimators.history import LinearHistory, NonlinearHistory
from colonnade.identification.restitution.estimators.history_scatter import ScatteredHistory
from colonnade.identification.restitution.estimators.impact_by_impact import ImpactByImpact
from colonnade.identification.restitution.estimators.peaks import PeakDecay

ESTIMATORS: dict[str, Estimator[Any]] = {
    each.name: each
    for each in (
        PeakDecay(),
        ImpactByImpact(),
        LinearHistory(),
        NonlinearHistory(),
        ScatteredHistory(),
    )
}
"""By name."""

CANDIDATES = sorted((each for each in ESTIMATORS.values() if each.priority), key=lambda each: each.priority)
"""Estimators that may be recommended, the preferred one first."""
