"""Statements on how the paper computes: its own program, and the finite elements with their Table 2."""

from __future__ import annotations

from colonnade.dynamics.contact.elastic import STEELS_MODULUS
from reproduction.printed import CHOSEN_FRACTION, DEGREES_OF_FREEDOM_IN_TEXT, RESTITUTION, TABLE_2
from reproduction.statement import HISTORIES, Answer, Numbers, Statements, judged

stated = Statements("tables")

SAME_FRACTION = 0.25
"""Relative difference of two damping fractions that are called the same."""

SAME_COST = 0.25
"""The same of two ratios of costs."""

CONVERGED = 0.03
"""Of α: largest error of a history that is called converged."""


def modulus_for(step: float, stable: float) -> float:
    """Give the modulus (Pa) with which a mesh that is stable up to `stable` in steel is stable up to `step` (s)."""
    return STEELS_MODULUS * (stable / step) ** 2


def _cdf(mesh: str, step: float) -> None:
    fraction, _ = TABLE_2[mesh, step]

    @stated(
        "Table 2",
        f"With the {mesh} mesh and a step of {step * 1e6:g} µs a critical damping fraction of {fraction:.2f} gives "
        "the analytical free vibration, e = 0.976.",
        "calibration of our reduced elements to e = 0.976 (the study of the contact model)",
        f"ours is within {100 * SAME_FRACTION:g} %",
        name=f"table-2-{mesh}-{step * 1e6:g}us",
    )
    def answer(numbers: Numbers) -> Answer:
        row = _row(numbers, mesh, step)
        if row["fraction"] is None:
            return judged(agrees=False, ours="no stiffness and fraction give this e where the step is stable")
        note = "" if row["multiple"] == 1 else f", with a stiffness {row['multiple']:g} times the default"
        return judged(
            abs(row["fraction"] / fraction - 1) <= SAME_FRACTION,
            f"{row['fraction']:.2f} gives e = {row['restitution']:.4f}{note}",
        )


def _row(numbers: Numbers, mesh: str, step: float) -> Numbers:
    return next(row for row in numbers["table_2"] if (row["mesh"], row["step"]) == (mesh, step))


def _possible(step: float) -> None:
    micro = step * 1e6

    @stated(
        "4, Table 2",
        f"An elastic block of steel on these meshes is integrated with a step of {micro:g} µs (Abaqus; the scheme is "
        "not named).",
        "shortest edge of the mesh over the speed of pressure waves in steel, for an explicit scheme",
        "that is at least the step, for all three meshes",
        name=f"step-of-{micro:g}us-is-possible",
    )
    def answer(numbers: Numbers) -> Answer:
        rows = numbers["stable_steps"]
        words = ", ".join(f"{row['mesh']} {1e6 * row['step']:.1f} µs" for row in rows)
        needed = ", ".join(f"{modulus_for(step, row['step']) / 1e9:.2g}" for row in rows)
        return judged(
            all(row["step"] >= step for row in rows),
            f"longest stable step about {words}; {micro:g} µs would need a modulus of {needed} GPa instead of 200",
        )


@stated(
    "2, 3",
    "The linearised equation is integrated by a single-step and by Hamming's multi-step scheme, whose stability "
    "and convergence a parametric study of methods and steps has verified.",
    "the same two schemes against the exact solution (the study of their convergence)",
    f"both are within {100 * CONVERGED:g} % of α at the paper's step, in free rocking, a sine and a record",
    page="earthquakes",
)
def _two_schemes(numbers: Numbers) -> Answer:
    rows = {
        (row["case"], row["scheme"]): row["error"]
        for row in numbers["convergence"]
        if row["refinement"] == 10 and row["case"] in ("free", "sine", "record")
    }
    words = "; ".join(
        f"{case} {100 * rows[case, 'runge-kutta']:.2f} % and {100 * rows[case, 'hamming']:.2f} %"
        for case in ("free", "sine", "record")
    )
    return judged(
        max(rows.values()) <= CONVERGED,
        f"largest error over α, Runge–Kutta and Hamming, at DT = 1e-4 s: {words}",
    )


@stated(
    "3.2",
    "A step of 1e-4 s, a tenth of it around each full contact, is enough for the earthquake tests.",
    "both schemes with this step on the recorded base motions of the three Spans, against the exact solution",
    f"both are within {100 * CONVERGED:g} % of α in all three",
    page="earthquakes",
)
def _time_step(numbers: Numbers) -> Answer:
    rows = [row for row in numbers["schemes"] if row["step"] > 5e-5]
    words = "; ".join(
        f"Span {row['span']}, {'Runge–Kutta' if row['scheme'] == 'runge-kutta' else 'Hamming'} "
        f"{100 * row['largest_error']:.1f} %"
        for row in rows
    )
    return judged(max(row["largest_error"] for row in rows) <= CONVERGED, f"largest error over α: {words}")


for mesh, step in TABLE_2:
    _cdf(mesh, step)


@stated(
    "4, Table 2",
    f"With the medium or fine mesh and a step of 10 µs or less the fraction is constant, {CHOSEN_FRACTION:.2f}.",
    "our fractions of those cells",
    f"they are within {100 * SAME_FRACTION:g} % of each other",
)
def _fraction_is_constant(numbers: Numbers) -> Answer:
    cells = [("medium", 1e-5), ("medium", 1e-6), ("fine", 1e-5)]
    found = [_row(numbers, *cell)["fraction"] for cell in cells]
    words = ", ".join(
        f"{mesh} {step * 1e6:g} µs {'–' if value is None else f'{value:.2f}'}"
        for (mesh, step), value in zip(cells, found, strict=True)
    )
    known = [value for value in found if value is not None]
    return judged(len(known) == len(cells) and max(known) / min(known) - 1 <= SAME_FRACTION, f"ours: {words}")


