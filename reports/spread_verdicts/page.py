"""The page of the study, and its figure."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from colonnade.figures.style import blank_figure, styled
from colonnade.identification.response.rank import WITHIN
from spread_verdicts.design import DURATION, HEIGHTS, RATE, RESTITUTION_ERROR

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

HEADS = (
    "",
    "tests",
    "within, true model",
    "nominal",
    "95 % of such shares",
    "outside, wrong e",
    "horizon",
    "overturned",
)


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
        kinds=_table("motion", [(each["kind"], each) for each in (*found["kinds"], {"kind": "all", **found["all"]})]),
        part=found["counts"][0]["judged"],
        counts=_table("runs", [(str(each["members"]), each) for each in found["counts"]]),
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


def _table(first: str, rows: Sequence[tuple[str, dict[str, Any]]]) -> str:
    lines = ["| " + " | ".join((first, *HEADS[1:])) + " |", "|---" * len(HEADS) + "|"]
    for name, row in rows:
        cells = (
            name,
            str(row["judged"]),
            f"{row['within']:.1%}",
            f"{row['nominal']:.1%}",
            f"{row['low']:.1%} to {row['high']:.1%}",
            f"{row['found']:.1%}",
            f"{row['horizon']:.0%}",
            str(row["overturned"]),
        )
        lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines)


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
        axes.set_xlabel("rank of the measured angle")
        axes.set_ylabel("share of the tests")
        axes.set_xlim(0, 1)
        axes.set_ylim(0, 1)
        axes.legend(fontsize=7, loc="upper left", frameon=False)
    return figure
