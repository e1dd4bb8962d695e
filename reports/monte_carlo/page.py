"""The study as a page of text and a figure."""

from __future__ import annotations

from typing import Any

import numpy as np

from colonnade.figures.style import blank_figure, styled
from monte_carlo.design import LEVELS

GOAL_BIAS = 0.001
GOAL_COVERAGE = 0.92, 0.97

WORDS = {
    "all": "all",
    "restitution": "e",
    "slenderness": "height / width",
    "height": "height, m",
    "release": "release, of α",
    "rate": "sampling, Hz",
    "noise": "noise, of α",
    "offset": "zero offset, of α",
    "impacts": "impacts in the record",
    "low-pass": "low-pass",
    "recommended": "recommended by",
    "in the design": "Cramér–Rao error, in the design",
    "beyond it": "Cramér–Rao error, beyond it",
    "estimator": "estimator",
}

HEAD = (
    "| factor | level | records | refused | bias of e | RMS error of e | 95 % intervals that hold e | error² / bound² "
    "| naive bias | naive RMS error | margin |"
)


def page(found: dict[str, Any], figure: str) -> str:
    """Write numbers as tables, with what they mean."""
    everything = found["levels"][0]
    inside = [each for each in found["levels"] if each["factor"] in (*LEVELS, "low-pass")]
    coverages, biases = ([each[name] for each in inside] for name in ("coverage", "bias"))
    return "\n".join(
        [
            "# Monte-Carlo study of the identified restitution",
            "",
            f"Made by `python reports/restitution_study.py --records {found['records']} --seed {found['seed']}`.",
            f"{found['records']} records of free rocking, each with its own block, e, release, recorder, noise, zero",
            "offset and length, all drawn at random; half of them begin with the block in the hand, half went",
            "through the low-pass that the condition stage chooses. The truth is the full nonlinear equation,",
            "integrated step by step, as no estimator does it. Noise is white before the filter.",
            "",
            f"Every record gave its `recommended` value or a refusal; {everything['recommended']} gave a value.",
            f"Largest |bias| of a level: {max(map(abs, biases)):.1e} (goal: below {GOAL_BIAS:g}). Coverage by level:",
            f"{min(coverages):.1%} to {max(coverages):.1%} (goal: {GOAL_COVERAGE[0]:.0%} to {GOAL_COVERAGE[1]:.0%}).",
            "",
            "*Naive* is the highest sample of each arc and an unweighted line through Housner's log energies; *margin*",
            "its RMS error over ours, on the records that both give a value for. *error² / bound²*: median square of",
            "the error over the smallest standard error that is possible (Cramér and Rao: e, release angle and time,",
            "zero offset unknown, block known), relative to that of a normal error; 1 is the best that can be. The",
            "bound of a filtered record is that before the filter, so its 1 cannot be reached.",
            "",
            *_table(found["levels"]),
            "",
            f"![Bias, coverage and RMS error by level]({figure})",
            "",
            "## Refusals",
            "",
            "By the Cramér–Rao error of e, with a tenth as many records beyond the design (noise to 0.3 α, 3 to 8",
            "impacts, 100–266 Hz). At most 5 % may be refused where it is below 0.001; a refusal is right where it is",
            "above 0.003.",
            "",
            *_table(found["bounds"]),
            "",
            "## Each estimator on its own",
            "",
            "Wherever it gives a value, recommended or not. The linear history has a bias of its own on a nonlinear",
            "truth.",
            "",
            *_table(found["estimators"]),
            "",
        ]
    )


def _table(rows: list[dict[str, Any]]) -> list[str]:
    lines = [HEAD, "|" + "---|" * (HEAD.count("|") - 1)]
    for row in rows:
        if not row["records"]:
            lines.append(f"| {WORDS[row['factor']]} | {row['level']} | 0 |" + " – |" * 8)
            continue
        cells = [
            WORDS[row["factor"]],
            row["level"],
            str(row["records"]),
            f"{row['refused']:.1%}",
            f"{_number(row['bias'], '+.1e')} ± {_number(row['bias_error'], '.0e')}",
            _number(row["scatter"], ".1e"),
            f"{_number(row['coverage'], '.1%')} ± {_number(row['coverage_error'], '.1%')}",
            _number(row["efficiency"], ".2f"),
            _number(row["naive_bias"], "+.1e"),
            _number(row["naive_scatter"], ".1e"),
            _number(row["margin"], ".0f"),
        ]
        lines.append("| " + " | ".join(cells) + " |")
    return lines


def _number(value: float | None, how: str) -> str:
    return "–" if value is None or not np.isfinite(value) else format(value, how)


def draw_levels(found: dict[str, Any]) -> Any:
    """Draw bias with its 95 % band, coverage, and RMS errors of both ways, level by level."""
    rows = [each for each in found["levels"] if each["factor"] in (*LEVELS, "low-pass") and each["recommended"] > 1]
    places = np.arange(len(rows))
    with styled():
        figure = blank_figure(6.4)
        bias, coverage, scatter = figure.subplots(1, 3, sharey=True)
        bias.errorbar(
            [row["bias"] * 1e6 for row in rows], places, xerr=[1.96e6 * row["bias_error"] for row in rows], fmt="o",
            markersize=2.5, color="#0b6bb0",
        )  # fmt: skip
        bias.axvline(0.0, color="0.6", linewidth=0.8)
        bias.set_xlabel("bias of e, 10⁻⁶")
        coverage.axvspan(*(100 * edge for edge in GOAL_COVERAGE), color="0.92", zorder=0)
        coverage.errorbar(
            [100 * row["coverage"] for row in rows],
            places,
            xerr=[196 * row["coverage_error"] for row in rows],
            fmt="o",
            markersize=2.5,
            color="#0b6bb0",
        )
        coverage.axvline(95.0, color="0.6", linewidth=0.8)
        coverage.set_xlabel("intervals that hold e, %")
        for name, colour, label in (("scatter", "#0b6bb0", "recommended"), ("naive_scatter", "#d1490f", "naive")):
            scatter.semilogx([row[name] for row in rows], places, "o", markersize=3, color=colour, label=label)
        scatter.set_xlabel("RMS error of e")
        scatter.legend(fontsize=7, loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=2, frameon=False)
        bias.set_yticks(places, [f"{WORDS[row['factor']]}: {row['level']}" for row in rows], fontsize=6)
        bias.set_ylim(len(rows) - 0.5, -0.5)
        edges = [place for place in places[1:] if rows[place]["factor"] != rows[place - 1]["factor"]]
        for axes in (bias, coverage, scatter):
            for edge in edges:
                axes.axhline(edge - 0.5, color="0.85", linewidth=0.6)
    return figure
