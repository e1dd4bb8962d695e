"""The walk over a campaign's results, in the order in which one follows from another."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Literal

from colonnade.campaign import Campaign, Test
from colonnade.dynamics.models.registry import MODELS
from colonnade.interruption import expect_none
from colonnade.store.provenance import Origin
from colonnade.store.results import ASKED_FOR, models_of, results_of
from colonnade.workflow.chain import Chain, clear_behind, is_fresh
from colonnade.workflow.execution.cluster import Tell
from colonnade.workflow.execution.processes import execute
from colonnade.workflow.raw_files import RawFiles
from colonnade.workflow.results import StageRun
from colonnade.workflow.steps import Graph, Step

Progress = Callable[[StageRun, int, int], None]


@dataclass
class Walk:
    """
    A run on its way.

    Attributes
    ----------
    graph : Graph
    run : str
        Its name, see `only_run`.
    raw : mapping of str to mapping of str to RawFile
        Raw files by test.
    redo_from, until : str or None
        Stage from which on results are made again, and the last one.
    workers, scheduler : optional
        Where tests are worked on, see `execute`.
    progress : callable or None
        Called with each stage of a test that ended, how many tests have, and of how many.
    tell : callable
        Told of workers that were stopped.
    stages : list of StageRun
        What became of each stage so far.
    failed : dict of str to str
        Why tests failed.
    unknown : dict of str to str
        Why specimens did: their tests cannot be predicted.
    """

    graph: Graph
    run: str
    raw: Mapping[str, RawFiles] = field(default_factory=dict)
    redo_from: str | None = None
    until: str = "report"
    workers: int | None = None
    scheduler: str | None = None
    progress: Progress | None = None
    tell: Tell = lambda sentence: None
    stages: list[StageRun] = field(default_factory=list)
    failed: dict[str, str] = field(default_factory=dict)
    unknown: dict[str, str] = field(default_factory=dict)
    _known: dict[tuple[str, str], list[Step]] = field(default_factory=dict)

    def through(self, tests: Sequence[str]) -> None:
        """Bring tests up to date, and the specimens that they need."""
        self._advance(self._measuring(name) for name in tests)
        if self._asks_for("predict"):
            needed = {self._test(name).specimen for name in tests}
            self._advance(
                self._measuring(name)
                for name in self.kept
                if name not in tests
                and self._test(name).kind == "free-vibration"
                and self._test(name).specimen in needed
            )
        if self._asks_for("restitution"):
            self.pool()
        if self._asks_for("predict"):
            self._calibrate(tests)
            self._predict(tests)

    @property
    def kept(self) -> list[str]:
        """Ids of the campaign's tests that people have not excluded."""
        return [name for name in self._campaign.tests if not self._campaign.review(name).excluded]

    def pool(self) -> None:
        """Bring the specimens up to date with the free vibrations that have been identified."""
        identified: dict[str, dict[str, Path]] = {name: {} for name in self._campaign.specimens}
        for name in self.kept:
            path = self.graph.layout.stage(name, "restitution")
            is_free = self._test(name).kind == "free-vibration"
            if is_free and self.graph.catalogue.attributes(path).get("status") == "done":
                identified[self._test(name).specimen][name] = path
        steps = [self.graph.pooling(name, paths) for name, paths in identified.items()]
        self._of_specimens(steps, workers=1)  # sooner done here than sent to a worker

    def stale(self) -> set[str]:
        """Ids of the tests of which a result, of whatever stage, is out of date or not there."""
        look = self.graph.catalogue.attributes
        steps = ([*self._steps("measuring", name), *self._steps("predicting", name)] for name in self.kept)
        chains = (self.chain(each, redo=False) for each in steps)
        return {chain.subject for chain in chains if is_fresh(chain, look) is None}

    def chain(self, steps: Sequence[Step], *, redo: bool = True) -> Chain:
        """Return the chain of some steps of one test or specimen; `redo` as the run was asked to, or not."""
        subject = steps[0].result.subject
        test = None if steps[0].result.is_of_specimen else self._test(subject)
        return Chain(
            steps,
            [] if test is None else results_of(self._campaign, test),
            self.graph.layout,
            self._campaign.path,
            Origin.of(self._campaign),
            self.run,
            self.redo_from if redo else None,
            {} if test is None else self.raw[subject],
        )

    @property
    def _campaign(self) -> Campaign:
        return self.graph.campaign

    def _test(self, name: str) -> Test:
        return self._campaign.tests[name]

    def _asks_for(self, stage: str) -> bool:
        return ASKED_FOR.index(self.until) >= ASKED_FOR.index(stage)

    def _measuring(self, name: str) -> list[Step]:
        return [step for step in self._steps("measuring", name) if self._asks_for(step.result.stage)]

    def _predicting(self, name: str) -> list[Step]:
        return [step for step in self._steps("predicting", name) if self._asks_for(step.result.stage)]

    def _steps(self, phase: Literal["measuring", "predicting"], name: str) -> list[Step]:
        """Return the steps of a test, made once: what a test reads of the campaign takes some time to gather."""
        if (phase, name) not in self._known:
            made_by = self.graph.measuring if phase == "measuring" else self.graph.predicting
            self._known[phase, name] = made_by(self._test(name))
        return self._known[phase, name]

    def _calibrate(self, tests: Sequence[str]) -> None:
        """Bring the laws of contact up to date of the specimens whose tests are predicted by a model that needs one."""
        asked = {
            test.specimen
            for test in map(self._test, tests)
            if any(MODELS[model].in_space for model in models_of(self._campaign, test))
        }
        wanted = [name for name in self._campaign.specimens if name in asked and name not in self.unknown]
        self._of_specimens(map(self.graph.calibrating, wanted), self.workers)

    def _predict(self, tests: Sequence[str]) -> None:
        layout, ready = self.graph.layout, []
        for name in tests:
            test = self._test(name)
            if test.specimen in self.unknown:
                clear_behind(layout, results_of(self._campaign, test), ASKED_FOR.index("restitution"))
                self.failed.setdefault(name, f"specimen {test.specimen}: {self.unknown[test.specimen]}")
            elif name not in self.failed:
                ready.append(name)
        self._advance(map(self._predicting, ready))

    def _of_specimens(self, steps: Iterable[Step], workers: int | None) -> None:
        for runs in self._walked([self.chain([step]) for step in steps], workers):
            self._note(runs)

    def _advance(self, steps_of_tests: Iterable[Sequence[Step]]) -> None:
        """Walk the chains of tests, those with nothing to do here and the others in worker processes."""
        chains = [self.chain(steps) for steps in steps_of_tests]
        for done, runs in enumerate(self._walked(chains, self.workers, self.scheduler), 1):
            self._note(runs)
            if self.progress is not None:
                for stage in runs:
                    self.progress(stage, done, len(chains))

    def _walked(
        self, chains: Iterable[Chain], workers: int | None, scheduler: str | None = None
    ) -> Iterator[list[StageRun]]:
        waiting = []
        for chain in chains:
            expect_none()
            standing = is_fresh(chain, self.graph.catalogue.attributes)
            if standing is None:
                waiting.append(chain)
            else:
                yield standing
        yield from execute(waiting, workers, scheduler, self.tell)

    def _note(self, runs: Iterable[StageRun]) -> None:
        """Keep what became of stages."""
        for stage in runs:
            self.stages.append(stage)
            if stage.action == "failed":
                (self.unknown if stage.is_of_specimen else self.failed)[stage.subject] = stage.reason
