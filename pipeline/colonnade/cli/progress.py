"""Progress on stderr: a bar on a terminal, nothing where nobody watches."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

from colonnade.cli.console import messages

if TYPE_CHECKING:
    from colonnade.workflow import StageRun


@contextmanager
def counting(what: str, total: int) -> Iterator[Callable[[], None]]:
    """Show how many of `total` are done; the callable that is given counts one more."""
    with progress_bar() as bar:
        task = bar.add_task(what, total=total)
        yield lambda: bar.advance(task)


@contextmanager
def looking(what: str) -> Iterator[Callable[[int, int], None]]:
    """Show work that finds out its own length; the callable takes how much is done, and of how much."""
    with progress_bar() as bar:
        task = bar.add_task(what, total=None)
        yield lambda done, total: bar.update(task, completed=done, total=total)


@contextmanager
def following() -> Iterator[Callable[[StageRun, int, int], None]]:
    """Show a run as it goes on; the callable that is given takes each stage that ended, and how many of all have."""
    with progress_bar() as bar:
        task = bar.add_task("Looking for what is out of date", total=None)
        yield lambda stage, done, total: bar.update(
            task, description=f"{stage.subject} {stage.stage}", completed=done, total=total
        )


def progress_bar() -> Progress:
    """Build a bar that goes away when it is done."""
    console = messages()
    return Progress(
        TextColumn("{task.description}", markup=False),
        BarColumn(),
        MofNCompleteColumn(),
        TimeElapsedColumn(),
        console=console,
        transient=True,
        disable=not console.is_terminal,
    )
