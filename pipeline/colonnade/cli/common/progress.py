"""Progress on stderr: a bar on a terminal, otherwise a line after three seconds and then every ten."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

from colonnade.cli.common.console import complain, messages

if TYPE_CHECKING:
    from colonnade.workflow import StageRun

FIRST, EVERY = 3.0, 10.0
"""Seconds to the first line of progress if the output is not a terminal, and between two."""


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
        with _lines(what) as show:
            yield show
        return
    columns = (TextColumn("{task.description}", markup=False), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn())
    with Progress(*columns, console=console, transient=True) as bar:
        task = bar.add_task(what, total=None)
        yield lambda now, done, total: bar.update(task, description=now, completed=done, total=total)


@contextmanager
def _lines(what: str) -> Iterator[Callable[[str, int, int], None]]:
    """Write a line after `FIRST` seconds and then every `EVERY`, also while nothing ends."""
    began, over, last = time.monotonic(), threading.Event(), [what]

    def write() -> None:
        pause = min(FIRST, EVERY)
        while not over.wait(min(pause, threading.TIMEOUT_MAX)):
            complain(f"{last[0]}, after {time.monotonic() - began:.0f} s")
            pause = EVERY

    def show(now: str, done: int, total: int) -> None:
        last[0] = f"{now}: {done} of {total}" if done < total else f"{done} of {total} done, finishing"

    writer = threading.Thread(target=write, daemon=True)
    writer.start()
    try:
        yield show
    finally:
        over.set()
        writer.join()
