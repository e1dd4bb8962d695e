"""The e of the contact's own impacts beside the one that a laboratory would identify from θ."""

from __future__ import annotations

from typing import Any

from colonnade import identify_restitution
from colonnade.dynamics.contact.calibration import free_restitution
from contact_model.drawings import named
from contact_model.free import PRISM, law_for, prism_body, timed, with_modes

CASES = (
    ("5 × 5", 0.25, 1.0),
    ("17 × 17", 0.4, 1.0),
    ("coarse", 0.4, 1.0),
    ("coarse", 2.0, 1.0),
    ("medium", 0.4, 1.0),
    ("medium", 2.25, 10.0),
)
"""Body, ξ, stiffness."""
STEP = 1e-5


def measure_observed(cases: tuple[tuple[str, float, float], ...] = CASES, duration: float = 3.0) -> list[Any]:
    """Run each case and identify e from its θ."""
    found = []
    for name, fraction, multiple in cases:
        body = prism_body(name)
        law = law_for(body, fraction, multiple=multiple)
        history, _ = timed(with_modes(body, law, STEP), law, STEP, duration)
        found.append(
            {
                "body": name,
                "damping_fraction": fraction,
                "multiple": multiple,
                "own": free_restitution(history),
                "fitted": identify_restitution(history.time, history.angle, PRISM).value,
                "airborne": history.airborne / duration,
                "residual": history.energies.relative_residual,
            }
        )
    return found


def observed_lines(runs: list[Any]) -> list[str]:
    """Tell both, and how far they are apart."""
    lines = [
        "### Two kinds of e",
        "",
        "An e of velocities just before and after each impact, 3 s at 10 µs, is not the one that is identified from θ,",
        "as by the calibration: a block that bounces changes its energy beyond that instant.",
        "",
        "| body | stiffness | ξ | e of the velocities | e identified from θ | time in the air | energy missing |",
        "|---|---|---|---|---|---|---|",
    ]
    for run in runs:
        fitted = "refused" if run["fitted"] is None else f"{run['fitted']:.4f}"
        lines.append(
            f"| {named(run['body'])} | {run['multiple']:g} | {run['damping_fraction']:g} | {run['own']:.4f} | {fitted} "
            f"| {run['airborne']:.1%} | {run['residual']:.1e} |"
        )
    gaps = [abs(run["fitted"] - run["own"]) for run in runs if run["fitted"] is not None]
    open_ = [named(run["body"]) for run in runs if run["residual"] > 0.01]
    lines += ["", f"They are up to {max(gaps):.4f} apart."]
    if open_:
        lines.append(f"The balance of energy does not close to 1 % within these 3 s: {', '.join(open_)}.")
    return [*lines, ""]
