"""The study of the contact model as a page of text: every number from what was measured."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

from contact_model.convergence import COLLAPSING, FINEST, FRACTION, scatter, step_errors
from contact_model.damping import PAPER, from_peaks
from contact_model.drawings import named
from contact_model.free import MESHES, RELEASE, TARGET
from contact_model.misfit_words import misfit_lines
from contact_model.observed import observed_lines
from contact_model.speed import PAPERS_SECONDS

COLLAPSED = 1e-3
"""Scatter of e below which bodies count as alike."""


def page(found: dict[str, Any], drawn: dict[str, str]) -> str:
    """Write what was measured, with the figures' file names by part."""
    lines = [
        "# The contact model: damping, convergence, what it costs, and what it shows",
        "",
        "Made by `make study NAME=contact`. Prism of the paper (86 × 86 × 456 mm, 26.10 kg, g = 9.81 m/s²), free",
        f"rocking from {RELEASE:g} α unless another is given, friction 0.6, stiffness such that the standing prism",
        "sinks by 1e-6 of the height of its centre of mass (0.15 N/µm per mm² of base), called 1 below; the default",
        "law is ten times as stiff. A calibrated contact",
        "has the stiffness, fraction and modes that `colonnade calibrate` finds, and the e identified from θ; the e of",
        "all other runs is of the velocities at their first impacts. A step is the longest up to the one named that",
        "divides the sampling interval. Costs are seconds of processor time, one thread, on a loaded machine of two",
        "cores.",
        "",
        *_dated(found["dates"]),
        "",
        *_table(found),
        *_unreduced(found),
        *observed_lines(found["observed"]),
        *_convergence(found, drawn["convergence"]),
        *_collapse(found, drawn["collapse"]),
        *_amplitude(found, drawn["amplitude"]),
        *misfit_lines(found["misfit"], found["controls"], drawn["misfit"]),
        *_speed(found),
    ]
    return "\n".join(lines) + "\n"


def _dated(dates: dict[str, str]) -> list[str]:
    days = sorted(set(dates.values()))
    return [f"Measured on {day}: {', '.join(part for part in dates if dates[part] == day)}." for day in days]


def _table(found: dict[str, Any]) -> list[str]:
    lines = [
        f"## The damping fraction that gives e = {TARGET} (the paper's Table 2)",
        "",
        "Stiffness in multiples of 1; where that gives the e for no fraction from 0 to 4, a harder or softer one is",
        "taken. Modes are those that the step follows with that law. Cost: 10 s of free vibration, scaled from a",
        "shorter one; the paper does not say how long its own is.",
        "",
        "| body | step, µs | stiffness | CDF ξ | ξ_eff | e | modes | energy missing | cost, s | paper: CDF, cost |",
        "|---|---|---|---|---|---|---|---|---|---|",
    ]
    for cell in found["table"]:
        paper = PAPER.get((cell["body"], cell["step"]))
        told = f"{paper[0]:.2f}, {paper[1]}" if paper else "–"
        start = f"| {named(cell['body'])} | {1e6 * cell['step']:g} "
        if cell["damping_fraction"] is None:
            lines.append(start + f"| – | none found | – | – | – | – | – | {told} |")
            continue
        e = f"{cell['restitution']:.4f}" + ("" if cell["agrees"] else " (nearest)")
        lines.append(
            start + f"| {cell['multiple']:g} | {cell['damping_fraction']:.3g} | {cell['effective_damping']:.3f} | {e} "
            f"| {cell['modes']} | {cell['residual']:.1e} | {cell['cost']:.2g} | {told} |"
        )
    lines += ["", *_remarks(found["table"]), ""]
    lines += [
        "Our meshes with the paper's own fractions, stiffness 1:",
        "",
        "| mesh | step, µs | CDF ξ | ξ_eff | modes | e | energy missing |",
        "|---|---|---|---|---|---|---|",
    ]
    for run in found["papers"]:
        lines.append(
            f"| {run['body']} | {1e6 * run['step']:.3g} | {run['damping_fraction']:g} | {run['effective_damping']:.3f} "
            f"| {run['modes']} | {run['restitution']:.4f} | {run['residual']:.1e} |"
        )
    return [*lines, ""]


def _remarks(cells: list[Any]) -> list[str]:
    """Say what is unstable, what is not reached, and where the meshes differ from the paper."""
    lines = []
    for cell in cells:
        start = f"- {named(cell['body'])} at {1e6 * cell['step']:g} µs: stiffness 1 "
        reached = cell.get("reached")
        if reached == []:
            lines.append(f"{start}is unstable with every fraction.")
        elif reached and cell.get("multiple") != 1.0:
            lines.append(f"{start}gives e from {reached[0]:.4f} to {reached[1]:.4f} where it is stable.")
    rigid_only = [f"{named(cell['body'])}" for cell in cells if cell["step"] > 5e-5 and cell.get("modes") == 0]
    if rigid_only:
        lines.append(
            f"- At 100 µs no elastic mode of steel is followed; what remains is a rigid body on the nodes of the mesh "
            f"({', '.join(rigid_only)})."
        )
    return lines


