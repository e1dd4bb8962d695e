"""Files of a recorder's share, copied into the campaign's raw folder once they are finished; nothing is overwritten."""

from __future__ import annotations

import os
import shutil
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

from colonnade.campaign.found import files_in
from colonnade.readers.files import sha256_of
from colonnade.workflow.watching.arrivals import Arrivals, marks_of

UNFINISHED = ".partial"
"""Ending of a copy until it is whole."""


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
    _said: set[str] = field(default_factory=set)

    def copy_finished(self, now: float) -> Iterator[str]:
        """Copy what has been finished since the last call; give a sentence on each file that could not be copied."""
        names = {self.source / name: name for name in files_in(self.source)}
        if not names and not self.source.is_dir():
            yield from self._once(f"{self.source}: this folder cannot be seen. Is the share connected?")
            return
        for path in sorted(self.arrivals.look(marks_of(names), now) & names.keys()):
            problem = _copy(path, self.target / names[path])
            if problem:
                yield from self._once(problem)

    def _once(self, sentence: str) -> Iterator[str]:
        if sentence not in self._said:
            self._said.add(sentence)
            yield sentence


def _copy(source: Path, target: Path) -> str:
    """Copy a file unless one of that name is there; return what is wrong."""
    digest = sha256_of(source)
    if digest is None:
        return f"{source}: it cannot be read; it was not copied."
    if target.exists():
        same = sha256_of(target) == digest
        return "" if same else f"{source}: {target.name} is there already and differs. It was kept; rename one of them."
    partial = target.with_name(target.name + UNFINISHED)
    try:
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(source, partial)
        if sha256_of(partial) != digest:
            return f"{source}: the copy differs from it; it was not kept. Is the file still being written?"
        os.link(partial, target)  # unlike a rename it never replaces a file
    except FileExistsError:
        return f"{source}: {target.name} appeared meanwhile; it was kept."
    except OSError as error:
        return f"{source}: it could not be copied ({error.strerror or error})."
    finally:
        partial.unlink(missing_ok=True)
    return ""
