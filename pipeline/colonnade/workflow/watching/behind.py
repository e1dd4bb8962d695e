"""The rest of the work, in a process of its own at lower priority: it gives way to a file, and ends with the watch."""

from __future__ import annotations

import contextlib
import json
import os
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import IO

from colonnade.workflow import orphans
from colonnade.workflow.lock import is_refusal

NICENESS = 10
"""How far its priority is below that of the watch."""

PATIENCE = 3.0
"""Seconds in which it has to give way; then it is killed, which loses nothing but the steps in progress."""


_WINDOWS_FLAGS = sum(
    getattr(subprocess, flag, 0) for flag in ("BELOW_NORMAL_PRIORITY_CLASS", "CREATE_NEW_PROCESS_GROUP")
)


@dataclass(frozen=True)
class Ended:
    """
    A run that has ended.

    Attributes
    ----------
    code : int
        Its exit code.
    failures : tuple of str
        A sentence on each test or specimen that failed.
    problem : str
        What it wrote to stderr if it gave no result: it was refused, it crashed, or the disk is full.
    """

    code: int
    failures: tuple[str, ...]
    problem: str

    @property
    def was_refused(self) -> bool:
        """Whether another run held the campaign."""
        return is_refusal(self.problem)

    @property
    def headline(self) -> str:
        """The line of the problem that says what happened: of a traceback the first below its frames, else the last."""
        _, trace, last = self.problem.rpartition("Traceback (most recent call last):")
        lines = [line for line in last.splitlines() if line and not line[0].isspace()]
        return lines[0 if trace else -1]


@dataclass
class Behind:
    """
    A run of the campaign behind the watch.

    Attributes
    ----------
    campaign_file : Path
    results : Path or None
        As for `run`.
    workers : int or None
        As for `run`.
    """

    campaign_file: Path
    results: Path | None
    workers: int | None
    _running: tuple[subprocess.Popen[bytes], IO[bytes], IO[bytes]] | None = None  # with its stdout and stderr

    def start(self) -> None:
        """Begin a run."""
        output, complaints = (tempfile.TemporaryFile() for _ in range(2))  # noqa: SIM115 — `_end` closes
        command = [sys.executable, "-m", orphans.__name__, str(os.getpid())]
        command += ["run", str(self.campaign_file), "--await", "--json"]
        command += [] if self.results is None else ["--results", str(self.results)]
        command += [] if self.workers is None else ["--workers", str(self.workers)]
        process = subprocess.Popen(
            command,
            stdin=subprocess.DEVNULL,
            stdout=output,
            stderr=complaints,
            process_group=0 if os.name == "posix" else None,
            creationflags=_WINDOWS_FLAGS,
        )
        self._running = process, output, complaints
        if os.name == "posix":
            with contextlib.suppress(OSError):
                os.setpriority(os.PRIO_PGRP, process.pid, NICENESS)

    @property
    def is_running(self) -> bool:
        """Whether it was started and its end is not taken note of yet."""
        return self._running is not None

    def ended(self) -> Ended | None:
        """Return how a run has ended by itself, once; else None."""
        return None if self._running is None or self._running[0].poll() is None else self._end(*self._running)

    def give_way(self) -> None:
        """Stop it: what it finished is kept, the rest is done by the next."""
        if self._running is None:
            return
        process, *_ = self._running
        process.terminate()
        try:
            process.wait(PATIENCE)
        except subprocess.TimeoutExpired:
            process.kill()  # its workers end with it
        self._end(*self._running)

    def _end(self, process: subprocess.Popen[bytes], output: IO[bytes], complaints: IO[bytes]) -> Ended:
        code, self._running = process.wait(), None
        with output, complaints:
            for stream in (output, complaints):
                stream.seek(0)
            said = complaints.read().decode(errors="replace").strip()
            try:
                stages = json.loads(output.read() or b"{}").get("stages")
            except (ValueError, RecursionError):
                stages = None
        problem = "" if stages is not None else said or f"It ended with exit code {code}."
        failed = [each for each in stages or () if each["action"] == "failed"]
        return Ended(code, tuple(f"{each['subject']}: {each['reason']}" for each in failed), problem)