def _unreduced(found: dict[str, Any]) -> list[str]:
    lines = [
        "### The unreduced finite elements, and a step of 100 µs",
        "",
        "One impact, e from the peaks before and after it. Steel at half its stable step; then modulus and contact",
        "stiffness lowered together until 100 µs is stable, with the paper's fractions for 10 and for 100 µs.",
        "",
        "| mesh | modulus, GPa | stable step, µs | step taken, µs | CDF ξ | e | energy missing |",
        "|---|---|---|---|---|---|---|",
    ]
    for run in found["unreduced"]:
        lines.append(
            f"| {run['mesh']} | {run['modulus'] / 1e9:.3g} | {1e6 * run['stable']:.3g} | {1e6 * run['step']:.3g} "
            f"| {run['damping_fraction']:g} | {_number(run['restitution'])} | {run['residual']:.1e} |"
        )
    lines.append("")
    steel = [run for run in found["unreduced"] if run["modulus"] > 1e11]
    for run in steel:
        lines += _beside(run, found["papers"])
    soft = [run["modulus"] for run in found["unreduced"] if run["modulus"] <= 1e11]
    if steel and soft:
        lines += [
            f"Explicit steel elements are stable up to {1e6 * max(run['stable'] for run in steel):.2g} µs. A step of "
            f"100 µs needs a modulus {steel[0]['modulus'] / max(soft):.0f} to {steel[0]['modulus'] / min(soft):.0f}",
            "times lower (more mass or an implicit scheme would do as well), and its e is then another one. Neither",
            "the paper's column of 100 µs nor that of 10 µs can be explicit elements of steel as it describes them.",
            "",
        ]
    return lines


def _number(value: float | None) -> str:
    return "does not rock back" if value is None else f"{value:.4f}"


def _beside(run: Any, papers: list[Any]) -> list[str]:
    """Set the unreduced run beside the reduced one of the same mesh and fraction with the shortest step."""
    alike = [
        each
        for each in papers
        if each["body"] == run["mesh"] and each["damping_fraction"] == run["damping_fraction"] and each["peaks"]
    ]
    if not alike:
        return []
    reduced = min(alike, key=lambda each: float(each["step"]))
    own = from_peaks(RELEASE, reduced["peaks"][0])
    return [
        f"Unreduced {run['mesh']} mesh: e = {_number(run['restitution'])} from its peaks; the reduced one with "
        f"{reduced['modes']} modes at {1e6 * reduced['step']:.2g} µs has {own:.4f} by",
        f"the same peaks, and {reduced['restitution']:.4f} by the velocities at its impacts.",
        "",
    ]


def _convergence(found: dict[str, Any], figure: str) -> list[str]:
    lines = [
        "## Convergence",
        "",
        f"ξ = {FRACTION}. Against the shortest step, three impacts:",
        "",
        "| body | modes | step, µs | error of e | of the peaks, of α |",
        "|---|---|---|---|---|",
    ]
    orders = []
    for series in step_errors(found["steps"]):
        for row in series["rows"]:
            lines.append(
                f"| {named(series['body'])} | {series['modes']} | {1e6 * row['step']:.3g} | {row['e']:.1e} "
                f"| {row['peaks']:.1e} |"
            )
        orders.append(
            f"{named(series['body'])} {series['orders']['e']:.1f} (e) and {series['orders']['peaks']:.1f} (peaks)"
        )
    lines += [
        "",
        f"Observed orders in the step: {'; '.join(orders)}.",
        "",
        "Modes of the coarse mesh, step 1 µs:",
        "",
        "| modes | e | energy missing |",
        "|---|---|---|",
    ]
    lines += [f"| {run['modes']} | {run['restitution']:.5f} | {run['residual']:.1e} |" for run in found["modes"]]
    last = found["modes"][-1]["restitution"]
    enough = next(
        run["modes"]
        for place, run in enumerate(found["modes"])
        if all(abs(other["restitution"] - last) <= 2e-4 for other in found["modes"][place:])
    )
    lines += [
        "",
        f"From {enough} modes on e is that of {found['modes'][-1]['modes']} to 2e-4; with all 112 of them 1 µs is "
        "unstable.",
        "",
        "Nodes of the base and meshes, step 10 µs:",
        "",
        "| body | modes | ξ_eff | e | energy missing |",
        "|---|---|---|---|---|",
    ]
    lines += [
        f"| {named(run['body'])} | {run['modes']} | {run['effective_damping']:.3f} | {run['restitution']:.4f} "
        f"| {run['residual']:.1e} |"
        for run in found["nodes"]
    ]
    grids = [run["restitution"] for run in found["nodes"] if run["body"] not in MESHES]
    if len(grids) > 2:
        lines += [
            "",
            f"Each finer grid adds {', '.join(f'{b - a:+.4f}' for a, b in pairwise(grids))} to e: "
            "an impact on inner nodes takes",
            "less than one on the far edge alone (Housner's). A coarse grid is part of the model, as ξ is;",
            "the last differences tell where a grid is fine enough.",
        ]
    return [*lines, "", f"![Convergence]({figure})", ""]


