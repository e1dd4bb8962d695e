"""
The command `colonnade` behind a watch: `python -m colonnade.workflow.watching.led run …`.

Its standard input is a pipe that the watch holds open. When the watch ends, however it ends, so does the pipe, and the
command stops in order, as by SIGTERM: finished results are kept.
"""

from __future__ import annotations

import os
import runpy
import sys
from threading import Thread

from colonnade.interruption import stop


def end_with(pipe: int) -> None:
    """Stop this process when nobody holds the other end of a pipe any more."""
    Thread(target=_wait_for_end, args=(pipe,), daemon=True).start()


def _wait_for_end(pipe: int) -> None:
    while os.read(pipe, 1):
        pass
    stop()


if __name__ == "__main__":
    end_with(sys.stdin.fileno())
    runpy.run_module("colonnade", run_name="__main__", alter_sys=True)
