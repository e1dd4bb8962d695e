"""The paper's two tables and its slips, recomputed: no test is needed for these."""

from __future__ import annotations

from math import cos, sqrt, tan
from typing import Any

from colonnade.dynamics.block import STANDARD_GRAVITY
from colonnade.dynamics.contact.elastic.assembly import STEELS_MODULUS, STEELS_POISSON_RATIO
from colonnade.dynamics.contact.elastic.mesh import PAPERS_DEGREES_OF_FREEDOM
from colonnade.dynamics.contact.elastic.model import mesh_of
from reproduction.printed import LAST_DIGIT, SIZES, TABLE_1, TABLE_2

Numbers = dict[str, Any]


def modulus_for(step: float, stable: float) -> float:
    """Give the modulus (Pa) with which a mesh that is stable up to `stable` in steel is stable up to `step` (s)."""
    return STEELS_MODULUS * (stable / step) ** 2


def specimens() -> Numbers:
    """Give each specimen's properties from its dimensions, and what the printed columns give."""
    found = {}
    for name, (block, volume, printed) in TABLE_1.items():
        alpha = block.critical_angle
        found[name] = {
            "density": block.mass / volume,
            **{quantity: getattr(block, quantity) for quantity in LAST_DIGIT},
            "tangent": tan(alpha),
            "centre_height": block.pole_distance * cos(alpha),
            "rigid_restitution": block.restitution,
            "p_of_printed": sqrt(block.mass * STANDARD_GRAVITY * printed["pole_distance"] / printed["inertia"]),
        }
    return found


def table_2(study: Numbers) -> list[Numbers]:
    """Lay each cell of the paper's Table 2 beside the one that the contact study found, which holds the numbers."""
    ours = {(cell["body"], cell["step"]): cell for cell in study["table"]}
    rows = []
    for ((mesh, step), (fraction, cost)), run in zip(TABLE_2.items(), study["papers"], strict=True):
        cell = ours[mesh, step]
        rows.append(
            {
                "mesh": mesh,
                "step": step,
                "printed_fraction": fraction,
                "printed_cost": cost,
                "fraction": cell["damping_fraction"],
                "restitution": cell.get("restitution"),
                "multiple": cell.get("multiple"),
                "cost": cell.get("cost"),
                "restitution_with_printed": run["restitution"],
            }
        )
    return rows


def stable_steps() -> list[Numbers]:
    """
    Estimate the longest stable explicit step of each mesh: the shortest edge over the speed of sound in steel.

    The speed is that of pressure waves, sqrt(E (1 − ν) / (ρ (1 + ν) (1 − 2 ν))).
    """
    density = TABLE_1["prism"].block.mass / TABLE_1["prism"].volume
    nu = STEELS_POISSON_RATIO
    speed = sqrt(STEELS_MODULUS * (1 - nu) / (density * (1 + nu) * (1 - 2 * nu)))
    rows = []
    for name, printed in PAPERS_DEGREES_OF_FREEDOM.items():
        mesh = mesh_of(SIZES, name)
        corners = mesh.points[mesh.cells[0]]
        edge = min(float(side) for side in corners.max(axis=0) - corners.min(axis=0))
        step = edge / speed
        rows.append(
            {
                "mesh": name,
                "printed_degrees_of_freedom": printed,
                "degrees_of_freedom": mesh.degrees_of_freedom,
                "description": mesh.description,
                "edge": edge,
                "speed": speed,
                "step": step,
            }
        )
    return rows
