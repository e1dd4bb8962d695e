"""The study as a page of text and a figure."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.ticker import NullFormatter

from colonnade.figures.style import blank_figure, styled
from monte_carlo.design import LEVELS

GOAL_BIAS = 0.001
GOAL_COVERAGE = 0.92, 0.97
GOAL_WIDTH = 1.5

FEWEST = 50
"""Records of which a level is held to the goals."""

FACTORS = (*(factor for factor in LEVELS if factor != "scatter"), "scatter", "colour", "low-pass")
"""Whose levels the goals are for."""

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
    "scatter": "scatter of e",
    "colour": "noise",
    "low-pass": "low-pass",
    "speed": "e that depends on the speed",
    "drift": "zero that drifts",
    "recommended": "recommended by",
    "in the design": "Cramér–Rao error, in the design",
    "beyond it": "Cramér–Rao error, beyond it",
    "estimator": "estimator",
}

HEAD = (
    "| factor | level | records | refused | of eight impacts | bias of e | RMS error of e | 95 % intervals that hold e "
    "| of all records | median width | × best | naive RMS error | margin |"
)


def page(found: dict[str, Any], figure: str) -> str:
    """Write numbers as tables, with what they mean."""
    everything = found["levels"][0]
    inside = [each for each in found["levels"] if each["factor"] in FACTORS]
    coverages, biases = ([each[name] for each in inside] for name in ("coverage", "bias"))
    return "\n".join(
        [
            "# Monte-Carlo study of the identified restitution",
            "",
            f"Made by `python reports/restitution_study.py --records {found['records']} --seed {found['seed']}`.",
            f"{found['records']} records of free rocking, each with its own block, e, release, recorder, noise, zero",
            "offset and length, all drawn at random; half of them begin with the block in the hand, half went",
            "through the low-pass that the condition stage chooses. In three quarters e scatters from impact to",
            "impact, with a standard deviation of up to 0.005; in a third the noise has a power of 1/f, for 80 % of",
            "its variance. The truth is the full nonlinear equation, integrated step by step, as no estimator does it;",
            "the true e is the mean of all impacts that there could be, not only of those in the record.",
            "",
            f"Every record gave its `recommended` value or a refusal; {everything['recommended']} gave one. Of the",
            f"{everything['eight']} with eight usable impacts {everything['refused_of_eight']:.1%} were refused (goal:",
            f"at most 5 %). Largest |bias| of a level: {max(map(abs, biases)):.1e} (goal: below {GOAL_BIAS:g}).",
            f"Coverage by level: {min(coverages):.1%} to {max(coverages):.1%} (goal: {GOAL_COVERAGE[0]:.0%} to"
            f" {GOAL_COVERAGE[1]:.0%}).",
            "",
            "*Of all records*: a refusal counts as an interval that does not hold e. *Best*: the width that nobody",
            "could better, Student's interval of the true e of the usable impacts (those between the arcs that stand",
            "out of the noise) in quadrature with 1.96 Cramér–Rao errors (e, release angle and time, zero offset",
            "unknown; block, noise and one e known; before the filter); without scatter the latter alone. × *best* is",
            f"the ratio of the medians (goal: at most {GOAL_WIDTH:g}). *Naive* is the highest sample of each arc and",
            "an unweighted line through Housner's log energies; *margin* its RMS error over ours.",
            "",
            *_missed(found),
            "",
            *_table(found["levels"]),
            "",
            f"![Bias, coverage and RMS error by level]({figure})",
            "",
            "## Kinds of records",
            "",
            *_table(found["kinds"]),
            "",
            "## Blocks and recorders that are not as assumed",
            "",
            f"e changes by {abs(found['by_speed']):g} from the slowest to the fastest impact about the mean that was",
            "drawn (the truth is then the mean of the impacts that the value is from), or the zero drifts by",
            f"{found['drift']:g} α over the record.",
            "Departures that were named, in how many records: " + _named(found["named"]) + ".",
            "",
            *_table(found["departures"]),
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
            "Wherever it gives a value, recommended or not. The histories `linear` and `nonlinear`",
            "take one e for all impacts, and the linear one has a bias of its own on a nonlinear truth.",
            "",
            *_table(found["estimators"]),
            "",
        ]
    )


def _missed(found: dict[str, Any]) -> list[str]:
    """Name the levels, kinds and departures that miss a goal, with their figures."""
    lines = []
    for row in (*found["levels"], *found["kinds"], *found["departures"]):
        if row["recommended"] < FEWEST or row["factor"] == "recommended":
            continue
        name = f"{WORDS.get(row['factor'], row['factor'])}, {row['level']}"
        if not GOAL_COVERAGE[0] <= row["coverage"] <= GOAL_COVERAGE[1]:
            lines.append(f"- {name}: {row['coverage']:.1%} ± {row['coverage_error']:.1%} hold e.")
        if row["width"] > GOAL_WIDTH * row["best_width"]:
            lines.append(f"- {name}: {row['width'] / row['best_width']:.2f} times the best width.")
        if row["refused_of_eight"] is not None and row["refused_of_eight"] > 0.05:
            lines.append(f"- {name}: {row['refused_of_eight']:.1%} of records with eight usable impacts refused.")
    return ["Goals that are missed:", "", *lines] if lines else ["No goal is missed."]


def _named(named: dict[str, dict[str, int]]) -> str:
    """Write how often each departure was named."""
    return "; ".join(
        f"{WORDS[kind]}: " + (", ".join(f"{name} {count}" for name, count in counts.items()) or "none")
        for kind, counts in named.items()
    )


def _table(rows: list[dict[str, Any]]) -> list[str]:
    lines = [HEAD, "|" + "---|" * (HEAD.count("|") - 1)]
    for row in rows:
        if not row["records"]:
            name = WORDS.get(row["factor"], row["factor"])
            lines.append(f"| {name} | {row['level']} | 0 |" + " – |" * (HEAD.count("|") - 4))
            continue
        cells = [
            WORDS.get(row["factor"], row["factor"]),
            row["level"],
            str(row["records"]),
            f"{row['refused']:.1%}",
            _number(row["refused_of_eight"], ".1%"),
            f"{_number(row['bias'], '+.1e')} ± {_number(row['bias_error'], '.0e')}",
            _number(row["scatter"], ".1e"),
            f"{_number(row['coverage'], '.1%')} ± {_number(row['coverage_error'], '.1%')}",
            _number(row["held_of_all"], ".1%"),
            _number(row["width"], ".1e"),
            _number(_over(row["width"], row["best_width"]), ".2f"),
            _number(row["naive_scatter"], ".1e"),
            _number(row["margin"], ".0f"),
        ]
        lines.append("| " + " | ".join(cells) + " |")
    return lines


def _over(value: float | None, best: float | None) -> float | None:
    return value / best if value is not None and best else None


def _number(value: float | None, how: str) -> str:
    return "–" if value is None or not np.isfinite(value) else format(value, how)


def draw_levels(found: dict[str, Any]) -> Any:
    """Draw bias with its 95 % band, coverage, and RMS errors of both ways, level by level."""
    rows = [each for each in found["levels"] if each["factor"] in FACTORS and each["recommended"] > 1]
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
        scatter.xaxis.set_major_formatter("{x:g}")
        scatter.xaxis.set_minor_formatter(NullFormatter())
        scatter.set_xlabel("RMS error of e")
        scatter.legend(fontsize=7, loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=2, frameon=False)
        bias.set_yticks(places, [f"{WORDS[row['factor']]}: {row['level']}" for row in rows], fontsize=6)
        bias.set_ylim(len(rows) - 0.5, -0.5)
        edges = [place for place in places[1:] if rows[place]["factor"] != rows[place - 1]["factor"]]
        for axes in (bias, coverage, scatter):
            axes.margins(x=0.05)
            for edge in edges:
                axes.axhline(edge - 0.5, color="0.85", linewidth=0.6)
    return figure
