"""
The guard against orphans: a process ends when its parent is gone, however that ended.

`python -m colonnade.workflow.orphans PID run …` is the command `colonnade` behind a watch: it stops in order, as by
SIGTERM, so that finished results are kept. A module of its own, as it is run by name and imports next to nothing.
"""

from __future__ import annotations

import os
import runpy
import sys
import time
from collections.abc import Callable
from threading import Thread

from colonnade.interruption import stop

PATROL = 0.1
"""Seconds between two checks that the parent is alive."""


def end_with(parent: int, end: Callable[[], object]) -> None:
    """Call a function, in a thread, once the parent of this process is not this one any more."""
    Thread(target=_wait_for_end, args=(parent, end), daemon=True).start()


def _wait_for_end(parent: int, end: Callable[[], object]) -> None:
    while os.getppid() == parent:
        time.sleep(PATROL)
    end()


if __name__ == "__main__":
    end_with(int(sys.argv.pop(1)), stop)
    runpy.run_module("colonnade", run_name="__main__", alter_sys=True)