def _collapse(found: dict[str, Any], figure: str) -> list[str]:
    runs = found["collapse"]
    lines = [
        "## Does ξ_eff make all bodies alike?",
        "",
        "| ξ_eff | e of all bodies | scatter | e of the three meshes | scatter | e of the two finest | scatter |",
        "|---|---|---|---|---|---|---|",
    ]
    groups = [
        {row["effective_damping"]: row for row in scatter(runs, chosen)} for chosen in (COLLAPSING, MESHES, FINEST)
    ]
    for effective in groups[0]:
        ranges = (_range(group[effective]) if effective in group else "– | –" for group in groups)
        lines.append(f"| {effective:g} | {' | '.join(ranges)} |")
    worst, between, finest = (
        max((row["highest"] - row["lowest"] for row in group.values()), default=0.0) for group in groups
    )
    lines += [
        "",
        f"{'Yes' if worst <= COLLAPSED else 'No'}: at one ξ_eff e scatters by up to {worst:.4f} over all bodies, and "
        f"by up to {between:.4f} over the three",
        f"meshes; {COLLAPSED:g} would count as alike. What matters beside ξ_eff is the number of nodes along the base:",
        f"the two bodies with the most of them, one rigid and one elastic, are within {finest:.4f} of each other.",
        "",
        f"![e over ξ_eff]({figure})",
        "",
    ]
    return lines


def _range(row: Any) -> str:
    return f"{row['lowest']:.4f} to {row['highest']:.4f} | {row['highest'] - row['lowest']:.4f}"


def _amplitude(found: dict[str, Any], figure: str) -> list[str]:
    law, ensemble = found["law"], found["ensemble"]
    released = [(run["release"], run["restitution"]) for run in found["amplitudes"]]
    low, middle, high = ensemble["restitution"]
    lines = [
        "## e over amplitude, friction and disturbance",
        "",
        f"Rigid prism on 5 × 5 nodes with the default stiffness, calibrated to e = {TARGET}: "
        f"ξ = {law['damping_fraction']:.3f}.",
        "",
        "| released at, of α | " + " | ".join(f"{release:g}" for release, _ in released) + " |",
        "|---|" + "---|" * len(released),
        "| e | " + " | ".join(f"{e:.4f}" for _, e in released) + " |",
        "",
        f"e is not a constant of the contact: it falls from {released[0][1]:.4f} for the smallest of these releases to "
        f"{released[-1][1]:.4f} for the largest.",
        "",
        "| friction µ | e | change of θ, of α |",
        "|---|---|---|",
    ]
    lines += [
        f"| {run['friction']:g} | {run['restitution']:.4f} | {run['largest_change']:.1e} |" for run in found["friction"]
    ]
    lines += [
        "",
        "| rotation about x at the start, of α | e | change of θ, of α | largest rotation about x, of α |",
        "|---|---|---|---|",
    ]
    lines += [
        f"| {run['disturbance']:.2%} | {run['restitution']:.4f} | {run['largest_change']:.1e} "
        f"| {run['out_of_plane']:.1e} |"
        for run in found["disturbance"]
    ]
    ranks = ", ".join(f"{name.replace('_', ' ')} {value:+.2f}" for name, value in ensemble["correlations"].items())
    lines += [
        "",
        f"Changes of θ are the largest within 3.4 s, against µ = 0.6 and a straight start. An ensemble of "
        f"{ensemble['members']} (µ from {ensemble['friction'][0]:g} to",
        f"{ensemble['friction'][1]:g}, ξ ± 20 %, disturbance up to 2 % of α) has e = {middle:.4f}, nine in ten from "
        f"{low:.4f} to {high:.4f}, and θ within {100 * ensemble['band']:.1f} % of α;",
        f"rank correlations with e: {ranks}.",
        "",
        f"![e over amplitude, friction and disturbance]({figure})",
        "",
    ]
    return lines


def _speed(found: dict[str, Any]) -> list[str]:
    lines = [
        "## Speed",
        "",
        "| engine | modes or degrees of freedom | step, µs | seconds for a second of motion |",
        "|---|---|---|---|",
    ]
    for row in found["speed"]:
        engine = row["engine"]
        name = named(engine) if "," not in engine else engine
        lines.append(f"| {name} | {row['modes']} | {1e6 * row['step']:.3g} | {row['cost']:.3g} |")
    costs = {row["engine"]: row["cost"] for row in found["speed"]}
    reduced = max(costs[mesh] for mesh in MESHES if mesh in costs)
    rigid = costs["5 × 5"]
    lines += [
        "",
        f"Goals: rigid at most 1 ({'met' if rigid <= 1.0 else 'missed'}), reduced elastic at most 5 "
        f"({'met' if reduced <= 5.0 else 'missed'}). Unreduced rows are scaled from 400",
        "steps at their own step; impacts cost more. "
        f"The paper gives {PAPERS_SECONDS:g} s for one free vibration with its medium mesh at 10 µs, on a computer of "
        "its time.",
    ]
    return lines
