"""Monte-Carlo study of the identified restitution: `python reports/restitution_study.py [--records N] [--seed N]`."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from joblib import Parallel, delayed
from matplotlib.figure import Figure
from scipy import stats
from threadpoolctl import threadpool_limits

import colonnade
from monte_carlo.bound import cramer_rao_error
from monte_carlo.design import SPREAD, Kind, draw, kinds
from monte_carlo.new_test import judge_new_tests
from study import HERE, Cells, Study, columns, rounded

NAME = "restitution-study"
RECORDS, CAMPAIGNS, SEED, WORKERS = 400, 500, 2026, 2

BEFORE = HERE / "monte_carlo" / "before.json"
"""What version 0.1 recommended of the same records: the best of six estimators, which took α, p and gain as exact."""

NORMAL = float(stats.norm.ppf(0.975))

COVERAGE = 0.92, 0.97
"""Between these the coverage of a kind has to be, as far as its 99 % binomial interval says; or above, ..."""

NEAR_BEST = 1.2
"""... if the median interval is at most so many times as wide as the best one."""

WIDEST = 1.5
"""Most that the median interval is as wide as the best one."""

REFUSED = 0.05
"""Share of the records with eight impacts that are refused at most."""

FEW = 8
"""Impacts."""

BIAS = 0.1
"""Most that the median error is of the interval's width."""


@dataclass(frozen=True)
class Trial:
    """One record: e, its interval (NaN where refused), the truth, the Cramér–Rao error of e, impacts, and why not."""

    value: float
    low: float
    high: float
    truth: float
    bound: float
    impacts: int
    reason: str


@dataclass(frozen=True)
class Judged:
    """
    What the study says of one kind of record.

    Attributes
    ----------
    name : str
    records, answered : int
    coverage, least, most : float
        Share of the intervals that hold e, and its 99 % binomial interval.
    width : float
        Median of the interval over the best one, which has the Cramér–Rao error.
    half_width : float
        Median, of e.
    bias : float
        Median error over the median width.
    refused : float
        Share of the records with at least eight impacts.
    complaint : str
        What is not as it should be; empty if all is.
    """

    name: str
    records: int
    answered: int
    coverage: float
    least: float
    most: float
    width: float
    half_width: float
    bias: float
    refused: float
    complaint: str = ""


def run(kind: Kind, seed: int, number: int) -> Trial:
    """Draw a record and identify its e."""
    drawn = draw(kind, seed, number)
    known = colonnade.Uncertainty(critical_angle=drawn.width, p=drawn.width, angle_gain=drawn.width)
    with threadpool_limits(1):
        found = colonnade.identify_restitution(*drawn.record(), drawn.block, lowpass=drawn.cutoff, uncertainty=known)
        bound = cramer_rao_error(drawn)
    value, low, high = (np.nan if each is None else each for each in (found.value, found.low, found.high))
    truth = drawn.truth
    if drawn.rocking.by_speed and found.history is not None:
        # The mean of ln e over the impacts that the value is from.
        impacts, e, _ = drawn.rocking.course()
        first, last = found.history.time[[0, -1]]
        # The last arc ends with an impact, which a sample may follow.
        within = (impacts > first) & (impacts < last - 2 * np.diff(found.history.time).max())
        truth = float(np.exp(np.log(e[within] - drawn.chance[within]).mean()))
    return Trial(value, low, high, truth, bound, drawn.rocking.restitution.size, found.reason)


def judge(name: str, trials: list[Trial]) -> Judged:
    """Judge the records of one kind."""
    value, low, high, truth, bound, impacts = (
        np.array([getattr(each, field) for each in trials])
        for field in ("value", "low", "high", "truth", "bound", "impacts")
    )
    answered = np.isfinite(value)
    held = int(((low <= truth) & (truth <= high))[answered].sum())
    count = int(answered.sum())
    test = stats.binomtest(held, count).proportion_ci(0.99)
    ratio = float(np.median((high - low)[answered] / (2 * NORMAL * bound[answered])))
    width = float(np.median((high - low)[answered]))
    bias = float(np.median((value - truth)[answered])) / width
    enough = impacts >= FEW
    refused = float((~answered & enough).sum() / max(enough.sum(), 1))
    complaints = [
        (test.high < COVERAGE[0], "holds e too seldom"),
        (test.low > COVERAGE[1] and ratio > NEAR_BEST, "holds e too often"),
        (ratio > WIDEST, "too wide"),
        (abs(bias) > BIAS, "biased"),
        (refused > REFUSED, "refuses too often"),
    ]
    said = ", ".join(text for is_so, text in complaints if is_so)
    return Judged(name, len(trials), count, held / count, test.low, test.high, ratio, width / 2, bias, refused, said)


def study(records: int, campaigns: int, seed: int, workers: int) -> Any:
    """Run everything, and gather what the page gives."""
    judged = []
    with Parallel(n_jobs=workers, batch_size=8) as pool:
        for place, kind in enumerate(kinds()):
            trials = pool(delayed(run)(kind, seed + place, number) for number in range(records))
            judged.append(judge(kind.name, list(trials)))
    found = {
        "records": records,
        "campaigns": campaigns,
        "seed": seed,
        "kinds": [asdict(each) for each in judged],
        "before": json.loads(BEFORE.read_text(encoding="utf-8")),
        "new_test": [asdict(each) for each in judge_new_tests(campaigns, seed, workers)],
    }
    return rounded(found, 4)


