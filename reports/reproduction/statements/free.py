"""Statements on free vibrations: the coefficient of restitution, and what rocking in space does to them."""

from __future__ import annotations

from reproduction.printed import RESTITUTION
from reproduction.statement import HISTORIES, Answer, Numbers, Statements, judged

stated = Statements("free-vibration")

E_DIGIT = 0.001
"""One unit of the last digit of the paper's e."""

LEAST = 0.01
"""Of α: a misfit that rocking in space adds; less is not seen."""


@stated(
    "2.1, 4",
    "The prism's coefficient of restitution is e = 0.976.",
    "identified from the virtual free vibrations, which were given this e",
)
def _e_of_the_prism(numbers: Numbers) -> str:
    found = numbers["restitution"]["prism"]
    return f"identified {found['value']:.4f}, the {found['true']:g} that the virtual prism was given"


@stated(
    "2, 2.1",
    "e is the value with which the linearised solution follows the measured free vibration best.",
    "the same fit on free vibrations of known e",
    f"each fit gives the true e to {E_DIGIT:g}",
)
def _e_by_best_fit(numbers: Numbers) -> Answer:
    true = numbers["restitution"]["prism"]["true"]
    fitted = [each["best_linear"] for each in numbers["free_vibrations"].values()]
    values = ", ".join(f"{each['restitution']:.4f}" for each in fitted)
    misfits = ", ".join(f"{each['misfit']:.3f}" for each in fitted)
    return judged(
        all(abs(each["restitution"] - true) <= E_DIGIT for each in fitted),
        f"linear model fitted to the whole histories: e = {values}, with RMS misfits of {misfits} of α; true is "
        f"{true:g}",
    )


@stated(
    "2.1",
    "e = 0.976 is used in the equations of a rigid block. (What these give by themselves is not compared.)",
    "Housner's e of the prism, 1 − 1.5 sin² α",
    "it is within 0.01 of 0.976",
)
def _e_of_a_rigid_body(numbers: Numbers) -> Answer:
    rigid = numbers["specimens"]["prism"]["rigid_restitution"]
    return judged(
        abs(rigid - RESTITUTION) <= 0.01,
        f"a rigid prism that does not bounce has {rigid:.4f}, {RESTITUTION - rigid:.3f} less than the measured e",
    )


stated.undecided(
    "release",
    "2.1",
    "The specimen rocks freely to rest; how it is released is not said.",
    "the virtual prism is held tilted and let go, which is assumed",
    "released at about 0.60, −0.50 and 0.70 of α",
)


@stated(
    "2.1, fig. 3",
    "For the prism observed and predicted free vibration correlate well.",
    "RMS misfit of the linear model on the virtual recordings",
    f"at most {HISTORIES['good']:g} of α in all three",
)
def _prism_correlates(numbers: Numbers) -> Answer:
    found = [numbers["tests"][test]["predicted"]["linear"]["nrmse"] for test in numbers["free_vibrations"]]
    words = ", ".join(f"{each:.3f}" for each in found)
    return judged(max(found) <= HISTORIES["good"], f"linear model, RMS misfit over α: {words}")


@stated(
    "2.1",
    "Measured and predicted differ visibly at first, while amplitudes are large.",
    "misfit of the linear model in the first four predicted arcs, and in the twelve after them",
    "the first is larger, in all three",
)
def _early_discrepancy(numbers: Numbers) -> Answer:
    rows = [each["linear"] for each in numbers["free_vibrations"].values()]
    plane = [each["nonlinear"]["early"] for each in numbers["free_vibrations"].values()]
    words = "; ".join(f"{each['early']:.3f} then {each['late']:.3f}" for each in rows)
    return judged(
        all(each["early"] > each["late"] for each in rows),
        f"linear model, RMS over α in the first four arcs and in the twelve after: {words}; nonlinear model "
        f"{min(plane):.3f} to {max(plane):.3f} in the first four. The virtual prism cannot leave its plane",
    )


@stated(
    "2.1",
    "That difference comes from rocking that turns three-dimensional; it is worst for the round specimens and "
    "least for the prism.",
    "the study of the contact model: disturbances of a release from 0.9 α",
    "some disturbance adds 5 % of α to the misfit of cylinder and cone, and less than half of it to the prism's",
)
def _rocking_in_space(numbers: Numbers) -> Answer:
    found = numbers["three_dimensional"]["disturbances"]
    yes = [kind for kind, each in found.items() if each["size"] is not None]
    return judged(bool(yes), f"{len(yes)} of {len(found)} kinds of disturbance give that misfit: {', '.join(yes)}")


@stated(
    "2.1",
    "The slightest disturbance out of the plane makes the rocking three-dimensional.",
    "the smallest size of each disturbance in that study",
    "each adds 1 % of α to the misfit of each specimen",
)
def _slightest_disturbance(numbers: Numbers) -> Answer:
    rows = {
        (specimen, kind): misfit
        for specimen, kinds in numbers["three_dimensional"]["smallest"].items()
        for kind, (_, misfit) in kinds.items()
    }
    seen = [f"{specimen}, {kind}" for (specimen, kind), misfit in rows.items() if misfit >= LEAST]
    return judged(
        len(seen) == len(rows),
        f"the smallest disturbance of each kind adds {100 * LEAST:g} % of α in {len(seen)} of {len(rows)} cases",
    )


@stated(
    "2.1",
    "A prism gives e more accurately than a truncated cone.",
    "identified e of the disturbed releases in that study",
    "fewer of the prism's e are refused or wrong by 0.005 than of cylinder's and cone's",
)
def _prism_gives_e_more_accurately(numbers: Numbers) -> Answer:
    found = numbers["three_dimensional"]["e_spoilt"]
    words = ", ".join(f"{specimen} {100 * share:.0f} %" for specimen, share in found.items())
    return judged(
        all(found["prism"] < found[other] for other in ("cylinder", "cone")),
        f"e refused or more than 0.005 off in so many of the disturbed releases: {words}",
    )
