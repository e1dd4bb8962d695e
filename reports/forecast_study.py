"""Study of forecasts whose truth is known: `python reports/forecast_study.py [--campaigns N] [--seed N]`."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
import scipy
from joblib import Parallel, delayed
from numpy.typing import ArrayLike

from colonnade.arrays import Array
from colonnade.figures.style import blank_figure, styled
from colonnade.identification.forecasts import Forecast, base_rates, coverage, randomised_pit, score, skill
from forecast_trial import FORECASTS, HEIGHTS, MODEL, PILOTS, RESTITUTION, SCATTER, WRONG, Campaign, run_campaign
from study import Study, table

FEWEST_CAMPAIGNS = 6
"""Of an interval: of fewer no resampling shows how much campaigns differ."""


@dataclass(frozen=True)
class Difference:
    """Mean difference of scores per test, with its interval at `level`."""

    value: float
    low: float
    high: float
    level: float


def score_difference(
    scores: ArrayLike,
    reference: ArrayLike,
    campaigns: ArrayLike,
    *,
    level: float = 0.95,
    resamples: int = 9999,
    seed: int = 0,
) -> Difference:
    """
    Give the mean difference of the scores of two forecasts, and its interval over campaigns.

    Parameters
    ----------
    scores, reference : array_like, shape (n,)
        Of the same tests.
    campaigns : array_like, shape (n,)
        Number of the campaign of each test. Tests of one campaign share its specimens and what is wrong about them.
    level : float, optional
        Of the interval.
    resamples, seed : int, optional
        The same seed gives the same interval.

    Returns
    -------
    difference : Difference
        Of score − reference: below zero if the scores are better than the reference.

    Raises
    ------
    ValueError
        If a score is not finite, the lengths differ, or there are fewer than `FEWEST_CAMPAIGNS` campaigns.

    Notes
    -----
    Bootstrap of whole campaigns (Efron and Tibshirani 1993). Quantiles of few campaigns are too close:
    they are taken as far out as Student's t is for that number of campaigns (Hesterberg 2015).
    """
    own, other = np.asarray(scores), np.asarray(reference)
    groups = np.asarray(campaigns)
    if groups.shape != own.shape:
        raise ValueError(f"campaigns has shape {groups.shape}; {own.shape} was expected, one for each score")
    names, place = np.unique(groups, return_inverse=True)
    if names.size < FEWEST_CAMPAIGNS:
        raise ValueError(f"there are {names.size} campaigns; at least {FEWEST_CAMPAIGNS} were expected for an interval")
    totals, tests = np.bincount(place, weights=own - other), np.bincount(place)
    drawn = np.random.default_rng(seed).integers(names.size, size=(resamples, names.size))
    means = totals[drawn].sum(axis=1) / tests[drawn].sum(axis=1)
    reach = np.sqrt(names.size / (names.size - 1)) * scipy.stats.t.ppf((1 + level) / 2, names.size - 1)
    outside = scipy.stats.norm.sf(reach)
    low, high = np.quantile(means, [outside, 1 - outside])
    return Difference(float(totals.sum() / tests.sum()), float(low), float(high), level)


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
        e over rigid-body e and base rate, by score; `coverage` of identified and wrong e.
    """
    tests = [test for campaign in campaigns for test in campaign.tests]
    number = np.repeat(np.arange(len(campaigns)), [len(campaign.tests) for campaign in campaigns])
    observed = [test.observed for test in tests]
    forecasts = {name: [test.forecasts[name] for test in tests] for name in tests[0].forecasts}
    by_name: dict[str, list[Forecast]] = forecasts | {
        BASE_RATE: [each for one in campaigns for each in base_rates([test.observed for test in one.tests])]
    }
    scores = {name: [score(*pair) for pair in zip(made, observed, strict=True)] for name, made in by_name.items()}
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
        "coverage": {
            name: _plain(coverage(randomised_pit(forecasts[name], observed), forecasts[name], number))
            for name in FORECASTS
        },
        "pit": {name: randomised_pit(forecasts[name], observed).round(4).tolist() for name in FORECASTS},
    }


def _plain(result: dict[str, Array]) -> dict[str, Any]:
    return {name: values.round(4).tolist() for name, values in result.items()}


TEXT = """# Study of forecasts whose truth is known

Made by `make study NAME=forecast` (`python reports/forecast_study.py --campaigns {campaigns} --seed {seed}`).

{campaigns} virtual campaigns with {each} tests each: prisms of {heights} m with a true e of {restitution}.
In each test e differs from it by {scatter} (standard deviation). Each campaign identifies e from three free vibrations
of its own, with an interval. Its tests are synthetic earthquakes, El Centro 1940 and sines, at levels that its own
forecasts leave undecided if there are any (some of {pilots} pilot runs overturn, some stand); one test in five is about
the level of uplift. α, p, gain of the accelerometer, clock and noise are wrong by errors of the default settings.
The truth is the {model} model with all of it. A forecast has {members} members.

{count} tests: {standing} do not rock, {rocking} rock, {overturned} overturn; of {undecided} the forecast is undecided.

## Scores

The main score, chosen before any result, is the CRPS of min(max |θ|, α)/α. The smaller a score, the better.

{scores}

**Main score, e wrong by {wrong:g}: {high_found} if too high, {low_found} if too low**, with 95 % intervals by
resampling of whole campaigns; above zero, the wrong e is found.

Difference from the forecasts with the identified e, per test, with 95 % intervals:

{differences}

Skill of the forecasts with the identified e (1 is perfect, 0 as good as the reference):

{skill}

## Coverage of the amplitude's central bands

Share of the tests in each band; in brackets where 95 % of such shares are if the forecasts are right.

{coverage}

![PIT]({figure})
"""

