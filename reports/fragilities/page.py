"""The page of the study."""

from __future__ import annotations

from typing import Any

import numpy as np

from colonnade.assessment.curves import ENOUGH_RECORDS, LEAST_MIXED
from colonnade.assessment.intervals import FEWEST_RECORDS, MOST_WITHOUT
from fragilities.population import APART, MEDIAN, WITHIN, Population
from fragilities.trial import PROBABILITIES, RESAMPLES, SIGNIFICANT

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

## Records of two kinds

Half of the records have a ln capacity {apart:g} above the median, half {apart:g} below, each with a scatter of
{within:g}: not lognormal. The test of the misfit should reject the curve, and the interval of the isotonic one hold.

{two_kinds}

## Isotonic curve

Share in which its interval holds the truth at each level, from the lowest to the highest.

{isotonic}

The intervals are wider than needed at probabilities near 0 and 1.
"""

COLUMNS = (
    "given",
    "median",
    "beta",
    *(f"P = {true:g}" for true in PROBABILITIES),
    "rate",
    "beta of records",
    "beta of parameters",
)


def page(found: dict[str, Any]) -> str:
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
        lognormal=_table(
            ("population", *COLUMNS, "rejected"),
            [
                [name, *(_percent(shares[key]) for key in (*COLUMNS, "misfit"))]
                for name, (_, shares) in lognormal.items()
            ],
        ),
        two_kinds=_table(
            ("population", "rejected", "isotonic, mean over levels"),
            [
                [name, _percent(shares["misfit"]), _percent(float(np.mean(_isotonic(shares))))]
                for name, (_, shares) in two_kinds.items()
            ],
        ),
        isotonic=_table(
            ("population", *(str(1 + place) for place in range(max(each.levels for each, _ in designs.values())))),
            [[name, *map(_percent, _isotonic(shares))] for name, (_, shares) in designs.items()],
        ),
    )


def _isotonic(shares: dict[str, float]) -> list[float]:
    return [share for key, share in shares.items() if key.startswith("isotonic")]


def _percent(share: float | None) -> str:
    return "" if share is None else f"{100 * share:.1f} %"


def _table(heading: tuple[str, ...], rows: list[list[str]]) -> str:
    width = len(heading)
    lines = ["| " + " | ".join(heading) + " |", "|---" * width + "|"]
    return "\n".join(lines + ["| " + " | ".join(row + [""] * (width - len(row))) + " |" for row in rows])
