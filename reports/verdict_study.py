"""Study of the verdict "within its own spread": `python reports/verdict_study.py [--tests N] [--seed N]`."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from joblib import Parallel, delayed
from scipy import stats

from colonnade.campaign.settings import EnsembleSettings
from colonnade.figures.style import blank_figure, styled
from colonnade.identification.response.rank import WITHIN, is_within
from study import Cells, Study, columns
from verdict_trial import DURATION, HEIGHTS, RATE, RESTITUTION_ERROR, Trial, run


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


TEXT = """# Study of the verdict "within its own spread"

Made by `make study NAME=verdict` (`python reports/verdict_study.py --tests {tests} --seed {seed}`).

The verdict asks whether the measured rocking angle could be one more run of the model. Each run of the ensemble
gets measurement errors of its own: noise, zero, calibration and low-pass of the measured angle. Each of the {members}
runs and the measured angle then have a distance: the largest deviation from the median of all others, up to the
horizon, over half of their 95 % band. The rank of the measured angle is the share of runs with a smaller
distance. It is within the spread up to a rank of {limit:.2f}.

{tests} tests whose truth is known went through the stages `ingest`, `condition`, `rocking`, `ensemble` and
`compare`, free vibrations also through `restitution`, which gives their zero offset. Each lasts {duration:g} s at
{rate:g} samples a second, with prisms of {heights} m. In each, the true e, α, p, clock, gain of the
accelerometer, gain and zero of the transducers differ from the known ones by errors drawn from the standard
deviations of the settings (e: {deviation:g}); both recorders are noisy. The model, the nonlinear one, is true. Then
the same {tests} tests were judged by ensembles around an e that is wrong by {wrong:g}, up and down.

**Under the true model {within:.1%} of {judged} tests are within the spread** (nominal {nominal:.1%};
95 % of such shares are between {low:.1%} and {high:.1%}). **With e wrong by {wrong:g}, {found:.1%} are called
outside.**

## By kind of motion

{kinds}

*Horizon*: mean predicted share of the record, up to the time at which the 95 % band is wider than 0.2 α. A wrong e is
found if the specimen has many impacts before that time. {missed}

## By number of runs

The first {part} of these tests, with other numbers of runs.

{counts}

![Ranks of the measured angle]({figure})
"""

CELLS: Cells = {
    "tests": "{judged}",
    "within, true model": "{within:.1%}",
    "nominal": "{nominal:.1%}",
    "95 % of such shares": "{low:.1%} to {high:.1%}",
    "outside, wrong e": "{found:.1%}",
    "horizon": "{horizon:.0%}",
    "overturned": "{overturned}",
}


def page(found: dict[str, Any], figure: str) -> str:
    """Write the page."""
    return TEXT.format(
        **{name: found[name] for name in ("tests", "seed", "members", "wrong")},
        **{name: found["all"][name] for name in ("judged", "within", "nominal", "low", "high", "found")},
        limit=WITHIN,
        duration=DURATION,
        rate=RATE,
        heights=", ".join(f"{height:g}" for height in HEIGHTS.values()),
        deviation=RESTITUTION_ERROR,
        kinds=columns({"motion": "{kind}", **CELLS}, [*found["kinds"], {"kind": "all", **found["all"]}]),
        part=found["counts"][0]["judged"],
        counts=columns({"runs": "{members}", **CELLS}, found["counts"]),
        missed=_missed(found["kinds"]),
        figure=figure,
    )


def _missed(kinds: Sequence[dict[str, Any]]) -> str:
    """Name the kinds of motion whose rate is not the nominal one."""
    missed = [each for each in kinds if not each["low"] <= each["within"] <= each["high"]]
    if not missed:
        return "No kind of motion is outside the interval of its share."
    told = ", ".join(f"{each['kind']} ({each['within']:.1%}, nominal {each['nominal']:.1%})" for each in missed)
    return f"**Outside the interval of its share: {told}.**"


def draw_ranks(found: dict[str, Any]) -> Any:
    """Draw the share of the tests up to each rank, with the straight line of an exact verdict."""
    with styled():
        figure = blank_figure(3.2)
        axes = figure.subplots()
        for name, colour, label in (
            ("true", "#0b6bb0", "true model"),
            ("wrong", "#d1490f", f"e wrong by {found['wrong']:g}"),
        ):
            ranks = np.sort([rank for rank in found["ranks"][name] if np.isfinite(rank)])
            axes.step(ranks, np.arange(1, ranks.size + 1) / ranks.size, where="post", color=colour, label=label)
        axes.plot([0, 1], [0, 1], color="0.6", linewidth=0.8, linestyle="--", label="exact")
        axes.axvline(WITHIN, color="0.6", linewidth=0.8)
        axes.set(xlabel="rank of the measured angle", ylabel="share of the tests", xlim=(0, 1), ylim=(0, 1))
        axes.legend(fontsize=7, loc="upper left", frameon=False)
    return figure


TESTS, SEED, WORKERS = 1000, 22, 2
WRONG = 0.01
"""Error of e for the power."""

OTHER_MEMBERS = (20, 50, 200)
"""Runs of an ensemble, beside the default."""

SHARE = 5
"""Of the tests, one in so many is repeated with other numbers of runs."""


def run_trials(tests: int, seed: int, wrong: float, members: int, workers: int) -> list[Trial]:
    """Run so many tests around an e that is wrong by so much."""
    pool = Parallel(n_jobs=workers, batch_size=8)
    return list(pool(delayed(run)(seed, number, wrong, members) for number in range(tests)))


def study(tests: int, seed: int, workers: int) -> dict[str, Any]:
    """Run everything, and gather what the page gives."""
    members = EnsembleSettings().members
    whole = {wrong: run_trials(tests, seed, wrong, members, workers) for wrong in (0.0, WRONG)}
    counts = []
    for number in sorted((*OTHER_MEMBERS, members)):
        part = {
            wrong: whole[wrong][: tests // SHARE]
            if number == members
            else run_trials(tests // SHARE, seed, wrong, number, workers)
            for wrong in (0.0, WRONG)
        }
        counts.append({"members": number, **judge(part[0.0], part[WRONG], number)})
    kinds = dict.fromkeys(trial.kind for trial in whole[0.0])
    return {
        "tests": tests,
        "seed": seed,
        "members": members,
        "wrong": WRONG,
        "all": judge(whole[0.0], whole[WRONG], members),
        "kinds": [
            {
                "kind": kind,
                **judge(*([trial for trial in whole[wrong] if trial.kind == kind] for wrong in (0.0, WRONG)), members),
            }
            for kind in kinds
        ],
        "counts": counts,
        "ranks": {
            name: [round(trial.rank, 4) for trial in whole[wrong]] for name, wrong in (("true", 0.0), ("wrong", WRONG))
        },
    }


STUDY = Study(
    "verdict-study",
    page,
    draw_ranks,
    "Ranks of measured histories among the runs of a model",
    "Share of the tests up to each rank: under a true model, and with an e that is wrong.",
)

if __name__ == "__main__":
    STUDY.perform(study, __doc__, tests=TESTS, seed=SEED, workers=WORKERS)
