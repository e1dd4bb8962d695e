"""What the forecasts of all campaigns are worth: scores, skill, reliability and coverage."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict
from typing import Any

import numpy as np

from colonnade.identification.verification.calibration import coverage, randomised_pit
from colonnade.identification.verification.references import base_rates, score_difference, skill
from colonnade.identification.verification.reliability import reliability
from colonnade.identification.verification.responses import Forecast
from colonnade.identification.verification.scores import score
from forecasts.campaign import FORECASTS, Campaign

MAIN = "crps"
"""Score that decides, chosen before any result."""

BASE_RATE = "base rate"


def judge(campaigns: Sequence[Campaign]) -> dict[str, Any]:
    """
    Judge all forecasts.

    Returns
    -------
    found : dict
        `tests` with their number, `undecided` (overturning probability between 0 and 1) and outcomes; by forecast its
        mean `scores`, and the `difference` of each from the identified e with its interval; `skill` of the identified
        e over rigid-body e and base rate, by score; `reliability` and `coverage` of identified and wrong e.
    """
    tests = [test for campaign in campaigns for test in campaign.tests]
    number = np.repeat(np.arange(len(campaigns)), [len(campaign.tests) for campaign in campaigns])
    observed = [test.observed for test in tests]
    forecasts = {name: [test.forecasts[name] for test in tests] for name in tests[0].forecasts}
    by_name: dict[str, list[Forecast]] = forecasts | {
        BASE_RATE: [each for one in campaigns for each in base_rates([test.observed for test in one.tests])]
    }
    scores = {
        name: [asdict(score(*pair)) for pair in zip(made, observed, strict=True)] for name, made in by_name.items()
    }
    columns = {name: {key: np.array([row[key] for row in rows]) for key in rows[0]} for name, rows in scores.items()}
    own = columns["identified"]
    others = [name for name in columns if name != "identified"]
    probability = np.array([each.overturning_probability for each in forecasts["identified"]])
    return {
        "tests": {
            "count": len(tests),
            "undecided": int(np.sum((probability > 0) & (probability < 1))),
            "outcomes": np.bincount([each.outcome for each in observed], minlength=3).tolist(),
        },
        "scores": {
            name: {key: float(values.mean()) for key, values in column.items()} for name, column in columns.items()
        },
        "difference": {
            name: {key: asdict(score_difference(columns[name][key], own[key], number)) for key in own}
            for name in others
        },
        "skill": {name: {key: skill(own[key], columns[name][key]) for key in own} for name in others},
        "reliability": {name: _plain(reliability(forecasts[name], observed, number)) for name in FORECASTS},
        "coverage": {
            name: _plain(coverage(randomised_pit(forecasts[name], observed), forecasts[name], number))
            for name in FORECASTS
        },
        "pit": {name: randomised_pit(forecasts[name], observed).round(4).tolist() for name in FORECASTS},
    }


def _plain(result: Any) -> dict[str, Any]:
    return {
        name: value.round(4).tolist() if isinstance(value, np.ndarray) else value
        for name, value in vars(result).items()
    }
