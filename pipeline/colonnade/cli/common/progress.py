"""Progress on stderr: a bar on a terminal, otherwise a line now and then."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

from colonnade.cli.common.console import complain, messages

if TYPE_CHECKING:
    from colonnade.workflow import StageRun

EVERY = 10.0
"""Seconds between two lines of progress if the output is not a terminal."""


@contextmanager
def work_progress(what: str) -> Iterator[Callable[[int, int], None]]:
    """Show the progress of some work; the callable takes how much is done, and the total."""
    with _shown(what) as show:
        yield lambda done, total: show(what, done, total)


@contextmanager
def run_progress() -> Iterator[Callable[[StageRun, int, int], None]]:
    """Show the progress of a run; the callable takes each stage that ended, the number of tests done, and the total."""
    with _shown("Looking for what is out of date") as show:
        yield lambda stage, done, total: show(f"{stage.subject} {stage.stage}", done, total)


@contextmanager
def _shown(what: str) -> Iterator[Callable[[str, int, int], None]]:
    """Show a bar or lines; the callable takes the present item, how much is done, and the total."""
    console = messages()
    if not console.is_terminal:
        yield _Lines()
        return
    columns = (TextColumn("{task.description}", markup=False), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn())
    with Progress(*columns, console=console, transient=True) as bar:
        task = bar.add_task(what, total=None)
        yield lambda now, done, total: bar.update(task, description=now, completed=done, total=total)


class _Lines:
    """Progress for a log: a line after `EVERY` seconds without one."""

    def __init__(self) -> None:
        self._began = self._last = time.monotonic()

    def __call__(self, now: str, done: int, total: int) -> None:
        moment = time.monotonic()
        if moment - self._last >= EVERY and done < total:
            self._last = moment
            complain(f"{now}: {done} of {total} after {moment - self._began:.0f} s")
