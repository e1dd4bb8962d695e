"""Measure each estimator's bias on nonlinear rocking, and write it into docs/: `python reports/linear_bias.py`."""

from __future__ import annotations

import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

import colonnade
from colonnade.dynamics.block import Block
from colonnade.figures.style import blank_figure, styled
from monte_carlo.integration import integrated_angle
from monte_carlo.naive import naive_restitution
from monte_carlo.truth import FreeRocking
from study import renewed, table, write_figure

DOCUMENT = Path(__file__).resolve().parents[1] / "docs" / "explanation" / "restitution.md"
FIGURE = "linear-bias.svg"
MARKS = "<!-- measured: begin -->", "<!-- measured: end -->"

SLENDERNESSES = (3.0, 4.0, 6.0, 9.0, 12.0)
"""Height over width."""
RELEASES = (0.2, 0.4, 0.6, 0.8, 0.9)
"""Over α."""
RESTITUTIONS = (0.85, 0.95)
IMPACTS = 20
RATE = 500.0
NOISE = 1e-4
"""Hz; of α, so small that what is left is the estimator's own."""
SEEDS = 3

NAIVE, LINEAR = "Housner's line", "history-linear"
ESTIMATORS = ("peaks", "impact-by-impact", LINEAR, "history-nonlinear", "history-scatter", NAIVE)


@dataclass(frozen=True)
class Bias:
    """Estimated less true e of each estimator, mean over the seeds; NaN where one gave no value."""

    restitution: float
    slenderness: float
    release: float
    by_estimator: dict[str, float]


def measure(
    restitutions: tuple[float, ...] = RESTITUTIONS,
    slendernesses: tuple[float, ...] = SLENDERNESSES,
    releases: tuple[float, ...] = RELEASES,
) -> list[Bias]:
    """Identify e from records of the full nonlinear equation."""
    return [
        Bias(restitution, slenderness, release, _biases(restitution, slenderness, release))
        for restitution in restitutions
        for slenderness in slendernesses
        for release in releases
    ]


def _biases(restitution: float, slenderness: float, release: float) -> dict[str, float]:
    block = Block.prism(width=1.0 / slenderness, depth=0.3, height=1.0, mass=100.0)
    rocking = FreeRocking(block.critical_angle, block.p, restitution, release * block.critical_angle, 0.5)
    time = np.arange(0.0, rocking.impact_times()[IMPACTS - 1], 1 / RATE)
    angle, _, _ = integrated_angle(rocking, time)
    # Housner's line is read off without noise and from a fine clock: what it is off is the linear relation's.
    fine = np.arange(0.0, time[-1], 1e-4)
    off = {name: [] for name in ESTIMATORS}
    off[NAIVE].append(naive_restitution(rocking.angle(fine), block.critical_angle) - restitution)
    for seed in range(SEEDS):
        noise = np.random.default_rng(seed).normal(0.0, NOISE * block.critical_angle, time.size)
        found = colonnade.identify_restitution(time, angle + noise, block)
        for estimate in found.estimates:
            if estimate.value is not None:
                off[estimate.name].append(estimate.value - restitution)
    return {name: float(np.mean(values)) if values else float("nan") for name, values in off.items()}


def tables(biases: list[Bias]) -> str:
    """Write the linear history's bias over slenderness and release, and the largest of every estimator."""
    lines = []
    for restitution in dict.fromkeys(bias.restitution for bias in biases):
        own = [bias for bias in biases if bias.restitution == restitution]
        releases = list(dict.fromkeys(bias.release for bias in own))
        for name, title in (
            (LINEAR, "the whole history by the linear model"),
            (NAIVE, "Housner's line, without noise"),
        ):
            lines += [
                f"Bias of {title}, e = {restitution:g}:",
                "",
                table(
                    ("height / width", *(f"release {release:g} α" for release in releases)),
                    (
                        (
                            f"{slenderness:g}",
                            *(_written(bias.by_estimator[name]) for bias in own if bias.slenderness == slenderness),
                        )
                        for slenderness in dict.fromkeys(bias.slenderness for bias in own)
                    ),
                ),
                "",
            ]
    lines += ["Largest bias of each estimator over all of these blocks and releases:", ""]
    rows = []
    for name in ESTIMATORS:
        known = [bias for bias in biases if np.isfinite(bias.by_estimator[name])]
        largest = max(known, key=lambda bias: abs(bias.by_estimator[name]))
        where = f"e = {largest.restitution:g}, height / width {largest.slenderness:g}, release {largest.release:g} α"
        rows.append((name, _written(largest.by_estimator[name]), where))
    return "\n".join([*lines, table(("estimator", "largest", "of"), rows)])


def _written(value: float) -> str:
    return "–" if np.isnan(value) else f"{value:+.5f}"


def draw(biases: list[Bias]) -> Any:
    """Draw the linear history's bias over the release, a line a slenderness, a panel an e."""
    restitutions = list(dict.fromkeys(bias.restitution for bias in biases))
    with styled():
        figure = blank_figure(2.8)
        panels = figure.subplots(1, len(restitutions), sharey=True, squeeze=False)[0]
        for axes, restitution in zip(panels, restitutions, strict=True):
            own = [bias for bias in biases if bias.restitution == restitution]
            slendernesses = list(dict.fromkeys(bias.slenderness for bias in own))
            for number, slenderness in enumerate(slendernesses):
                line = [bias for bias in own if bias.slenderness == slenderness]
                axes.plot(
                    [bias.release for bias in line],
                    [bias.by_estimator[LINEAR] for bias in line],
                    color="#d1490f",
                    alpha=1.0 - 0.75 * number / max(len(slendernesses) - 1, 1),
                    marker="osD^v"[number % 5],
                    markersize=3,
                    label=f"height / width {slenderness:g}",
                )
            axes.axhline(0.0, color="0.6", linewidth=0.8)
            axes.set_title(f"e = {restitution:g}")
            axes.set_xlabel("release, of α")
        panels[0].set_ylabel("bias of e, linear history")
        panels[-1].legend(fontsize=7)
    return figure


def rebuild(document: Path, biases: list[Bias]) -> None:
    """Write table and figure into a document, between its marks, and beside it."""
    inside = f"{tables(biases)}\n\n![Bias of the linear model]({FIGURE})"
    document.write_text(renewed(document.read_text(encoding="utf-8"), MARKS, inside), encoding="utf-8")
    title = "Bias of e from the linear model on nonlinear rocking"
    described = "Over the release angle, a line a slenderness: largest for stocky blocks that are released high."
    write_figure(document.with_name(FIGURE), draw(biases), title, described)


if __name__ == "__main__":
    rebuild(Path(sys.argv[1]) if len(sys.argv) > 1 else DOCUMENT, measure())
