"""Whether the answer is one of the engines, of the draw, of the series of the record or of its time scale."""

from __future__ import annotations

from typing import Any

import numpy as np

from colonnade.dynamics.history import History
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.rock import rock
from colonnade.laboratory.table import Piece, TableMotion
from colonnade.laboratory.truth import simulate
from paper_schemes import PAPERS_STEP, rock_by_steps
from span_two_and_a_half.counting import VIEWS, Strata, of_view, pattern
from span_two_and_a_half.criterion import Criterion, Response, place_of_growth
from span_two_and_a_half.design import (
    EVERY,
    GRADES,
    RECORDS,
    SEED,
    SPANS,
    STRANGE,
    TIME_SCALES,
    Cell,
    nominal,
    table_motion,
)
from span_two_and_a_half.members import FORWARD, REVERSE, Judged
from span_two_and_a_half.running import STANDARD, Run
from span_two_and_a_half.trial import (
    Wrong,
    draw,
    generator,
    is_recorded_truly,
    predict,
    predicted_block,
    recorded,
    response,
    table,
    truth,
)

CELLS = (Cell("e", 2), Cell("all", 1), Cell("all", 2))
"""What is repeated with other seeds, series and time scales."""

FINER = 8
"""Parts into which the samples of the motion are divided for the same motion on a finer clock."""

OTHER_REST = 1e-4
"""Of α: a rest rule a hundred times the usual one."""


def other_runs() -> dict[str, Run]:
    """Give what the cells are repeated with: seed, series, time scale."""
    seed, series, scale = STANDARD
    found = {"another seed": (seed + 1, series, scale), RECORDS["peer"]: (seed, "peer", scale)}
    return found | {f"time × {other:.3g}": (seed, series, other) for other in TIME_SCALES if other != scale}


def engines(cell: Cell, number: int, intensity: float) -> dict[str, bool]:
    """
    Look at Span 2.5 of one member again with other engines.

    Returns
    -------
    shown : dict
        By engine, whether the nonlinear prediction shows the pattern; for the paper's own schemes the linear one, with
        "linear" for the exact solution that they are compared with.
    """
    wrong, which = draw(cell, number), SPANS.index(STRANGE)
    motion = table(table_motion(), intensity, STRANGE)

    def draws() -> np.random.Generator:
        return generator(cell, number, SEED, which)

    random = draws()
    true = truth(wrong, motion, random)
    seen = recorded(wrong, motion, which, random)
    measured = response(true, motion.dt)
    runs = predict(seen, tangent=wrong.tangent)

    def shows(measured: Response, history: History) -> bool:
        return bool(np.isfinite(place_of_growth(measured, response(history, motion.dt), Criterion())))

    found = {"as it is": shows(measured, runs["nonlinear"]), "linear": shows(measured, runs["linear"])}
    block, e = predicted_block(wrong.tangent), nominal()[1]
    finer = rock(block, refined(seen), restitution=e, model="nonlinear")
    fine_truth = truth(wrong, refined(motion), draws())
    found["samples divided by 8"] = shows(
        Response(fine_truth.angle[::FINER], motion.dt, fine_truth.overturning_time, nominal()[0]), _coarse(finer, seen)
    )
    rests = rock(block, seen, restitution=e, model="nonlinear", rest_angle=OTHER_REST)
    found["rest rule 1e-4 α"] = shows(measured, rests)
    if is_recorded_truly(wrong) and not (wrong.speed or wrong.scatter or wrong.tilt):
        found["adaptive 8th order"] = shows(by_laboratory(wrong, motion), runs["nonlinear"])
    for scheme in ("runge-kutta", "hamming"):
        steps = round(motion.dt / PAPERS_STEP)
        paper = rock_by_steps(block, seen, scheme=scheme, steps_per_sample=steps, restitution=e)
        found[f"paper's {scheme}"] = shows(measured, paper)
    return found


def refined(motion: Motion) -> Motion:
    """Give the same motion, linear between its samples, on a finer clock."""
    count = motion.acceleration.size
    fine = np.arange((count - 1) * FINER + 1) / FINER
    return Motion(np.interp(fine, np.arange(count), motion.acceleration), motion.dt / FINER)


def _coarse(history: History, motion: Motion) -> History:
    kept = slice(None, None, FINER)
    return History(
        history.block,
        motion.time,
        history.angle[kept],
        history.angular_velocity[kept],
        history.impact_times,
        history.impact_velocities,
        history.rebound_velocities,
        history.overturning_time,
        history.model,
    )


def by_laboratory(wrong: Wrong, motion: Motion) -> Response:
    """Run the truth by the laboratory's own integration, which shares nothing with the models."""
    from colonnade.dynamics.ensembles.uncertainty import member_block

    block, e = nominal()
    true = simulate(
        member_block(block, 1.0 + wrong.critical_angle, 1.0 + wrong.p),
        motion.time,
        _pieces(motion),
        restitution=min(e + wrong.e, 1.0),
    )
    return Response(true.angle, motion.dt, true.overturning_time, block)


def _pieces(motion: Motion) -> TableMotion:
    """Give the motion to the laboratory exactly as it is; nothing asks for its displacement."""

    def line(instant: float, origin: float, level: float, rate: float) -> float:
        return level + rate * (instant - origin)

    starts, values = motion.time.tolist(), motion.acceleration
    rates = (np.diff(values) / motion.dt).tolist()
    pieces = tuple(
        Piece(start, start + motion.dt, lambda t, o=start, a=float(level), r=rate: line(t, o, a, r))
        for start, level, rate in zip(starts, values, rates, strict=False)
    )
    return TableMotion(pieces, np.zeros_like)


def summarised(found: list[dict[str, bool]]) -> dict[str, Any]:
    """Count how many members keep the verdict of the standard engine."""
    names = sorted({name for each in found for name in each} - {"as it is", "linear"})
    counted = {}
    for name in names:
        standard = "linear" if name.startswith("paper's") else "as it is"
        both = [(each[standard], each[name]) for each in found if name in each]
        counted[name] = {"members": len(both), "same": sum(one == other for one, other in both)}
    return counted


def counted(name: str, cell: Cell, judged: Judged, strata: Strata) -> dict[str, Any]:
    """Count pattern and reverse in a repeated cell."""
    row: dict[str, Any] = {
        "run": name,
        "cause": cell.cause,
        "grade": GRADES[cell.grade],
        "members": int(judged.number.size),
        "agreeing": round(strata.weight, 4),
    }
    for view in VIEWS:
        row[view] = {
            key: strata.share(strata.counts(pattern(judged, view=view, scope=EVERY, direction=way), judged.intensity))
            for key, way in (("likelihood", FORWARD), ("reverse_likelihood", REVERSE))
        }
        grown = of_view(judged.grown[:, 0, FORWARD], view)
        row[view]["span_2.5_alone"] = strata.share(strata.counts(grown, judged.intensity))
    return row
