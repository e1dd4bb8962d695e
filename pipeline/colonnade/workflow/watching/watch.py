"""Watch: a line on each test seconds after its file is finished, and all other work behind it."""

from __future__ import annotations

import multiprocessing
import os
import time
import traceback
from collections.abc import Callable, Iterable, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from datetime import datetime
from multiprocessing.connection import Connection
from pathlib import Path

from colonnade import interruption
from colonnade.campaign import Campaign, load
from colonnade.campaign.campaign import missing_files
from colonnade.campaign.forms.summary import TestSummary
from colonnade.campaign.found import WITHOUT_TEST, files_in
from colonnade.errors import CampaignError, ColonnadeError, StoreError
from colonnade.report.addresses import EVERY, state_script
from colonnade.store import files
from colonnade.store.layout import Layout
from colonnade.store.records.advice import Advice
from colonnade.workflow.advising import advise_after
from colonnade.workflow.executors import settle_in
from colonnade.workflow.lock import is_refusal
from colonnade.workflow.product import marks_of
from colonnade.workflow.watching.arrivals import POLL, Arrivals, Share, listening
from colonnade.workflow.watching.measure import Line, measure, measured, notify

TEXTS = ("review.toml", "tests.csv", "tests.xlsx")
"""Files next to the campaign file that people change while it is watched."""

AGAIN = 2.0
"""Seconds until the next try if another run held the campaign, or results could not be written."""

GRACE = 10.0
"""Seconds without a change after which a file that cannot be used is called a failure."""

BUSY = 0.2
"""Seconds between two looks while something goes on."""

Say = Callable[[str], None]
Show = Callable[[Line | Advice], None]


def watch(
    campaign: Path | str,
    *,
    share: Path | None = None,
    command: Sequence[str] = (),
    once: bool = False,
    workers: int | None = None,
    results: Path | str | None = None,
    show: Show,
    say: Say,
) -> int:
    """
    Watch a campaign until it is interrupted.

    Parameters
    ----------
    campaign : Path or str
        A campaign.toml or its folder.
    share : Path, optional
        A recorder's folder; its finished files are copied into the watched folder.
    command : sequence of str, optional
        Program and arguments that get each line, see `notify`.
    once : bool, optional
        Handle what is there and all that follows from it, then end.
    workers, results : optional
        As for `run`.
    show : callable
        Called with the line on each test, and then with the advice on the next test like it.
    say : callable
        Called with a sentence on anything else.

    Returns
    -------
    code : int
        With `once`, the exit code of the run: 0, or 1 if a test failed.

    Raises
    ------
    CampaignError
        If the campaign file is not usable at the start.
    """
    loaded = load(Path(campaign)).awaiting()
    layout = Layout.of(loaded.path, results)
    folder = loaded.folder / loaded.watch.folder
    shared = None if share is None else Share(share, folder, Arrivals(loaded.watch.settle))
    with listening(folder) as wait:
        watching = _Watching(loaded, layout, wait, workers, command, show, say, once, shared)
        try:
            return watching.until_done()
        finally:
            watching.give_way()
            watching.tell_pages(is_watched=False)


