"""Study of fragility curves whose truth is known: `python reports/fragility_study.py [--repetitions N] [--seed N]`."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict
from typing import Any

import numpy as np
from joblib import Parallel, delayed

from colonnade.assessment.curves import ENOUGH_RECORDS, LEAST_MIXED
from colonnade.assessment.intervals import FEWEST_RECORDS, MOST_WITHOUT
from fragility_trial import APART, MEDIAN, PROBABILITIES, RESAMPLES, SIGNIFICANT, WITHIN, Population, run
from study import Cells, Study, columns

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
    repetitions, designs = found["repetitions"], found["designs"]
    rows = [{"population": name, **each["shares"]} for name, each in designs.items()]
    lognormal = [row for row, each in zip(rows, designs.values(), strict=True) if not each["population"]["two_kinds"]]
    levels = max(each["population"]["levels"] for each in designs.values())
    first: Cells = {"population": "{population}"}
    of_lognormal = {key: _share(key) for key in COLUMNS} | {"rejected": _share("misfit")}
    of_two_kinds = {"rejected": _share("misfit"), "isotonic, mean over levels": _mean_isotonic}
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
        lognormal=columns({**first, **of_lognormal}, lognormal),
        betas=columns(
            {**first, **{key: f"{{{key}:.3f}}" for key in BETAS}},
            [row for row in lognormal if row[BETAS[0]] is not None],
        ),
        two_kinds=columns({**first, **of_two_kinds}, [row for row in rows if row not in lognormal]),
        isotonic=columns({**first, **{str(1 + at): _share(f"isotonic {at}") for at in range(levels)}}, rows),
    )


def _share(key: str) -> Callable[[dict[str, Any]], str]:
    return lambda row: "" if row.get(key) is None else f"{100 * row[key]:.1f} %"


def _mean_isotonic(row: dict[str, Any]) -> str:
    return f"{100 * float(np.mean([share for key, share in row.items() if key.startswith('isotonic')])):.1f} %"


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
