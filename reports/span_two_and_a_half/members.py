"""Members of a cell, judged by the criterion and its variants."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from colonnade.arrays import Array, Mask
from colonnade.dynamics.motion import Motion
from span_two_and_a_half.criterion import AS_FIXED, Response, agrees, misfit, place_of_growth, variants
from span_two_and_a_half.design import MODELS, OTHERS, SEED, SPANS, STRANGE, Cell, table_motion
from span_two_and_a_half.trial import draw, is_recorded_truly, parted, predict, recorded, response, table, truth

VARIANTS = variants()
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
        Whether Spans 2.0 and 3.0 agree: with the cause, and without it.
    place : ndarray, shape (n, 2, models)
        s, of pattern and reverse by the criterion as fixed; NaN without.
    parted : ndarray, shape (n, models)
        s, when measured and predicted first differ by 0.05 α at Span 2.5.
    """

    intensity: Array
    number: Array
    grown: Mask
    agree: Mask
    place: Array
    parted: Array


def judge_strange(measured: Response, predictions: dict[str, Response]) -> tuple[Mask, Array]:
    """Judge Span 2.5: the pattern and its reverse by variant and model, and the place as fixed."""
    grown = np.zeros((len(VARIANTS), 2, len(MODELS)), dtype=bool)
    places = np.full((2, len(MODELS)), np.nan)
    for column, model in enumerate(MODELS):
        pairs = ((measured, predictions[model]), (predictions[model], measured))
        for direction, (quiet, growing) in enumerate(pairs):
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


def run_members(
    cell: Cell, levels: Array, first: int, sweeps: int, *, seed: int = SEED, shape: Motion | None = None
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
    seed : int, optional
    shape : Motion, optional
        Of the table; default `table_motion()`.
    """
    shape = table_motion() if shape is None else shape
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
            grown, places, agree, apart = _member(cell, number, tables, responses, seed)
            rows.append((intensity, number, grown, np.stack((agree, without)), places, apart))
    return Judged(*(np.array(column) for column in zip(*rows, strict=True)))


def _member(
    cell: Cell,
    number: int,
    tables: dict[float, Motion],
    responses: dict[float, dict[str, Response]],
    seed: int,
) -> tuple[Mask, Array, Mask, Array]:
    wrong, random = draw(cell, number, seed)
    agree = np.ones((len(VARIANTS), len(MODELS)), dtype=bool)
    for which, (span, motion) in enumerate(tables.items()):
        if cell.cause == "none":
            measured, predictions = responses[span]["nonlinear"], responses[span]
        else:
            measured = response(truth(wrong, motion, random), motion.dt)
            predictions = responses[span]
            if wrong.tangent or not is_recorded_truly(wrong):
                runs = predict(recorded(wrong, motion, which, random), tangent=wrong.tangent)
                predictions = {model: response(history, motion.dt) for model, history in runs.items()}
        if span == STRANGE:
            grown, places = judge_strange(measured, predictions)
            apart = np.array([parted(measured, predictions[model]) for model in MODELS])
        else:
            agree &= judge_other(measured, predictions)
    return grown, places, agree, apart
