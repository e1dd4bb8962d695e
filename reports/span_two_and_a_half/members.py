"""Members of a cell, judged by the criterion and its variants."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from colonnade.arrays import Array, Mask
from colonnade.dynamics.motion import Motion
from span_two_and_a_half.criterion import AS_FIXED, Response, agrees, misfit, place_of_growth, variants
from span_two_and_a_half.design import MODELS, OTHERS, SEED, SPANS, STRANGE, Cell, table_motion
from span_two_and_a_half.trial import (
    draw,
    generator,
    is_recorded_truly,
    parted,
    predict,
    recorded,
    response,
    table,
    truth,
)

VARIANTS = variants()
RUN_ALL = 10
"""Of the members, one in so many is run at all three Spans whatever it shows at Span 2.5."""

FORWARD, REVERSE = range(2)
"""Predicted grows when measured has died down; and the reverse."""


@dataclass(frozen=True)
class Judged:
    """
    What the criterion says of n members.

    Attributes
    ----------
    intensity : ndarray, shape (n,)
        m/s² for each unit of Span.
    number : ndarray, shape (n,)
        Of the member in its cell.
    grown : ndarray of bool, shape (n, variants, 2, models)
        The pattern at Span 2.5, and its reverse.
    agree : ndarray of bool, shape (n, 2, variants, models)
        Whether Spans 2.0 and 3.0 agree: with the cause, and without it. With the cause only where `known`.
    known : ndarray of bool, shape (n,)
        Whether Spans 2.0 and 3.0 were run with the cause: if Span 2.5 shows a pattern, and in every tenth member.
    place : ndarray, shape (n, 2, models)
        s, of pattern and reverse by the criterion as fixed; NaN without.
    parted : ndarray, shape (n, models)
        s, when measured and predicted first differ by 0.05 α at Span 2.5.
    """

    intensity: Array
    number: Array
    grown: Mask
    agree: Mask
    known: Mask
    place: Array
    parted: Array


def can_grow(quiet: Response, growing: Response) -> bool:
    """Rule out what no variant finds, with the loosest numbers of all."""
    each = VARIANTS.values()
    if growing.largest_so_far[-1] <= min(one.loud for one in each):
        return False
    return bool(
        np.any(
            (growing.largest_after(max(one.after for one in each)) > min(one.loud for one in each))
            & (quiet.largest_before(min(one.before for one in each)) < max(one.quiet for one in each))
            & (quiet.largest_so_far >= min(one.quiet for one in each))
            & (quiet.largest_after(min(one.after for one in each)) < 0.5 * max(one.loud for one in each))
        )
    )


def judge_strange(measured: Response, predictions: dict[str, Response]) -> tuple[Mask, Array]:
    """Judge Span 2.5: the pattern and its reverse by variant and model, and the place as fixed."""
    grown = np.zeros((len(VARIANTS), 2, len(MODELS)), dtype=bool)
    places = np.full((2, len(MODELS)), np.nan)
    for column, model in enumerate(MODELS):
        pairs = ((measured, predictions[model]), (predictions[model], measured))
        for direction, (quiet, growing) in enumerate(pairs):
            if not can_grow(quiet, growing):
                continue
            for row, (name, criterion) in enumerate(VARIANTS.items()):
                place = place_of_growth(quiet, growing, criterion)
                grown[row, direction, column] = np.isfinite(place)
                if name == AS_FIXED:
                    places[direction, column] = place
    return grown, places


def judge_other(measured: Response, predictions: dict[str, Response]) -> Mask:
    """Judge another Span: whether measured and predicted agree, shape (variants, models)."""
    agree = np.zeros((len(VARIANTS), len(MODELS)), dtype=bool)
    for column, model in enumerate(MODELS):
        distance = misfit(measured, predictions[model])
        for row, criterion in enumerate(VARIANTS.values()):
            agree[row, column] = agrees(measured, predictions[model], criterion, distance)
    return agree


def agreeing(levels: Array, series: str, time_scale: float) -> Mask:
    """Tell at which intensities both predictions agree at Spans 2.0 and 3.0 with nothing wrong, shape (k,)."""
    shape = table_motion(series, time_scale)
    row = list(VARIANTS).index(AS_FIXED)
    found = []
    for intensity in levels.tolist():
        each = []
        for span in OTHERS:
            runs = predict(table(shape, intensity, span))
            responses = {model: response(history, shape.dt) for model, history in runs.items()}
            each.append(judge_other(responses["nonlinear"], responses)[row])
        found.append(np.logical_and.reduce(each).all())
    return np.array(found)


def run_members(
    cell: Cell, levels: Array, first: int, sweeps: int, seed: int, series: str, time_scale: float
) -> Judged:
    """
    Run the members of a cell at some intensities.

    Parameters
    ----------
    cell : Cell
    levels : ndarray, shape (k,)
        Intensities, m/s² for each unit of Span.
    first : int
        Number of the first member.
    sweeps : int
        Members at each intensity.
    seed : int
    series : str
        Of the record.
    time_scale : float
        Factor on its time.
    """
    shape = table_motion(series, time_scale)
    rows = []
    for place, intensity in enumerate(levels.tolist()):
        tables = {span: table(shape, intensity, span) for span in SPANS}
        nominal_runs = {span: predict(motion) for span, motion in tables.items()}
        responses = {
            span: {model: response(history, shape.dt) for model, history in runs.items()}
            for span, runs in nominal_runs.items()
        }
        without = np.logical_and.reduce([judge_other(responses[span]["nonlinear"], responses[span]) for span in OTHERS])
        for sweep in range(sweeps):
            number = first + place * sweeps + sweep
            grown, agree, known, places, apart = _member(cell, number, tables, responses, seed)
            rows.append((intensity, number, grown, np.stack((agree, without)), known, places, apart))
    return Judged(*(np.array(column) for column in zip(*rows, strict=True)))


def _member(
    cell: Cell,
    number: int,
    tables: dict[float, Motion],
    responses: dict[float, dict[str, Response]],
    seed: int,
) -> tuple[Mask, Mask, bool, Array, Array]:
    grown, places, apart = _strange(*run_member(cell, number, STRANGE, tables[STRANGE], responses[STRANGE], seed))
    agree = np.zeros((len(VARIANTS), len(MODELS)), dtype=bool)
    known = bool(grown.any()) or number % RUN_ALL == 0
    if known:
        each = [judge_other(*run_member(cell, number, span, tables[span], responses[span], seed)) for span in OTHERS]
        agree = np.logical_and.reduce(each)
    return grown, agree, known, places, apart


def _strange(measured: Response, predictions: dict[str, Response]) -> tuple[Mask, Array, Array]:
    grown, places = judge_strange(measured, predictions)
    return grown, places, np.array([parted(measured, predictions[model]) for model in MODELS])


def run_member(
    cell: Cell, number: int, span: float, motion: Motion, nominal_responses: dict[str, Response], seed: int = SEED
) -> tuple[Response, dict[str, Response]]:
    """Run truth and predictions of a member at one Span; `nominal_responses` are the predictions on the true motion."""
    if cell.cause == "none":
        return nominal_responses["nonlinear"], nominal_responses
    wrong = draw(cell, number, seed)
    random = generator(cell, number, seed, SPANS.index(span))
    measured = response(truth(wrong, motion, random), motion.dt)
    if not wrong.tangent and is_recorded_truly(wrong):
        return measured, nominal_responses
    runs = predict(recorded(wrong, motion, SPANS.index(span), random), tangent=wrong.tangent)
    return measured, {model: response(history, motion.dt) for model, history in runs.items()}


def joined(parts: list[Judged]) -> Judged:
    """Put blocks of members together."""
    return Judged(*(np.concatenate([vars(part)[name] for part in parts]) for name in vars(parts[0])))
