"""
Files that arrive: what happens in the watched folder, which files are finished or taken away, copies from a share.

A file is finished, or gone, when it has stayed the same, or away, for a while. Finished files of a share are copied
into the watched folder; nothing is overwritten.
"""

from __future__ import annotations

import os
import shutil
import threading
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from pathlib import Path

from colonnade.campaign.found import files_in
from colonnade.readers.files import sha256_of
from colonnade.store.files import PARTIAL
from colonnade.workflow.product import Mark, marks_of

POLL = 2.0
"""Seconds between two looks where no event came: a folder of another machine gives none, and one may be lost."""


@dataclass
class Arrivals:
    """
    What is known of the files that are watched.

    Attributes
    ----------
    settle : float
        A file is finished when its mark has not changed for this long, s.

    Examples
    --------
    >>> arrivals, file = Arrivals(settle=1.0), Path("free-01.csv")
    >>> arrivals.look({file: (10, 0, 1)}, now=0.0), arrivals.look({file: (20, 1, 1)}, now=1.5)
    (set(), set())
    >>> arrivals.look({file: (20, 1, 1)}, now=2.5) == {file}, arrivals.look({file: (20, 1, 1)}, now=9.0)
    (True, set())
    >>> arrivals.look({}, now=20.0), arrivals.look({}, now=21.0) == {file}
    (set(), True)
    """

    settle: float
    _since: dict[Path, tuple[Mark | None, float]] = field(default_factory=dict)
    _taken: dict[Path, Mark | None] = field(default_factory=dict)

    def know(self, marks: Mapping[Path, Mark]) -> None:
        """Take files as they are for finished: their tests are up to date."""
        self._taken |= marks

    def look(self, marks: Mapping[Path, Mark], now: float) -> set[Path]:
        """Return the files finished or taken away since the last look, given the marks of all there and the time, s."""
        self._since = {
            path: known if (known := self._since.get(path)) is not None and known[0] == mark else (mark, now)
            for path, mark in {**dict.fromkeys(self._taken), **marks}.items()
            if self._taken.get(path) != mark
        }
        finished = {path for path, (_, since) in self._since.items() if now - since >= self.settle}
        self._taken |= {path: self._since.pop(path)[0] for path in finished}
        return finished

    @property
    def is_waiting(self) -> bool:
        """Whether a file has arrived or gone that has not settled."""
        return bool(self._since)


@dataclass
class Share:
    """
    A folder from which finished files are copied.

    Attributes
    ----------
    source, target : Path
        The share, and the watched folder.
    arrivals : Arrivals
        What is known of the files of the share.
    """

    source: Path
    target: Path
    arrivals: Arrivals

    def copy_finished(self, now: float) -> Iterator[str]:
        """Copy what has been finished since the last call; give a sentence on each file that could not be copied."""
        names = {self.source / name: name for name in files_in(self.source)}
        if not names and not self.source.is_dir():
            yield f"{self.source}: this folder cannot be seen. Is the share connected?"
            return
        for path in sorted(self.arrivals.look(marks_of(names), now) & names.keys()):
            if problem := _copy(path, self.target / names[path]):
                yield problem


def _copy(source: Path, target: Path) -> str:
    """Copy a file unless one of that name is there; return what is wrong."""
    digest, partial = sha256_of(source), target.with_name(target.name + PARTIAL)
    try:
        if not target.exists():
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(source, partial)
            if sha256_of(partial) != digest:
                return f"{source}: the copy differs from it; it was not kept. Is the file still being written?"
            os.link(partial, target)  # unlike a rename it never replaces a file
    except OSError as error:
        return f"{source}: it could not be copied ({error.strerror or error})."
    finally:
        partial.unlink(missing_ok=True)
    same = sha256_of(target) == digest
    return "" if same else f"{source}: {target.name} is there already and differs. It was kept; rename one of them."


@contextmanager
def listening(folder: Path) -> Iterator[Callable[[float], None]]:
    """Listen to a folder: give what waits until something happens in it, for so many seconds at most."""
    from watchdog.events import FileSystemEvent, FileSystemEventHandler
    from watchdog.observers import Observer

    rung = threading.Event()

    def wait(longest: float) -> None:
        if rung.wait(longest):
            rung.clear()

    class Ringing(FileSystemEventHandler):
        """Rings for what changes a file; reading one is no event."""

        def on_any_event(self, event: FileSystemEvent) -> None:
            if event.event_type not in ("opened", "closed_no_write"):
                rung.set()

    observer = Observer()
    with suppress(OSError):  # no such folder, or no watches left
        observer.schedule(Ringing(), str(folder), recursive=True)
        observer.start()
    try:
        yield wait
    finally:
        observer.stop()
        with suppress(RuntimeError):  # it was never started
            observer.join(2.0)
