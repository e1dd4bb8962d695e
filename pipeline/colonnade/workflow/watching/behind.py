"""The rest of the work, in a process of its own at lower priority: it gives way to a file, and ends with the watch."""

from __future__ import annotations

import multiprocessing
import os
import traceback
from dataclasses import dataclass
from multiprocessing.connection import Connection
from multiprocessing.process import BaseProcess
from pathlib import Path

from colonnade import interruption
from colonnade.errors import ColonnadeError
from colonnade.workflow.executors import end_with

NICENESS = 10
"""How far its priority is below that of the watch."""

PATIENCE = 3.0
"""Seconds in which it has to give way; then it is killed, which loses nothing but the steps in progress."""


@dataclass(frozen=True)
class Ended:
    """
    A run that has ended.

    Attributes
    ----------
    failures : tuple of str
        A sentence on each test or specimen that failed.
    problem : str
        Why it gave no result, first in one line: it was refused, it crashed, or the disk is full.
    """

    failures: tuple[str, ...] = ()
    problem: str = ""


@dataclass
class Behind:
    """A run of the campaign of this file behind the watch; results and workers are as for `run`."""

    campaign_file: Path
    results: Path | None
    workers: int | None
    _running: tuple[BaseProcess, Connection] | None = None

    def start(self) -> None:
        """Begin a run."""
        context = multiprocessing.get_context("spawn")
        told, tell = context.Pipe(duplex=False)
        given = (tell, os.getpid(), self.campaign_file, self.results, self.workers)
        process = context.Process(target=_run, args=given)
        with interruption.held_back(), tell:  # Ctrl-C is for the watch, which ends it
            process.start()
        self._running = process, told

    @property
    def is_running(self) -> bool:
        """Whether it was started and its end is not taken note of yet."""
        return self._running is not None

    def ended(self) -> Ended | None:
        """Return how a run has ended by itself, once; else None."""
        if self._running is None or not self._running[1].poll():
            return None
        process, told = self._running
        try:
            ended: Ended | None = told.recv()
        except EOFError:
            ended = None
        self._end()  # it has nothing left to do, but must not hold the watch
        return ended or Ended(problem=f"It ended with exit code {process.exitcode}.")

    def give_way(self) -> None:
        """Stop it: what it finished is kept, the rest is done by the next."""
        if self._running is not None:
            self._running[0].terminate()
            self._end()

    def _end(self) -> None:
        """Wait for its end, and bring it about if it takes long; its workers end with it."""
        assert self._running is not None
        process, told = self._running
        self._running = None
        process.join(PATIENCE)
        process.kill()
        process.join()
        told.close()


def _run(tell: Connection, watch: int, campaign_file: Path, results: Path | None, workers: int | None) -> None:
    """Run a campaign, and tell how it ended; stop in order, so that finished results are kept, when the watch ends."""
    interruption.listen()
    end_with(watch, interruption.stop)
    if hasattr(os, "nice"):
        os.nice(NICENESS)
    try:
        from colonnade.workflow.run import run

        stages = run(campaign_file, results=results, workers=workers, awaiting=True).stages
        tell.send(Ended(tuple(f"{stage.subject}: {stage.reason}" for stage in stages if stage.action == "failed")))
    except KeyboardInterrupt:
        pass
    except ColonnadeError as error:
        tell.send(Ended(problem=str(error)))
    except Exception as error:
        tell.send(Ended(problem=f"{type(error).__name__}: {error}\n{traceback.format_exc()}"))
    interruption.stop_listening()
