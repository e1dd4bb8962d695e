"""Rocking in space next to its plane fit, in words and tables: which disturbance gives the paper's misfit?"""

from __future__ import annotations

from collections.abc import Callable
from math import degrees, exp, log
from typing import Any

from contact_model.free import CYLINDER

VISIBLE = 0.05
"""Of α: a misfit that is seen in a figure of θ(t)/α."""

WORSE = 2.0
"""Times what a disturbance adds to the prism's misfit: so much more for both round bodies is the paper's order."""

ROUND = ("cylinder", "cone")

_RATE, _ALPHA = CYLINDER.p, CYLINDER.critical_angle
_TALL = 0.455

KINDS: dict[str, tuple[str, Callable[[float], str]]] = {
    "none": ("let go as it should be", lambda _: "–"),
    "lean": ("rotation about x at the release", lambda size: f"{100 * size:g} % of α"),
    "push": (
        "sideways push",
        lambda size: f"{100 * size:g} % of pα ({1e3 * size * _RATE * _ALPHA * _TALL:.2g} mm/s at the top)",
    ),
    "spin": ("spin about the vertical", lambda size: f"{100 * size:g} % of p ({degrees(size * _RATE):.2g} °/s)"),
    "tilt": ("table tilted across", lambda size: f"{100 * size:g} % of α ({1e3 * size * _ALPHA:.2g} mm/m)"),
    "warp": ("base warped, two low spots", lambda size: f"{1e6 * size:g} µm"),
    "feet": ("uneven base, three low spots", lambda size: f"{1e6 * size:g} µm"),
    "oval": ("oval base", lambda size: f"± {1e6 * size:g} µm of the radius"),
}
"""What each disturbance is called, and how its size is written; speeds and angles are those of the cylinder."""


def misfit_lines(runs: list[Any], controls: list[Any], figure: str) -> list[str]:
    """Write the misfits after each disturbance, those of other discretisations, and what gives the paper's order."""
    large = max(run["release"] for run in runs)
    lines = [
        "## What turns rocking three-dimensional",
        "",
        "The paper explains its misfit at large first amplitudes by rocking that turns three-dimensional: worst for",
        "cone and cylinder, least for the prism. Here each specimen is calibrated to the same e, disturbed in one way,",
        "and plane rocking is fitted to its θ (`colonnade.identify_restitution`). Misfit: RMS of θ less the plane",
        "model with the fitted e and the known release, up to that model's fourth impact, in % of α. A star: plane",
        "rocking was refused as a fit, and e of the calibration is taken. In brackets: the largest rotation about x",
        "over α. Round bodies touch along four whole circles; uneven and oval ones at 576 nodes on each, with the axis",
        "of what is uneven at 30° to the plane of rocking. Speeds and slopes are those of the cylinder.",
        "",
    ]
    for release in sorted({run["release"] for run in runs}, reverse=True):
        lines += [
            f"Released at {release:g} α:",
            "",
            "| disturbance | size | prism | cylinder | cone |",
            "|---|---|---|---|---|",
        ]
        chosen = [run for run in runs if run["release"] == release]
        for kind, size in dict.fromkeys((run["kind"], run["size"]) for run in chosen):
            name, written = KINDS[kind]
            cells = [_cell(chosen, specimen, kind, size) for specimen in ("prism", *ROUND)]
            lines.append(f"| {name} | {written(size)} | " + " | ".join(cells) + " |")
        lines.append("")
    lines += [*verdict(runs, large), "", f"![Misfit over disturbance]({figure})", ""]
    return lines + control_lines(controls)


def control_lines(controls: list[Any]) -> list[str]:
    """Write the same misfits of the cylinder with other steps, circles, nodes, stiffness and friction."""
    columns = list(dict.fromkeys((run["kind"], run["size"]) for run in controls))
    heads = [KINDS[kind][0] + ("" if kind == "none" else f", {KINDS[kind][1](size)}") for kind, size in columns]
    lines = [
        "### Against its own discretisation",
        "",
        f"The cylinder released at {controls[0]['release']:g} α again, with the law that the four whole rings were",
        "calibrated to. A rotation about x only turns the plane of rocking of a body of revolution: what it adds on",
        "nodes is that of a polygon.",
        "",
        "| variant | " + " | ".join(heads) + " |",
        "|---|" + "---|" * len(columns),
    ]
    for variant in dict.fromkeys(run["variant"] for run in controls):
        chosen = [run for run in controls if run["variant"] == variant]
        cells = [_cell(chosen, "cylinder", kind, size) for kind, size in columns]
        lines.append(f"| {variant} | " + " | ".join(cells) + " |")
    return [*lines, "", *_changes(controls), ""]