SCORES = {
    "crps": "CRPS (of α)",
    "ranked_probability": "ranked probability",
    "brier": "Brier",
    "logarithmic": "logarithmic (nats)",
}

NAMES = {
    "identified": "identified e",
    "too high": f"e too high by {WRONG:g}",
    "too low": f"e too low by {WRONG:g}",
    "rigid": "rigid-body e",
    BASE_RATE: "base rate of the campaign",
}


def page(found: dict[str, Any], figure: str) -> str:
    """Write the page."""
    tests, judged = found["tests"], found["judged"]
    outcomes = zip(("standing", "rocking", "overturned"), judged["tests"]["outcomes"], strict=True)
    return TEXT.format(
        **{name: found[name] for name in ("campaigns", "seed", "members", "pilots")},
        each=tests,
        heights=", ".join(f"{height:g}" for height in HEIGHTS),
        restitution="{:.2f} to {:.2f}".format(*RESTITUTION),
        scatter=SCATTER,
        model=MODEL,
        **{name: judged["tests"][name] for name in ("count", "undecided")},
        **dict(outcomes),
        wrong=WRONG,
        high_found=_interval(judged["difference"]["too high"][MAIN]),
        low_found=_interval(judged["difference"]["too low"][MAIN]),
        scores=_table("forecast", {name: _cells(row, "{:.4f}") for name, row in judged["scores"].items()}),
        differences=_table(
            "forecast",
            {name: {key: _interval(each) for key, each in row.items()} for name, row in judged["difference"].items()},
        ),
        skill=_table("over", {name: _cells(row, "{:.2f}") for name, row in judged["skill"].items()}),
        coverage=_coverage(judged["coverage"]),
        figure=figure,
    )


def _cells(row: dict[str, float], form: str) -> dict[str, str]:
    return {name: form.format(value) for name, value in row.items()}


def _interval(found: dict[str, float]) -> str:
    return f"{found['value']:+.4f} ({found['low']:+.4f} to {found['high']:+.4f})"


def _table(first: str, rows: dict[str, dict[str, str]]) -> str:
    return table((first, *SCORES.values()), ((NAMES[name], *map(row.get, SCORES)) for name, row in rows.items()))


def _coverage(found: dict[str, dict[str, list[float]]]) -> str:
    rows = []
    for name, row in found.items():
        held = zip(row["share"], row["low"], row["high"], strict=True)
        rows.append((NAMES[name], *(f"{share:.1%} ({low:.1%} to {high:.1%})" for share, low, high in held)))
    return table(("forecast", *(f"{band:.0%}" for band in found["identified"]["band"])), rows)


COLOURS = {"identified": "#0b6bb0", "too high": "#d1490f", "too low": "#7a5195"}


def draw(found: dict[str, Any]) -> Any:
    """Draw the distribution of PIT values."""
    judged = found["judged"]
    with styled():
        figure = blank_figure(3.2)
        axes = figure.subplots()
        for name, colour in COLOURS.items():
            values = np.sort(judged["pit"][name])
            shares = np.arange(1, values.size + 1) / values.size
            axes.step(values, shares, where="post", color=colour, linewidth=1.0, label=NAMES[name])
        axes.plot([0, 1], [0, 1], color="0.6", linewidth=0.8, linestyle="--")
        axes.set(xlim=(0, 1), ylim=(0, 1), xlabel="PIT of the amplitude", ylabel="share of the tests")
        axes.legend(fontsize=6, loc="upper left", frameon=False)
    return figure


CAMPAIGNS, TESTS, MEMBERS, SEED, WORKERS = 48, 10, 50, 40, 2


def study(campaigns: int, seed: int, workers: int, *, tests: int = TESTS, members: int = MEMBERS) -> dict[str, Any]:
    """Run everything, and gather what the page gives."""
    pool = Parallel(n_jobs=workers)
    ran = list(pool(delayed(run_campaign)(seed, number, tests, members) for number in range(campaigns)))
    counts = {"campaigns": campaigns, "tests": tests, "members": members, "pilots": PILOTS}
    return {**counts, "seed": seed, "judged": judge(ran)}


STUDY = Study(
    "forecast-study",
    page,
    draw,
    "PIT of the amplitudes of forecasts",
    "Share of the tests up to each PIT value.",
)

if __name__ == "__main__":
    STUDY.perform(study, __doc__, campaigns=CAMPAIGNS, seed=SEED, workers=WORKERS)
