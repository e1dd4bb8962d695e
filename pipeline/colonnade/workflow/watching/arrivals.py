"""Which files have been finished by whoever writes them, or taken away: they stay the same, or away, for a while."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from colonnade.workflow.catalogue import Mark, mark_of


def marks_of(paths: Iterable[Path]) -> dict[Path, Mark]:
    """Return the present mark of each file that is there."""
    marks = {}
    for path in paths:
        try:
            marks[path] = mark_of(path)
        except OSError:
            continue
    return marks


def last_change(paths: Iterable[Path]) -> int:
    """Return when the last of some files was changed, ns since 1970; 0 if none is there."""
    return max((nanoseconds for _, nanoseconds, _ in marks_of(paths).values()), default=0)


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
