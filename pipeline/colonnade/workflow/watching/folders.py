"""The files that a watch looks at, and how it learns that something happened in their folders."""

from __future__ import annotations

import contextlib
import os
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

POLL = 1.0
"""Seconds between two looks at a folder without events."""

REST = 5.0
"""Seconds between two looks at a folder with events, in case one was lost."""

REMOTE = ("nfs", "cifs", "smb", "9p", "sshfs", "fuse", "afs", "vboxsf", "drvfs", "virtiofs", "ceph", "gluster")
"""Beginnings of kinds of file systems on which changes made elsewhere give no event."""


class Bell:
    """Rings when something happens in a folder; with events it is waited for, without it is a pause."""

    def __init__(self, *, has_events: bool) -> None:
        self.has_events = has_events
        self._rung = threading.Event()

    def ring(self) -> None:
        """Say that something happened."""
        self._rung.set()

    def wait(self, longest: float | None = None) -> None:
        """Wait until something happened, or a look is due."""
        due = REST if self.has_events else POLL
        if self._rung.wait(due if longest is None else min(longest, due)):
            self._rung.clear()


@contextmanager
def listening(folder: Path) -> Iterator[Bell]:
    """Listen to a folder; where the system gives no events it is polled."""
    if not folder.is_dir() or _is_remote(folder):
        yield Bell(has_events=False)
        return
    from watchdog.events import FileSystemEvent, FileSystemEventHandler
    from watchdog.observers import Observer

    bell = Bell(has_events=True)

    class Ringing(FileSystemEventHandler):
        """Rings for what changes a file; reading one is no event."""

        def on_any_event(self, event: FileSystemEvent) -> None:
            if event.event_type not in ("opened", "closed_no_write"):
                bell.ring()

    observer = Observer()
    try:
        observer.schedule(Ringing(), str(folder), recursive=True)
        observer.start()
    except OSError:  # no watches left
        yield Bell(has_events=False)
        return
    try:
        yield bell
    finally:
        observer.stop()
        with contextlib.suppress(RuntimeError):
            observer.join(2.0)


def _is_remote(folder: Path) -> bool:
    """Whether a folder is on a file system of another machine, as far as the system says."""
    try:
        mounts = Path("/proc/mounts").read_text(encoding="utf-8", errors="replace").splitlines()
        resolved = os.path.realpath(folder)
    except OSError:
        return False
    best, kind = "", ""
    for mount in mounts:
        _, point, system, *_ = [*mount.split(" "), "", "", ""]
        point = point.replace("\\040", " ")
        if (resolved == point or resolved.startswith(point.rstrip("/") + "/")) and len(point) >= len(best):
            best, kind = point, system
    return kind.startswith(REMOTE)