def _changes(controls: list[Any]) -> list[str]:
    """Write by how much the variants change the misfits of the first, and what a harder contact does."""
    found: dict[str, dict[str, float]] = {}
    for run in controls:
        found.setdefault(run["variant"], {})[run["kind"]] = run["misfit"]["nonlinear"]
    first, *others = found
    soft = "a tenth of the stiffness"
    alike = [each for each in others if each != soft and "nodes" not in each]
    largest = max((abs(found[each][kind] - found[first][kind]) for each in alike for kind in found[first]), default=0.0)
    lines = [f"Step, number of circles and friction change these misfits by up to {100 * largest:.1f} % of α."]
    if soft in found:
        shrunk = ", ".join(
            f"{KINDS[kind][0]} {100 * found[first][kind]:.1f} to {100 * found[soft][kind]:.1f}"
            for kind in found[first]
            if kind in ("push", "spin", "tilt")
        )
        lines += [
            f"A tenth of the stiffness makes them smaller: {shrunk}. A softer contact lands flat for a longer time, so",
            "that more is needed for the rim to roll round. The sizes above hold for the default stiffness.",
        ]
    return lines


def _cell(runs: list[Any], specimen: str, kind: str, size: float) -> str:
    for run in runs:
        if (run["specimen"], run["kind"], run["size"]) == (specimen, kind, size):
            refused = "*" if run["fitted"] is None else ""
            fallen = ", overturned" if run["overturned"] else ""
            return f"{100 * run['misfit']['nonlinear']:.1f}{refused} ({run['out_of_plane']:.2f}{fallen})"
    return "–"


def added(runs: list[Any], release: float, specimen: str, kind: str) -> list[tuple[float, float]]:
    """Give by size what a disturbance adds to a specimen's misfit, of α."""
    mine = [run for run in runs if (run["release"], run["specimen"]) == (release, specimen)]
    plain = next(run["misfit"]["nonlinear"] for run in mine if run["kind"] == "none")
    return [(run["size"], run["misfit"]["nonlinear"] - plain) for run in mine if run["kind"] == kind]


def visible_from(rows: list[tuple[float, float]]) -> float | None:
    """Give the size from which the added misfit is seen, between two sizes by powers; None where none reaches it."""
    before: tuple[float, float] | None = None
    for size, misfit in rows:
        if misfit >= VISIBLE:
            if before is None or before[1] <= 0.0:
                return size
            share = log(VISIBLE / before[1]) / log(misfit / before[1])
            return exp(log(before[0]) + share * log(size / before[0]))
        before = size, misfit
    return None


def judged(runs: list[Any], release: float) -> dict[str, tuple[float | None, float]]:
    """
    Give by disturbance the size from which both round bodies have the paper's misfit, and the prism's up to there.

    The prism's is the largest up to the first of its sizes that is as large. None instead of the size if a round body
    never has that misfit, or the prism's is not `WORSE` times less.
    """
    found = {}
    for kind in dict.fromkeys(run["kind"] for run in runs if run["kind"] != "none"):
        prism = added(runs, release, "prism", kind) or [(0.0, 0.0)]
        sizes = [visible_from(added(runs, release, specimen, kind)) for specimen in ROUND]
        needed = None if None in sizes else max(size for size in sizes if size is not None)
        beyond = min((size for size, _ in prism if needed is not None and size >= needed), default=prism[-1][0])
        largest = max(misfit for size, misfit in prism if size <= beyond)
        kept = needed if needed is not None and largest <= VISIBLE / WORSE else None
        found[kind] = kept, largest
    return found


def verdict(runs: list[Any], release: float) -> list[str]:
    """Name the disturbances that give the paper's misfit, with their sizes, and those that do not."""
    found = judged(runs, release)
    yes = {kind: size for kind, (size, _) in found.items() if size is not None}
    lines = [
        f"Released at {release:g} α, these add {100 * VISIBLE:g} % of α to the misfit of cylinder and cone, and less",
        "than half of that to the prism's, which is the paper's order:" + ("" if yes else " none."),
        "",
    ]
    for kind, size in yes.items():
        name, written = KINDS[kind]
        grows = f"the prism's misfit grows by up to {100.0 * max(0.0, found[kind][1]):.1f}"
        if not added(runs, release, "prism", kind):
            grows = "the prism has no round base"
        less = "from less than" if size <= min(_sizes(runs, kind)) else "from"
        lines.append(f"- {name}, {less} {written(float(f'{size:.2g}'))}; {grows}.")
    no = [f"{KINDS[kind][0]} up to {KINDS[kind][1](max(_sizes(runs, kind)))}" for kind in found if kind not in yes]
    return [*lines, "", "These do not: " + "; ".join(no) + "."] if no else lines


def _sizes(runs: list[Any], kind: str) -> list[float]:
    return [run["size"] for run in runs if run["kind"] == kind]