@dataclass
class _Watching:
    """A watch in progress."""

    campaign: Campaign
    layout: Layout
    wait: Callable[[float], None]
    workers: int | None
    command: Sequence[str]
    show: Show
    say: Say
    is_once: bool
    share: Share | None
    _arrivals: Arrivals = field(init=False)
    _behind: Behind | None = None
    _due: dict[str, float] = field(default_factory=dict)
    _is_outdated: bool = True
    _behind_from: float = 0.0
    _code: int = 0
    _said: set[str] = field(default_factory=set)
    _measured: dict[str, TestSummary] = field(default_factory=dict)
    _alive: float = 0.0
    _line: str = ""
    _line_written: float = 0.0

    def __post_init__(self) -> None:
        """Take the files of tests that are measured already for known, and what people change as it is."""
        self._arrivals = Arrivals(self.campaign.watch.settle)
        self._arrivals.know(marks_of([*self._files(measured(self.campaign, self.layout)), *self._texts]))

    def until_done(self) -> int:
        """Watch until a signal ends it or, if it is only asked for once, until nothing is left to do."""
        self._look()
        while True:
            is_busy = self._arrivals.is_waiting or self._due or self._behind
            if self.is_once and not (is_busy or self._is_outdated):
                return self._code
            self.wait(BUSY if is_busy or self.is_once else POLL)
            self._look()

    def give_way(self) -> None:
        """Stop the run behind, if there is one."""
        if self._behind is not None:
            self._behind.give_way()
            self._behind = None

    def tell_pages(self, *, is_watched: bool = True) -> None:
        """Give a sign of life to open pages."""
        self._alive = time.monotonic()
        # The overview is the last page that is written, so its mark changes when all pages are there.
        mark = marks_of([self.layout.report]).get(self.layout.report, ())
        text = state_script(
            is_watched=is_watched,
            written=time.time(),
            shown="-".join(map(str, mark)),
            line=self._line,
            line_written=self._line_written,
        )
        with suppress(StoreError):  # the watch goes on; a page that is open keeps what it shows
            files.write_text(self.layout.state, text)

    def _look(self) -> None:
        """Look once at what arrived, and go on with what is to be done."""
        interruption.expect_none()
        now = time.monotonic()
        for problem in () if self.share is None else self.share.copy_finished(now):
            self._say_once(problem)
        folder = self.campaign.folder / self.campaign.watch.folder
        watched = {*(folder / name for name in files_in(folder)), *self._files(self.campaign.tests), *self._texts}
        if finished := self._arrivals.look(marks_of(watched), now):
            self._is_outdated |= not finished.isdisjoint(self._texts)
            self._reload()
            self._due |= {name: now for name in self.campaign.tests if not finished.isdisjoint(self._files([name]))}
        for name in [name for name, due in self._due.items() if due <= now]:
            del self._due[name]
            self._is_outdated = True
            self._measure(name, now)
        self._go_on(now)

    def _measure(self, name: str, now: float) -> None:
        """Bring a test up to its line, unless it is left out or a file of it is still to come."""
        test = self.campaign.tests.get(name)
        if test is None or self.campaign.left_out(name) or missing_files([test], self.campaign.folder):
            return
        self.give_way()
        try:
            line = measure(self.campaign, self.layout, name)
        except StoreError as error:
            self._say_once(str(error))
            if not self.is_once or is_refusal(str(error)):
                self._due[name] = now + AGAIN
            return
        changed = max((since for _, since, _ in marks_of(test.files.values()).values()), default=0) / 1e9
        if line.record.status == "failed" and time.time() - changed < GRACE:
            self._due[name] = now + GRACE  # its writer may only pause
            return
        self._line, self._line_written = line.text(), time.time()
        self._show(line)
        self.tell_pages()
        if self.command and (problem := notify(self.command, line.as_json())):
            self._say_once(problem)
        if line.record.status == "done":
            self._measured[name] = line.record
            for advice in advise_after(self.campaign, self.layout, name, self._measured):
                self._show(advice)

    def _go_on(self, now: float) -> None:
        """Start, or take note of, the run behind; give a sign of life to open pages."""
        ended = None if self._behind is None else self._behind.ended()
        if ended is not None:
            self._behind = None
            self._code = int(bool(ended.failures or ended.problem))
            for failure in ended.failures:
                self._say_once(failure)
            if is_refusal(ended.problem):
                self._is_outdated, self._behind_from = True, now + AGAIN
            elif ended.problem:
                self._log(ended.problem)
                self._say_once(
                    f"The run behind the watch failed: {ended.problem.splitlines()[0]}\n"
                    f"All that it said is in {self.layout.watch_log}. It starts again after the next file."
                )
        is_free = not (self._due or self._arrivals.is_waiting or self._behind)
        if self._is_outdated and is_free and now >= self._behind_from:
            self._is_outdated = False
            self._behind = Behind(self.campaign.path, self.layout.results, self.workers)
        if ended is not None or now - self._alive >= EVERY:
            self.tell_pages()

    def _reload(self) -> None:
        """Read the campaign again; if it cannot be used now, the last one that could is kept."""
        try:
            self.campaign = load(self.campaign.path).awaiting()
        except CampaignError as error:
            self._say_once(f"{error}\nThe campaign as it was before is used until this is corrected.")
            return
        for found in self.campaign.warnings:
            if found.kind == WITHOUT_TEST:
                self._say_once(str(found))

    def _show(self, line: Line | Advice) -> None:
        self._log(line.text())
        self.show(line)

    def _say_once(self, sentence: str) -> None:
        if sentence not in self._said:
            self._said.add(sentence)
            self.say(sentence)
            self._log(sentence)

    def _log(self, text: str) -> None:
        with suppress(OSError), self.layout.watch_log.open("a", encoding="utf-8") as log:
            log.write(f"{datetime.now():%Y-%m-%d %H:%M:%S} {text}\n")

    def _files(self, tests: Iterable[str]) -> list[Path]:
        return [path for name in tests for path in self.campaign.tests[name].files.values()]

    @property
    def _texts(self) -> list[Path]:
        return [self.campaign.path, *(self.campaign.folder / name for name in TEXTS)]


NICENESS = 10
"""How far its priority is below that of the watch."""


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


class Behind:
    """A run of the campaign of this file behind the watch; results and workers are as for `run`."""

    def __init__(self, campaign_file: Path, results: Path | None, workers: int | None) -> None:
        context = multiprocessing.get_context("spawn")
        self._told, tell = context.Pipe(duplex=False)
        self._process = context.Process(target=_run, args=(tell, os.getpid(), campaign_file, results, workers))
        with interruption.held_back(), tell:  # Ctrl-C is for the watch, which ends it
            self._process.start()

    def ended(self) -> Ended | None:
        """Return how it has ended by itself; None while it goes on."""
        if not self._told.poll():
            return None
        try:
            ended: Ended | None = self._told.recv()
        except EOFError:
            ended = None
        self.give_way()  # it has nothing left to do, but must not hold the watch
        return ended or Ended(problem=f"It ended with exit code {self._process.exitcode}.")

    def give_way(self) -> None:
        """Kill it and its workers, which loses nothing but the steps in progress: the rest is done by the next."""
        self._process.kill()
        self._process.join()
        self._told.close()


def _run(tell: Connection, watch: int, campaign_file: Path, results: Path | None, workers: int | None) -> None:
    """Run a campaign, and tell how it ended; end with the watch."""
    settle_in(watch)
    # Its result goes through the pipe. Workers of a killed run would print tracebacks between the lines of the watch.
    nothing = os.open(os.devnull, os.O_RDWR)
    for stream in (1, 2):
        os.dup2(nothing, stream)
    if hasattr(os, "nice"):
        os.nice(NICENESS)
    try:
        from colonnade.workflow.run import run

        stages = run(campaign_file, results=results, workers=workers, awaiting=True).stages
        tell.send(Ended(tuple(f"{stage.subject}: {stage.reason}" for stage in stages if stage.action == "failed")))
    except ColonnadeError as error:
        tell.send(Ended(problem=str(error)))
    except Exception as error:
        tell.send(Ended(problem=f"{type(error).__name__}: {error}\n{traceback.format_exc()}"))
