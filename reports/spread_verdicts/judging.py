"""How often the verdict is right, and how often it finds what is wrong."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from scipy import stats

from colonnade.identification.response.rank import WITHIN, is_within
from spread_verdicts.trial import Trial


def judge(true: Sequence[Trial], wrong: Sequence[Trial], members: int) -> dict[str, Any]:
    """
    Count verdicts.

    Parameters
    ----------
    true, wrong : sequence of Trial
        Around the true e, and around a wrong one.
    members : int
        Runs of each ensemble.

    Returns
    -------
    counted : dict
        `judged` tests around the true e; `within`, their share within the spread, its `nominal` value, and the interval
        that holds 95 % of such shares if the verdict is exact (`low`, `high`); `found`, the share of the tests around
        the wrong e that is outside; `horizon`, the mean predicted share of the records; `overturned`, tests.
    """
    ranks = [trial.rank for trial in true if np.isfinite(trial.rank)]
    nominal = (np.floor(WITHIN * members) + 1) / (members + 1)
    low, high = stats.binom.interval(0.95, len(ranks), nominal)
    return {
        "judged": len(ranks),
        "within": round(float(np.mean([is_within(rank) for rank in ranks])), 4),
        "nominal": round(float(nominal), 4),
        "low": round(low / len(ranks), 4),
        "high": round(high / len(ranks), 4),
        "found": round(float(np.mean([not is_within(each.rank) for each in wrong if np.isfinite(each.rank)])), 4),
        "horizon": round(float(np.nanmean([trial.horizon for trial in true])), 3),
        "overturned": sum(trial.outcome == "overturned" for trial in true),
    }
