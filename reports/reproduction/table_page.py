"""The paper's tables next to ours, for their page."""

from __future__ import annotations

from reproduction.markdown import fixed, shown
from reproduction.printed import TABLE_1
from reproduction.statement import Numbers
from reproduction.statements.specimens import UNITS, WORDS, percent_off
from reproduction.tables import modulus_for
from study import table


def lines(numbers: Numbers) -> list[str]:
    """Write both tables, printed and computed, and the arithmetic of the time steps."""
    return [*_table_1(numbers), *_table_2(numbers)]


def _table_1(numbers: Numbers) -> list[str]:
    rows = [
        [
            specimen,
            f"{WORDS[quantity]}, {UNITS[quantity]}",
            f"{printed:g}",
            f"{numbers['specimens'][specimen][quantity]:.4f}",
            percent_off(printed, numbers["specimens"][specimen][quantity]),
        ]
        for specimen, row in TABLE_1.items()
        for quantity, printed in row.printed.items()
    ]
    restitution = [
        [specimen, "e of a rigid body without bounce", "–", f"{each['rigid_restitution']:.4f}", "–"]
        for specimen, each in numbers["specimens"].items()
    ]
    return [
        "## Table 1",
        "Computed from dimensions and mass, g = 9.81 m/s².",
        table(("specimen", "quantity", "printed", "computed", "printed over computed"), rows + restitution),
    ]


def _table_2(numbers: Numbers) -> list[str]:
    cells = [
        [
            row["mesh"],
            f"{1e6 * row['step']:g}",
            f"{row['printed_fraction']:.2f}",
            fixed(row["fraction"]),
            "–" if row["multiple"] is None else f"{row['multiple']:g}",
            fixed(row["restitution_with_printed"], 4),
            row["printed_cost"],
            shown(row["cost"], 2),
        ]
        for row in numbers["table_2"]
    ]
    steps = [
        [
            row["mesh"],
            row["printed_degrees_of_freedom"],
            row["description"],
            f"{1e3 * row['edge']:.1f}",
            f"{1e6 * row['step']:.2f}",
            shown(modulus_for(1e-5, row["step"]) / 1e9, 2),
            shown(modulus_for(1e-4, row["step"]) / 1e9, 2),
        ]
        for row in numbers["stable_steps"]
    ]
    speed = numbers["stable_steps"][0]["speed"]
    stable = next(run for run in numbers["unreduced"] if run["mesh"] == "coarse" and run["modulus"] > 1e11)
    return [
        "## Table 2",
        "The critical damping fraction that gives free rocking the analytical e, and what a free vibration costs, in "
        "seconds. Ours are of reduced elastic elements, from [the study of the contact model](../contact-study.md), "
        "which says how they were found; the stiffness of the contact is a multiple of its default. The paper does "
        "not say on which computer it ran, how long its free vibration was, or which stiffness its contact had, so "
        "the columns compare in their trends only.",
        table(
            (
                "mesh",
                "step, µs",
                "CDF, paper",
                "CDF, ours",
                "stiffness",
                "e with the paper's CDF",
                "cost, paper",
                "cost, ours",
            ),
            cells,
        ),
        "An explicit scheme is stable up to about the shortest edge over the speed of pressure waves, here "
        f"{speed:.0f} m/s in steel of 200 GPa. The modulus that a longer step would allow falls with its square.",
        table(("mesh", "DOF, paper", "ours", "edge, mm", "longest step, µs", "GPa for 10 µs", "GPa for 100 µs"), steps),
        f"Measured with the contact (the same study), the coarse mesh of steel is stable up to "
        f"{1e6 * stable['stable']:.2f} µs.",
    ]
