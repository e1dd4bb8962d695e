"""Study of fragility curves whose truth is known: `python reports/fragility_study.py [--repetitions N] [--seed N]`."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any

import numpy as np
from joblib import Parallel, delayed

from colonnade.assessment.curves import ENOUGH_RECORDS, LEAST_MIXED
from colonnade.assessment.intervals import FEWEST_RECORDS, MOST_WITHOUT
from fragility_trial import APART, MEDIAN, PROBABILITIES, RESAMPLES, SIGNIFICANT, WITHIN, Population, run
from study import Study, table

TEXT = """# Study of fragility curves whose truth is known

Made by `make study NAME=fragility` (`python reports/fragility_study.py --repetitions {repetitions} --seed {seed}`).

Each repetition draws records from a population with known capacities and runs each at all levels, under draws of its
own. ln capacity = ln({median:g} m/s) + record + draw. All intervals are 95 % intervals by {resamples} resamples of
records. With {repetitions} repetitions a share of 95 % is uncertain by {error} (one standard error).

## Lognormal populations

Share of the repetitions with an interval, and of these in which each interval holds the truth. There is no interval of
fewer than {fewest} records, nor if more than {without} of the resamples have no curve, nor, below {enough} records, if
the shares of the rarer outcome at each level add up to less than {mixed:g}, as those of levels β apart do. P is judged
at the intensities where it is {probabilities}. The rate is that over a power-law hazard (k = 2).

{lognormal}

The last column is the share in which the test of the misfit rejects the curve at {significant}, although it is right.

β split into that of the records and that of the draws, each over its truth, mean of the repetitions with a curve
(that of the records is 2 to 6 % too small, as is that of a curve of so few records):

{betas}

## Records of two kinds

Half of the records have a ln capacity {apart:g} above the median, half {apart:g} below, each with a scatter of
{within:g}: not lognormal. The test of the misfit should reject the curve, and the interval of the isotonic one hold.

{two_kinds}

## Isotonic curve

Share in which its interval holds the truth at each level, from the lowest to the highest.

{isotonic}

The intervals are wider than needed at probabilities near 0 and 1.
"""

COLUMNS = ("given", "median", "beta", *(f"P = {true:g}" for true in PROBABILITIES), "rate")
BETAS = ("beta of records", "beta of parameters")


def page(found: dict[str, Any], _figure: str = "") -> str:
    """Write the page."""
    repetitions = found["repetitions"]
    designs = {name: (Population(**each["population"]), each["shares"]) for name, each in found["designs"].items()}
    lognormal = {name: each for name, each in designs.items() if not each[0].two_kinds}
    two_kinds = {name: each for name, each in designs.items() if each[0].two_kinds}
    return TEXT.format(
        repetitions=repetitions,
        seed=found["seed"],
        median=MEDIAN,
        resamples=RESAMPLES,
        error=f"{100 * np.sqrt(0.95 * 0.05 / repetitions):.1f} %",
        probabilities=", ".join(f"{true:g}" for true in PROBABILITIES),
        significant=f"{SIGNIFICANT:g}",
        fewest=FEWEST_RECORDS,
        without=f"{100 * MOST_WITHOUT:g} %",
        enough=ENOUGH_RECORDS,
        mixed=LEAST_MIXED,
        apart=APART,
        within=WITHIN,
        lognormal=table(
            ("population", *COLUMNS, "rejected"),
            [
                [name, *(_percent(shares[key]) for key in (*COLUMNS, "misfit"))]
                for name, (_, shares) in lognormal.items()
            ],
        ),
        betas=table(
            ("population", *BETAS),
            [
                [name, *(f"{shares[key]:.3f}" for key in BETAS)]
                for name, (_, shares) in lognormal.items()
                if shares[BETAS[0]] is not None
            ],
        ),
        two_kinds=table(
            ("population", "rejected", "isotonic, mean over levels"),
            [
                [name, _percent(shares["misfit"]), _percent(float(np.mean(_isotonic(shares))))]
                for name, (_, shares) in two_kinds.items()
            ],
        ),
        isotonic=table(
            ("population", *(str(1 + place) for place in range(max(each.levels for each, _ in designs.values())))),
            [[name, *map(_percent, _isotonic(shares))] for name, (_, shares) in designs.items()],
        ),
    )


def _isotonic(shares: dict[str, float]) -> list[float]:
    return [share for key, share in shares.items() if key.startswith("isotonic")]


def _percent(share: float | None) -> str:
    return "" if share is None else f"{100 * share:.1f} %"


REPETITIONS, SEED, WORKERS = 500, 2015, 2

POPULATIONS = {
    "30 records, 10 draws, β 0.40 and 0.15": Population(),
    "20 records, 10 draws, β 0.40 and 0.15": Population(records=20),
    "40 records, 5 draws, β 0.30 and 0.30": Population(records=40, draws=5, of_records=0.3, of_parameters=0.3),
    "12 records, 10 draws, 8 levels, β 0.40 and 0.20": Population(records=12, levels=8, of_parameters=0.2),
    **{
        f"{records} records, 1 draw, {levels} levels, β 0.40": Population(records, 1, levels, of_parameters=0.0)
        for records in (6, 10, 20, 50, 100)
        for levels in (6, 12)
    },
    "two kinds, 30 records": Population(two_kinds=True),
    "two kinds, 20 records": Population(records=20, two_kinds=True),
}


def study(repetitions: int, seed: int, workers: int) -> dict[str, Any]:
    """Run all repetitions of all populations, and gather what the page gives."""
    pool = Parallel(n_jobs=workers, batch_size=4)
    designs = {}
    for name, population in POPULATIONS.items():
        held = list(pool(delayed(run)(population, seed, number) for number in range(repetitions)))
        shares = {key: share_of([each[key] for each in held]) for key in held[0]}
        designs[name] = {"population": asdict(population), "shares": shares}
    return {"repetitions": repetitions, "seed": seed, "designs": designs}


def share_of(held: list[float | None]) -> float | None:
    """Share of the intervals given that hold, or the mean of the values given; None if none is."""
    given = [each for each in held if each is not None]
    return float(np.mean(given)) if given else None


STUDY = Study("fragility-study", page)

if __name__ == "__main__":
    STUDY.perform(study, __doc__, repetitions=REPETITIONS, seed=SEED, workers=WORKERS)
