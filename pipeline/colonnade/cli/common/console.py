"""Output of the commands: results on stdout as text, tables or JSON; errors and progress on stderr."""

from __future__ import annotations

import os
import sys
import threading
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from itertools import zip_longest
from pathlib import Path
from textwrap import fill as wrap
from typing import TYPE_CHECKING

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn
from rich.table import Table
from rich.text import Text

if TYPE_CHECKING:
    from colonnade.figures.files.output import Picture


class _Output(Console):
    """stdout. If its reader stops (`colonnade … | head`) the rest is dropped; the exit code is unchanged."""

    def on_broken_pipe(self) -> None:
        self.quiet = True
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def output() -> Console:
    """Return the console on stdout; text is shown as it is, also brackets and colons."""
    return _Output(markup=False, emoji=False, highlight=False, soft_wrap=True)


def messages() -> Console:
    """Return the console on stderr."""
    return Console(stderr=True, markup=False, emoji=False, highlight=False, soft_wrap=True)


def say(text: str | Text = "") -> None:
    """Write a line of result."""
    output().print(text)


def say_marked(mark: str, style: str, text: str) -> None:
    """Write a line that begins with a mark in colour, on a terminal."""
    say(Text.assemble((mark, style), text))


def expect_places(picture: Path | None, table: Path | None = None) -> None:
    """Refuse places for a picture and its table before the work is done; the module of figures loads matplotlib."""
    if picture or table:
        from colonnade.figures.files.saving import expect_places

        expect_places(picture, table)


def saved(draw: Callable[[], Picture], *places: Path | None) -> list[Path]:
    """Write a picture and its table where they are asked for."""
    if not any(places):
        return []
    from colonnade.figures.files.saving import save

    picture = draw()
    return [save(picture, place) for place in places if place is not None]


def say_drawn(places: Iterable[Path]) -> None:
    """Write where figures and their tables are."""
    for place in places:
        say(f"{'data' if place.suffix.lower() == '.csv' else 'figure'}: {place}")


def complain(text: str) -> None:
    """Write what went wrong."""
    messages().print(text)


def show_json(value: object) -> None:
    """Write a result for machines: arrays as lists, records by their fields, null for what there is not."""
    from pydantic_core import to_json

    say(to_json(value, indent=2, inf_nan_mode="null", fallback=lambda array: array.tolist()).decode())


def show_table(heads: Sequence[str], rows: Sequence[Sequence[str]]) -> None:
    """
    Write rows under their heads, in columns; nothing if there are no rows.

    On a terminal long cells wrap inside their column, but for the first, which is whole; elsewhere each row is one
    line, whatever its length.
    """
    console = output()
    if not rows:
        return
    if not console.is_terminal:
        show_rows((heads, *rows))
        return
    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0), header_style="bold")
    for head in heads:
        table.add_column(head, overflow="fold")
    table.columns[0].no_wrap = True
    for row in rows:
        table.add_row(*row)
    console.print(table, soft_wrap=False)


def show_paragraph(text: str) -> None:
    """Write text; on a terminal it wraps between words."""
    console = output()
    say(wrap(text, console.width if console.is_terminal else 10**6))


def show_rows(rows: Sequence[Sequence[str]]) -> None:
    """Write rows without heads, such as names and values, in columns; each is one line."""
    widths = [max(map(len, column)) for column in zip_longest(*rows, fillvalue="")]
    for row in rows:
        say("  ".join(map(str.ljust, row, widths)).rstrip().replace("\n", " "))


def close_output() -> None:
    """Flush stdout, so that a closed pipe is handled here and not in a traceback at exit."""
    try:
        sys.stdout.flush()
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


EVERY = 10.0
"""Seconds between two lines of progress if the output is not a terminal."""


Show = Callable[..., None]
"""Takes how much is done, the total and, if something else than the work is named, the present item."""


@contextmanager
def work_progress(what: str) -> Iterator[Show]:
    """Show the progress of some work: a bar or, if the output is not a terminal, lines."""
    console = messages()
    if not console.is_terminal:
        with _lines(what) as show:
            yield show
        return
    columns = (TextColumn("{task.description}", markup=False), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn())
    with Progress(*columns, console=console, transient=True) as bar:
        task = bar.add_task(what, total=None)
        yield lambda done, total, now=what: bar.update(task, description=now, completed=done, total=total)


@contextmanager
def _lines(what: str) -> Iterator[Show]:
    """Write a line every `EVERY` seconds, also while nothing ends."""
    began, over, last = time.monotonic(), threading.Event(), [what]

    def write() -> None:
        while not over.wait(min(EVERY, threading.TIMEOUT_MAX)):
            complain(f"{last[0]}, after {time.monotonic() - began:.0f} s")

    def show(done: int, total: int, now: str = what) -> None:
        last[0] = f"{now}: {done} of {total}" if done < total else f"{done} of {total} done, finishing"

    threading.Thread(target=write, daemon=True).start()
    try:
        yield show
    finally:
        over.set()