@stated(
    "4",
    f"The medium mesh with 10 µs and a fraction of {CHOSEN_FRACTION:.2f}, as in all later runs, has e = "
    f"{RESTITUTION:g}.",
    "the same settings with our reduced elements (the study of the contact model)",
    "e within 0.001",
)
def _chosen_settings(numbers: Numbers) -> Answer:
    found = _row(numbers, "medium", 1e-5)["restitution_with_printed"]
    return judged(abs(found - RESTITUTION) <= 0.001, f"ours has e = {found:.4f}, with the default stiffness")


stated.undecided(
    "trial-and-error",
    "4",
    "Each fraction was found by a considerable number of runs, by trial and error.",
    "ours is a search by rule",
    "neither the number of runs nor the measure of the agreement is stated",
)


@stated(
    "Table 2",
    "A free vibration costs 25 to 6000 s.",
    "the computer and the length of the free vibration are not stated",
)
def _costs(numbers: Numbers) -> str:
    known = [row["cost"] for row in numbers["table_2"] if row["cost"] is not None]
    return f"ours, 10 s of motion on one core: {min(known):.2g} to {max(known):.2g} s"


@stated(
    "Table 2",
    "With a step of 100 µs a finer mesh needs a larger fraction.",
    "our fractions at 100 µs",
    "they grow from mesh to mesh",
)
def _fraction_grows_with_the_mesh(numbers: Numbers) -> Answer:
    found = [_row(numbers, mesh, 1e-4)["fraction"] for mesh in ("coarse", "medium", "fine")]
    words = ", ".join("none found" if value is None else f"{value:.2f}" for value in found)
    known = [value for value in found if value is not None]
    return judged(
        len(known) > 1 and known == sorted(known),
        f"coarse, medium, fine at 100 µs: {words} (a rigid body on their nodes)",
    )


@stated(
    "Table 2",
    "A tenth of the step costs about ten times as much.",
    "processor time of our reduced elements",
    "from 10 to 1 µs it grows 4- to 16-fold",
)
def _cost_grows_with_the_step(numbers: Numbers) -> Answer:
    ratios = [_row(numbers, mesh, 1e-6)["cost"] / _row(numbers, mesh, 1e-5)["cost"] for mesh in ("coarse", "medium")]
    words = ", ".join(f"{ratio:.1f}" for ratio in ratios)
    return judged(
        all(abs(ratio / 10 - 1) <= 0.6 for ratio in ratios),
        f"from 10 to 1 µs ours grows by factors of {words} (coarse, medium); more modes are followed at 1 µs",
    )


@stated(
    "Table 2",
    "At 10 µs the fine mesh costs 13.5 times as much as the coarse one.",
    "processor time of our reduced elements",
    f"ours grows by the same factor to {100 * SAME_COST:g} %",
)
def _cost_grows_with_the_mesh(numbers: Numbers) -> Answer:
    costs = [_row(numbers, mesh, 1e-5)["cost"] for mesh in ("coarse", "medium", "fine")]
    printed = [_row(numbers, mesh, 1e-5)["printed_cost"] for mesh in ("coarse", "medium", "fine")]
    ours, theirs = costs[-1] / costs[0], printed[-1] / printed[0]
    return judged(
        abs(ours / theirs - 1) <= SAME_COST,
        f"from the coarse to the fine mesh at 10 µs ours grows {ours:.1f}-fold, the paper's {theirs:.1f}-fold: ours "
        "are reduced to few modes",
    )


@stated(
    "4, Table 2",
    "The meshes have 1224, 5478 and, in the table, 20322, in the text, 20332 degrees of freedom.",
    "three for each node",
    "text and table agree and can be divided by three",
)
def _degrees_of_freedom(numbers: Numbers) -> Answer:
    table = {row["mesh"]: row["printed_degrees_of_freedom"] for row in numbers["stable_steps"]}
    text = DEGREES_OF_FREEDOM_IN_TEXT
    words = "; ".join(
        f"{mesh}: table {number}, text {text[mesh]}" + ("" if text[mesh] % 3 == 0 else f" = 3 · {text[mesh] / 3:.2f}")
        for mesh, number in table.items()
    )
    return judged(table == text and all(number % 3 == 0 for number in text.values()), words)


_possible(1e-4)
_possible(1e-5)
_possible(1e-6)


stated.undecided(
    "fine-mesh-at-1us",
    "Table 2",
    "The fine mesh was not run at 1 µs.",
    "the cell is empty, without a reason",
    "our reduced elements can: the study of the contact model has the cell",
)


@stated(
    "4, fig. 10",
    "Numerical and analytical free vibration agree well.",
    "contact model, calibrated to the identified e, against the linear model, from the same measured angle",
    f"RMS difference at most {HISTORIES['good']:g} of α in all three",
    page="free-vibration",
)
def _numerical_free_vibration(numbers: Numbers) -> Answer:
    found = [each["numerical_to_analytical"] for each in numbers["free_vibrations"].values()]
    words = ", ".join(f"{each:.3f}" for each in found)
    return judged(max(found) <= HISTORIES["good"], f"RMS difference over α: {words}")
