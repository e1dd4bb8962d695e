"""How the contact model converges in step, modes and nodes; and whether ξ_eff makes all bodies alike."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any

import numpy as np
from joblib import Parallel, delayed

from contact_model.free import MESHES, FreeRun, law_for, prism_body, vibrate

FRACTION = 0.4
DURATION = 1.2
"""s: three impacts, two whole arcs after the first."""

STEPS = {
    "5 × 5": (2e-5, 1e-5, 5e-6, 2.5e-6, 1.25e-6, 3.125e-7),
    "coarse": (2e-5, 1e-5, 5e-6, 2.5e-6, 6.25e-7),
}
"""The last is what the others are measured against."""

MODES = (0, 2, 4, 7, 12, 20, 30, 45, 60)
"""Of the coarse mesh, which has 112; with all of them 1 µs is unstable."""
FINE_STEP = 1e-6

GRIDS = ("2 × 2", "3 × 3", "5 × 5", "9 × 9", "17 × 17", "33 × 33")

COLLAPSING = ("2 × 2", "3 × 3", "5 × 5", "9 × 9", "17 × 17", *MESHES)
FINEST = ("17 × 17", "fine")
"""The rigid and the elastic body with the most nodes along the base."""
DAMPING = (0.0, 0.03, 0.1, 0.2, 0.4, 0.7, 1.0, 2.0, 3.0)
SCATTER_AT = (0.03, 0.1, 0.2, 0.3)
"""ξ_eff at which the bodies' e are compared."""


def measure_steps(steps: dict[str, tuple[float, ...]] | None = None, workers: int = 1) -> list[Any]:
    """Run bodies, each with the modes that its longest step follows, at shorter and shorter steps."""
    jobs = []
    for name, series in (STEPS if steps is None else steps).items():
        body = prism_body(name)
        law = law_for(body, FRACTION)
        kept = vibrate(name, body, law, series[0], 0.01).modes
        jobs += [delayed(vibrate)(name, body, law, step, DURATION, modes=kept) for step in series]
    return [asdict(run) for run in Parallel(n_jobs=workers)(jobs)]


def measure_modes(modes: tuple[int, ...] = MODES, duration: float = 0.75, workers: int = 1) -> list[Any]:
    """Run the coarse mesh with more and more modes, at a step that is short for all of them."""
    body = prism_body("coarse")
    law = law_for(body, FRACTION)
    jobs = (delayed(vibrate)("coarse", body, law, FINE_STEP, duration, modes=count) for count in modes)
    return [asdict(run) for run in Parallel(n_jobs=workers)(jobs)]


def measure_nodes(bodies: tuple[str, ...] = (*GRIDS, *MESHES), workers: int = 1) -> list[Any]:
    """Run finer and finer grids and meshes at 10 µs."""
    jobs = []
    for name in bodies:
        body = prism_body(name)
        jobs.append(delayed(vibrate)(name, body, law_for(body, FRACTION), 1e-5, DURATION))
    return [asdict(run) for run in Parallel(n_jobs=workers)(jobs)]


def measure_collapse(
    bodies: tuple[str, ...] = COLLAPSING, fractions: tuple[float, ...] = DAMPING, workers: int = 1
) -> list[Any]:
    """Run all bodies with many damping fractions at 10 µs; those that the step does not follow are left out."""
    pool = Parallel(n_jobs=workers)
    found = pool(delayed(_stable)(name, prism_body(name), fraction) for name in bodies for fraction in fractions)
    return [asdict(run) for run in found if run is not None]


def _stable(name: str, body: Any, fraction: float) -> FreeRun | None:
    try:
        return vibrate(name, body, law_for(body, fraction), 1e-5, DURATION)
    except ValueError:
        return None


def step_errors(runs: list[Any]) -> list[Any]:
    """Give each run's error of e and of the peaks (of α) against the last of its body, and the observed orders."""
    found = []
    for name in dict.fromkeys(run["body"] for run in runs):
        series = [run for run in runs if run["body"] == name]
        finest = series[-1]
        rows = []
        for run in series[:-1]:
            pairs = zip(run["peaks"], finest["peaks"], strict=False)
            peak = max(abs(one - other) for one, other in pairs)
            rows.append({"step": run["step"], "e": abs(run["restitution"] - finest["restitution"]), "peaks": peak})
        steps = np.log([row["step"] for row in rows])
        orders = {
            what: float(np.polyfit(steps, np.log([max(row[what], 1e-15) for row in rows]), 1)[0])
            for what in ("e", "peaks")
        }
        found.append({"body": name, "modes": finest["modes"], "finest": finest["step"], "rows": rows, "orders": orders})
    return found


def scatter(runs: list[Any], chosen: tuple[str, ...]) -> list[Any]:
    """Give the range of e over bodies at one ξ_eff after the other, by straight lines between a body's runs."""
    found = []
    for effective in SCATTER_AT:
        values = []
        for name in chosen:
            series = sorted((run["effective_damping"], run["restitution"]) for run in runs if run["body"] == name)
            if len(series) > 1 and series[0][0] <= effective <= series[-1][0]:
                values.append(float(np.interp(effective, *zip(*series, strict=True))))
        if len(values) > 1:
            found.append(
                {"effective_damping": effective, "bodies": len(values), "lowest": min(values), "highest": max(values)}
            )
    return found
