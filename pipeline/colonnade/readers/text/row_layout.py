"""Whether rows of numbers are a table of channels, or one series that runs on from row to row."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from colonnade.arrays import Array
from colonnade.readers.clock import RISING_SHARE, equal_step, rising_share
from colonnade.readers.text.header_claims import HeaderClaims
from colonnade.readers.text.lines.rows import filled_length

Layout = Literal["columns", "running", "pairs"]
Named = Literal["names", "words", ""]

FEWEST_ROWS = 24
"""Rows from which on the steps between numbers show how these belong together."""

FEWEST_TIMES = 5
"""Rows from which on a first column that rises is one of times."""

MOST_ROWS = 20_000
"""Rows that are looked at."""

LONGEST_STEPS = 0.05
"""Share of the largest steps that is left out: a single shock says nothing of the order of the numbers."""

SMOOTH = 1.0
"""Mean square step over variance below which a series goes on from number to number; 2 for white noise."""

ALIKE = 1.8
"""Steps of one series, within rows and from row to row, differ by less than this factor."""

PURE = 0.1
"""Share of a sine's size that may be something else."""

SEAM = 1.3
"""A step from row to row larger by this factor than the largest step within a row is a jump to another channel."""

SHORTER = 0.75
"""Steps that are shorter than others by this factor are those from one sample to the next."""


@dataclass(frozen=True)
class Verdict:
    """
    How rows of numbers are to be read.

    Attributes
    ----------
    layout : str or None
        "columns", "running", or "pairs" of time and value that run on; None if the file does not decide it.
    reasons : tuple of str
        The evidence; if it does not decide, that for a series that runs on.
    against : tuple of str
        If it does not decide: the evidence for columns.
    """

    layout: Layout | None
    reasons: tuple[str, ...] = ()
    against: tuple[str, ...] = ()

    def undecided(self, path: Path, width: int) -> str:
        """Say why a file does not show whether columns are channels, and what to do."""
        for_series = "; ".join(self.reasons) or "no names above the columns"
        for_channels = "; ".join(self.against) or "no evidence"
        return (
            f"{path.name}: the file does not show whether the {width} numbers of each row are samples of {width} "
            f"channels, or one series that runs on from row to row. For channels: {for_channels}. For one series: "
            f'{for_series}. Say which in `file`: layout = "columns" or layout = "running".'
        )


@dataclass
class _Evidence:
    """Reasons on either side, each strong enough to decide alone or not."""

    running: list[str] = field(default_factory=list)
    columns: list[str] = field(default_factory=list)
    weak_running: list[str] = field(default_factory=list)
    weak_columns: list[str] = field(default_factory=list)


def judge(columns: Sequence[Array], claims: HeaderClaims, *, named: Named, is_free: bool, is_whole: bool) -> Verdict:
    """
    Decide by the evidence in a file how its rows of numbers are to be read.

    Parameters
    ----------
    columns : list of ndarray, shape (n,)
        As if it were a table; NaN if a row is too short.
    claims : HeaderClaims
        What the lines above say.
    named : str
        Whether names or units are above the columns; "words" if they may be the words of a sentence.
    is_free : bool
        Whether only blanks are between numbers, as in what a Fortran program wrote.
    is_whole : bool
        Whether this is all of the file, and its last line ends.
    """
    width = len(columns)
    if width < 2 or (named == "names" and not is_free):
        return Verdict("columns")  # nobody writes names, with delimiters, above a single series
    rows = max(filled_length(column) for column in columns)
    if rows < 2:
        return Verdict("columns")
    table = np.column_stack([column[: min(rows, MOST_ROWS)] for column in columns])
    full = table[np.isfinite(table).all(axis=1)]
    if rows >= FEWEST_TIMES and rising_share(columns[0]) >= RISING_SHARE > rising_share(full.ravel()):
        if not named and _are_pairs(full):
            return Verdict("pairs", ("every second number is a time, in equal steps from row to row",))
        return Verdict("columns", ("the first column rises, as times do",))
    evidence = _Evidence()
    ending = np.array([column[rows - 2 : rows] for column in columns]).T
    _by_shape(evidence, rows, ending, claims, is_whole=is_whole, is_free=is_free)
    _by_words(evidence, claims, width, named)
    _by_steps(evidence, full)
    return _weighed(evidence, may_run_on=is_free and not named and rows >= FEWEST_ROWS)


