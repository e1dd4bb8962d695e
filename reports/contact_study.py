"""Study the contact model: `python reports/contact_study.py [FOLDER] [--only PART ...] [--workers N]`."""

from __future__ import annotations

import argparse
import json
import os
from collections.abc import Callable
from dataclasses import asdict
from datetime import date
from pathlib import Path
from typing import Any

os.environ.setdefault("OMP_NUM_THREADS", "1")

from colonnade.dynamics.contact.law import ContactLaw
from contact_model import convergence, damping, disturbed, drawings, space, speed
from contact_model.free import PRISM
from contact_model.observed import measure_observed
from contact_model.page import page
from contact_model.summary import summary
from study import HERE, renewed, rounded, write_figure, write_numbers

DOCUMENT = HERE.parent / "docs" / "explanation" / "contact.md"
MARKS = "<!-- measured: begin -->", "<!-- measured: end -->"
NAME = "contact-study"
DIGITS = 7
"""Of each number that is kept."""

FIGURES: dict[str, tuple[Callable[[dict[str, Any]], Any], str, str]] = {
    "convergence": (
        drawings.draw_convergence,
        "Convergence of the contact model in step, modes and nodes",
        "Errors fall with the step; a few modes are enough; more nodes along the base give a larger restitution.",
    ),
    "collapse": (
        drawings.draw_collapse,
        "Restitution over the effective damping fraction",
        "A line for each rigid grid and each elastic mesh: finer ones lie higher.",
    ),
    "amplitude": (
        drawings.draw_amplitude,
        "Restitution over release, friction and disturbance",
        "The calibrated rigid prism: e is larger at small amplitudes.",
    ),
    "misfit": (
        drawings.draw_misfit,
        "Misfit of plane rocking over the disturbance",
        "Prism, cylinder and cone released at 0.9 α with a push, spin, tilted table, uneven or oval base.",
    ),
}

PARTS: dict[str, Callable[[ContactLaw, int], Any]] = {
    "table": lambda _, workers: damping.measure_table(workers=workers),
    "papers": lambda _, workers: damping.measure_papers_fractions(workers=workers),
    "unreduced": lambda _, workers: damping.measure_unreduced(),
    "observed": lambda _, workers: measure_observed(),
    "steps": lambda _, workers: convergence.measure_steps(workers=workers),
    "modes": lambda _, workers: convergence.measure_modes(workers=workers),
    "nodes": lambda _, workers: convergence.measure_nodes(workers=workers),
    "collapse": lambda _, workers: convergence.measure_collapse(workers=workers),
    "amplitudes": lambda law, workers: space.measure_amplitudes(law, workers=workers),
    "friction": lambda law, workers: space.measure_friction(law, workers=workers),
    "disturbance": lambda law, workers: space.measure_disturbance(law, workers=workers),
    "ensemble": lambda law, workers: space.measure_ensemble(law, workers=workers),
    "misfit": lambda _, workers: disturbed.measure_misfit(workers=workers),
    "controls": lambda _, workers: disturbed.measure_controls(workers=workers),
    "speed": lambda _, workers: speed.measure_speed(),
}
"""What is measured; `law` is the calibrated one of the rigid prism."""


def measure(only: list[str], kept: dict[str, Any], workers: int) -> dict[str, Any]:
    """Measure parts anew and keep the others."""
    law = ContactLaw(**kept["law"]) if "law" in kept else space.calibrated(PRISM)
    today = date.today().isoformat()
    dates = kept.get("dates", {}) | dict.fromkeys(only, today)
    return kept | {"law": asdict(law)} | {part: PARTS[part](law, workers) for part in only} | {"dates": dates}


def write(found: dict[str, Any], folder: Path) -> None:
    """Write page, numbers and figures into a folder."""
    write_numbers(folder / f"{NAME}.json", rounded(found, DIGITS))
    drawn = {}
    for part, (draw, title, described) in FIGURES.items():
        drawn[part] = f"contact-{part}.svg"
        write_figure(folder / drawn[part], draw(found), title, described)
    (folder / f"{NAME}.md").write_text(page(found, drawn), encoding="utf-8")


def main() -> None:
    """Measure and write."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path, nargs="?", default=HERE)
    parser.add_argument("--only", nargs="+", choices=tuple(PARTS), default=list(PARTS), help="the others are kept")
    parser.add_argument("--workers", type=int, default=2)
    told = parser.parse_args()
    numbers = told.folder / f"{NAME}.json"
    kept = json.loads(numbers.read_text(encoding="utf-8")) if len(told.only) < len(PARTS) and numbers.exists() else {}
    found = rounded(measure(told.only, kept, told.workers), DIGITS)
    write(found, told.folder)
    if told.folder == HERE:
        DOCUMENT.write_text(renewed(DOCUMENT.read_text(encoding="utf-8"), MARKS, summary(found)), encoding="utf-8")


if __name__ == "__main__":
    main()