def page(found: dict[str, Any], figure: str = f"{NAME}.svg") -> str:
    """Write the page of the study."""
    before = found["before"]

    def was(name: str, form: str, factor: float = 1.0) -> Callable[[Any], str]:
        return lambda row: form.format(factor * before[row["name"]][name]) if row["name"] in before else "–"

    of_kinds: Cells = {
        "kind": "{name}",
        "intervals that hold e": lambda row: "{:.1f} % ({:.1f} to {:.1f})".format(
            *(100 * row[name] for name in ("coverage", "least", "most"))
        ),
        "width / best": "{width:.2f}",
        "± of e": "{half_width:.1g}",
        "bias / width": "{bias:+.2f}",
        "refused": lambda row: f"{100 * row['refused']:.1f} %",
        "0.1: hold e": was("coverage", "{:.1f} %", 100),
        "0.1: width / best": was("width", "{:.2f}"),
        "0.1: refused": was("refused", "{:.1f} %", 100),
        "verdict": lambda row: row["complaint"] or "as it should be",
    }
    of_tests: Cells = {
        "free vibrations": "{tests}",
        "scatter between tests": "{between:g}",
        "content of the range": lambda row: f"{100 * row['content']:.1f} %",
        "± of the range": "{half_width:.2g}",
        "mean held": lambda row: f"{100 * row['coverage']:.1f} %",
    }
    a_row = found["new_test"][0]["campaigns"]
    limits = "; ".join(f"{name} {low:g} to {high:g}" for name, (low, high) in SPREAD.items())
    return f"""# The identified restitution, held against known truth

Made by `make study NAME=restitution`; {found["records"]} records of each kind, seed {found["seed"]}.

## Method

A block is drawn, with e of each impact, a release, a recorder and its noise. Its angle is computed in closed form by
SciPy's elliptic functions; the estimator steps through time instead. The block that the estimator is given, and the
gain of the angle, are wrong by relative errors that are normal with the standard deviation s, which the estimator is
told (`uncertainty`). Limits of the draws: {limits}; noise, release and offset over α. A third of the records has
noise of power 1/f unless the kind says otherwise, and half of them went through the low-pass of the condition stage.

Where e falls linearly with the speed of impact, the mean of ln e over the impacts followed is what the interval has to
hold. The best interval is that of the Cramér–Rao error with s, the scatter of e and the noise known. The coverage has a
99 % binomial interval; it fails outside {100 * COVERAGE[0]:g} to {100 * COVERAGE[1]:g} %, or above, if the interval is
not within {NEAR_BEST:g} of the best width. The columns "0.1" are what version 0.1 recommended for the same records:
it took the block and the gain as exact, and chose between six estimators.

## Each kind

{columns(of_kinds, found["kinds"])}

![Coverage and width of each kind]({figure})

## A new test

Campaigns of 2, 3, 10 and 20 free vibrations of a block whose α and p are wrong by 0.5 %, with gains of their own and
an e of each test that scatters about one mean. The content is the probability that a new test's e is in the 95 %
range, averaged over {a_row} campaigns a row; 93 to 97 % was expected. Coverage is that of the
interval of the mean.

{columns(of_tests, found["new_test"])}
"""


WIDTHS = (1, 2, 3, 5)
"""Of the axis of widths."""


def draw_kinds(found: dict[str, Any]) -> Figure:
    """Draw coverage and width of each kind, this version beside 0.1."""
    judged, before = [Judged(**each) for each in found["kinds"]], found["before"]
    figure = Figure(figsize=(8.0, 0.26 * len(judged) + 1.0), layout="constrained")
    left, right = figure.subplots(1, 2, sharey=True)
    places = np.arange(len(judged))[::-1]
    share = np.array([[each.coverage, each.least, each.most] for each in judged]) * 100
    bars = np.abs(share[:, 1:] - share[:, :1]).T
    left.errorbar(share[:, 0], places, xerr=bars, fmt="o", ms=4, label="this version")
    right.plot([each.width for each in judged], places, "o", ms=4, label="this version")
    for axes, key, scale in ((left, "coverage", 100.0), (right, "width", 1.0)):
        old = [scale * before[each.name][key] if each.name in before else np.nan for each in judged]
        axes.plot(old, places, "x", ms=5, color="0.5", label="version 0.1")
    left.axvspan(100 * COVERAGE[0], 100 * COVERAGE[1], color="0.9", zorder=0)
    left.set_yticks(places, [each.name for each in judged], fontsize=7)
    left.set(xlabel="intervals that hold e (%)")
    right.axvline(1.0, color="0.6", lw=0.8)
    right.set(xlabel="median width over the best", xscale="log")
    right.set_xticks(WIDTHS, map(str, WIDTHS))
    right.minorticks_off()
    right.legend(fontsize=7, frameon=False)
    return figure


STUDY = Study(
    NAME,
    page,
    draw_kinds,
    "Coverage and width of the identified restitution",
    "Coverage and relative width of the intervals of e, kind by kind, beside those of version 0.1.",
)

if __name__ == "__main__":
    performed = STUDY.perform(study, __doc__, records=RECORDS, campaigns=CAMPAIGNS, seed=SEED, workers=WORKERS)
    if failed := [f"{each['name']}: {each['complaint']}" for each in performed["kinds"] if each["complaint"]]:
        raise SystemExit("\n".join(failed))