def _weighed(evidence: _Evidence, *, may_run_on: bool) -> Verdict:
    running, columns = evidence.running, evidence.columns
    if running and not columns:
        return Verdict("running", (*running, *evidence.weak_running))
    if columns and not running:
        return Verdict("columns", (*columns, *evidence.weak_columns))
    if running or evidence.weak_running or (may_run_on and not evidence.weak_columns):
        return Verdict(None, (*running, *evidence.weak_running), (*columns, *evidence.weak_columns))
    return Verdict("columns", tuple(evidence.weak_columns))


def _by_shape(
    evidence: _Evidence,
    rows: int,
    ending: NDArray[np.float64],
    claims: HeaderClaims,
    *,
    is_whole: bool,
    is_free: bool,
) -> None:
    """Compare the numbers with the count that the header gives, and the last row with the one above."""
    width = ending.shape[1]
    above, last = np.isfinite(ending)
    numbers = int(last.sum())
    short = 0 < numbers < width and bool(last[:numbers].all()) and bool(above.all())
    total = rows * width - (width - numbers if short else 0)
    if short:
        told = f"the last row has {numbers} numbers, the others have {width}"
        (evidence.running if is_whole and is_free else evidence.weak_running).append(told)
    for count in claims.counts:
        if is_whole and abs(count - rows) <= 1:
            evidence.columns.append(f"the header gives {count} points, and there are {rows} rows")
        elif is_whole and abs(count - total) < max(width, 2):
            evidence.running.append(f"the header gives {count} points, and there are {total} numbers")


def _by_words(evidence: _Evidence, claims: HeaderClaims, width: int, named: Named) -> None:
    """Weigh what the header says of rows and columns."""
    if claims.per_row == width:
        evidence.running.append(f"the header says that {width} points are in a row")
    elif claims.fields == width:
        evidence.weak_running.append(f"the header declares rows of {width} fields")
    if named == "names":
        evidence.columns.append("names or units are above the columns")
    elif named == "words":
        evidence.weak_columns.append(f"the line above the numbers has {width} words")


def _by_steps(evidence: _Evidence, table: NDArray[np.float64]) -> None:
    """Compare steps within rows, from row to row, and down the columns: which ones are from sample to sample?"""
    if len(table) < FEWEST_ROWS:
        return
    with np.errstate(over="ignore", invalid="ignore"):
        within = np.array([_usual(step) for step in np.diff(table, axis=1).T])
        down = float(np.mean([_usual(step) for step in np.diff(table, axis=0).T]))
        seam = _usual(table[1:, 0] - table[:-1, -1])
        series = table.ravel()
        smooth = bool(np.mean(np.diff(series) ** 2) < SMOOTH * np.var(series))
    steps = np.array([*within, seam])
    margin = 1 / np.sqrt(len(table))  # what few rows leave open
    seam_within, shorter = SEAM + 2 * margin, SHORTER - margin
    if smooth and steps.max() < ALIKE * steps.min() and seam < shorter * down:
        evidence.running.append(
            f"each row continues the one above: the step there is {seam:.2g}, down the columns {down:.2g}"
        )
    elif seam > seam_within * within.max() and down > 0:
        evidence.columns.append(
            f"from the end of a row to the next there is a jump: {seam:.2g}, against {within.max():.2g} within a row"
        )
    elif down < shorter * steps.mean() and not (smooth and _is_sine(series)):
        evidence.columns.append(
            f"steps down the columns are shorter ({down:.2g}) than from column to column ({steps.mean():.2g})"
        )


def _is_sine(series: NDArray[np.float64]) -> bool:
    """Whether each number follows from the two before it: a sine; a row may hold whole periods of it."""
    centred = series - series.mean()
    middle, sides = centred[1:-1], centred[2:] + centred[:-2]
    left = sides - middle * (middle @ sides) / (middle @ middle)
    return bool(left.std() < PURE * centred.std())


def _usual(steps: NDArray[np.float64]) -> float:
    """Mean size of steps without the largest."""
    sizes = np.sort(np.abs(steps))
    return float(sizes[: max(int(sizes.size * (1 - LONGEST_STEPS)), 1)].mean())


def _are_pairs(table: NDArray[np.float64]) -> bool:
    """Whether every second column holds times in equal steps, which run on from row to row."""
    if table.shape[1] < 4 or table.shape[1] % 2 or not np.isfinite(table).all():
        return False
    times = table[:, 0::2].ravel()
    return times.size > 2 and equal_step(times, 0.1) is not None
