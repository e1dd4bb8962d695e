"""Statements on the specimens: Table 1, cell by cell, and the slips in it."""

from __future__ import annotations

from colonnade.dynamics.block import STANDARD_GRAVITY
from reproduction.printed import LAST_DIGIT, TABLE_1
from reproduction.statement import Answer, Numbers, Statements, judged

stated = Statements("tables")

UNITS = {"critical_angle": "rad", "pole_distance": "m", "inertia": "kg m²", "p": "rad/s"}
QUANTITIES = {
    "critical_angle": "critical angle",
    "pole_distance": "distance of the centre of mass from the pole",
    "inertia": "moment of inertia about the pole",
    "p": "natural rocking frequency p",
}
DIGITS = {"critical_angle": 4, "pole_distance": 4, "inertia": 3, "p": 3}

STEEL = (7700.0, 7900.0)
"""Density of steels, kg/m³."""


def percent_off(printed: float, ours: float) -> str:
    """Write by how much a printed value differs from ours."""
    return f"{round(100 * (printed / ours - 1), 2) + 0.0:+.2f} %"


def _cell(specimen: str, quantity: str, printed: float) -> None:
    unit, digits = UNITS[quantity], DIGITS[quantity]

    @stated(
        "Table 1",
        f"The {specimen}'s {QUANTITIES[quantity]} is {printed:g} {unit}.",
        "computed from the dimensions and the mass, rigid body, g = 9.81 m/s²",
        f"ours is within one unit of the last printed digit, {LAST_DIGIT[quantity]:g} {unit}",
        name=f"table-1-{specimen}-{quantity.replace('_', '-')}",
    )
    def answer(numbers: Numbers) -> Answer:
        ours = float(numbers["specimens"][specimen][quantity])
        return judged(
            abs(ours - printed) <= LAST_DIGIT[quantity],
            f"{ours:.{digits}f} {unit}; the table is {percent_off(printed, ours)} off",
        )


@stated(
    "1",
    "The specimens are solid and of steel.",
    "mass over the volume of the printed dimensions",
    f"all three densities are between {STEEL[0]:g} and {STEEL[1]:g} kg/m³",
)
def _steel(numbers: Numbers) -> Answer:
    found = {name: each["density"] for name, each in numbers["specimens"].items()}
    words = ", ".join(f"{name} {density:.0f}" for name, density in found.items())
    return judged(all(STEEL[0] <= density <= STEEL[1] for density in found.values()), f"{words} kg/m³")


for specimen, row in TABLE_1.items():
    for quantity, printed in row.printed.items():
        _cell(specimen, quantity, printed)


@stated(
    "Table 1",
    "The column headed critical rocking angle (rad) holds angles.",
    "compared with half the base over the height of the centre of mass",
    "the printed values are not the tangents, to one unit of the last digit",
)
def _critical_angles_are_angles(numbers: Numbers) -> Answer:
    rows = {
        name: (each["tangent"], TABLE_1[name].printed["critical_angle"]) for name, each in numbers["specimens"].items()
    }
    words = ", ".join(f"{name} tan α = {tangent:.4f}, printed {printed:g}" for name, (tangent, printed) in rows.items())
    are_tangents = all(abs(tangent - printed) <= LAST_DIGIT["critical_angle"] for tangent, printed in rows.values())
    return judged(not are_tangents, f"the printed values are the tangents: {words}")


@stated(
    "Table 1",
    "The column headed distance of the centre of mass from the pole holds distances, of cylinder and cone too.",
    "compared with the height of the centre of mass",
    "the printed values are not those heights, to one unit of the last digit",
)
def _distances_are_distances(numbers: Numbers) -> Answer:
    rows = {
        name: (numbers["specimens"][name]["centre_height"], TABLE_1[name].printed["pole_distance"])
        for name in ("cylinder", "cone")
    }
    words = ", ".join(
        f"{name} {1e3 * height:.1f} mm high, printed {1e3 * printed:.0f} mm" for name, (height, printed) in rows.items()
    )
    are_heights = all(abs(height - printed) <= LAST_DIGIT["pole_distance"] for height, printed in rows.values())
    return judged(not are_heights, f"the printed values are heights of the centre of mass: {words}")


@stated(
    "Table 1",
    "p is the root of weight times distance over moment of inertia.",
    "formed from the printed columns",
    "all three give the printed p, to one unit of the last digit",
)
def _p_follows_from_its_columns(numbers: Numbers) -> Answer:
    found = {name: each["p_of_printed"] for name, each in numbers["specimens"].items()}
    words = ", ".join(f"{name} {value:.3f}" for name, value in found.items())
    same = all(abs(value - TABLE_1[name].printed["p"]) <= LAST_DIGIT["p"] for name, value in found.items())
    return judged(same, f"sqrt(W R / I) of the printed columns, W = {STANDARD_GRAVITY} m: {words} rad/s")


@stated(
    "Table 1",
    "All three specimens have one p, 5.631 rad/s.",
    "from the dimensions",
    "the three p differ by no more than one unit of the last digit",
)
def _one_p_for_all(numbers: Numbers) -> Answer:
    found = {name: each["p"] for name, each in numbers["specimens"].items()}
    spread = max(found.values()) - min(found.values())
    return judged(
        spread <= LAST_DIGIT["p"],
        "from the dimensions " + ", ".join(f"{name} {value:.3f}" for name, value in found.items()) + " rad/s",
    )


@stated(
    "2.2",
    "The prism's critical angle is 0.1886 rad, by which its rocking angle is divided in the figures.",
    "from the dimensions",
    "ours is within one unit of the last digit",
)
def _critical_angle_in_the_text(numbers: Numbers) -> Answer:
    ours = numbers["specimens"]["prism"]
    return judged(
        abs(ours["critical_angle"] - 0.1886) <= LAST_DIGIT["critical_angle"],
        f"{ours['critical_angle']:.4f} rad; 0.1886 is its tangent, {ours['tangent']:.4f}",
    )
