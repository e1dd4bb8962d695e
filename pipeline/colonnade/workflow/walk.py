"""The walk over a campaign: tests up to their e, specimens, laws of contact, then predictions."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import Literal

from colonnade.campaign import Campaign, Test
from colonnade.campaign.assessing.assessment import Assessment
from colonnade.campaign.forms.summary import Summary
from colonnade.dynamics.models.registry import MODELS
from colonnade.interruption import expect_none
from colonnade.store import files
from colonnade.store.forecasts import Known
from colonnade.store.provenance import Origin
from colonnade.store.results import RUN_STAGES, ResultId, models_of, results_of
from colonnade.workflow.chain import Chain, bring_up_to_date, if_up_to_date, remove_later, why_pending
from colonnade.workflow.execution.blocks import Counted, forget, in_blocks
from colonnade.workflow.execution.cluster import Tell
from colonnade.workflow.execution.processes import execute
from colonnade.workflow.outcome import StageRun
from colonnade.workflow.raw_files import RawFiles
from colonnade.workflow.steps import Graph, Step

Progress = Callable[[StageRun, int, int], None]

Phase = Literal["measuring", "predicting"]
PHASES: tuple[Phase, ...] = ("measuring", "predicting")


@dataclass
class Walk:
    """
    A run in progress: what it works on and how, and what became of each stage so far.

    Attributes
    ----------
    graph : Graph
    run_id : str
        See `only_run`.
    raw : mapping of str to mapping of str to RawFile
        Raw files by test.
    start_from : str or None
        First stage whose results are recomputed whatever their state.
    until : str
        Last stage.
    workers, scheduler : optional
        Where the work is done, see `execute`.
    progress : callable or None
        Called with each stage of a test that ended, the number of tests done, and their total.
    tell : callable
        Called with a sentence if a worker was stopped.
    stages : list of StageRun
        What became of each stage so far.
    failed_tests : dict of str to str
        Why tests failed.
    failed_specimens : dict of str to str
        Why specimens failed: their tests cannot be predicted.
    failed_assessments : dict of str to str
        Why assessments failed.
    """

    graph: Graph
    run_id: str
    raw: Mapping[str, RawFiles] = field(default_factory=dict)
    start_from: str | None = None
    until: str = "report"
    workers: int | None = None
    scheduler: str | None = None
    progress: Progress | None = None
    tell: Tell = lambda sentence: None
    stages: list[StageRun] = field(default_factory=list)
    failed_tests: dict[str, str] = field(default_factory=dict)
    failed_specimens: dict[str, str] = field(default_factory=dict)
    failed_assessments: dict[str, str] = field(default_factory=dict)
    _known: dict[tuple[str, str], list[Step]] = field(default_factory=dict)

    def through(self, tests: Sequence[str]) -> None:
        """Bring tests up to date, and the specimens that they need."""
        self._walk_tests(self._measuring(name) for name in tests)
        if self._asks_for("predict"):
            needed = {self._test(name).specimen for name in tests}
            self._walk_tests(
                self._measuring(name)
                for name in self.included
                if name not in tests
                and self._test(name).kind == "free-vibration"
                and self._test(name).specimen in needed
            )
        if self._asks_for("restitution"):
            self.pool()
        if self._asks_for("predict"):
            self.calibrate(self._in_space(tests))
            self._predict(tests)

    def _measuring(self, name: str) -> list[Step]:
        return [step for step in self._steps("measuring", name) if self._asks_for(step.result.stage)]

    def _asks_for(self, stage: str) -> bool:
        return RUN_STAGES.index(self.until) >= RUN_STAGES.index(stage)

    @property
    def included(self) -> list[str]:
        """Ids of the tests that are run: not excluded, and not planned and still without a raw file."""
        return [name for name in self._campaign.tests if not self._campaign.left_out(name)]

    def at_once(self, name: str) -> list[ResultId]:
        """
        Bring one test up to date as far as it takes seconds: to the predictions by the models in the plane, with the e
        that is known so far. Return the results that are there then.
        """
        specimen = self._test(name).specimen
        steps = self._measuring(name)
        self._walk_tests([steps])
        self.pool([specimen])
        if name not in self.failed_tests and specimen not in self.failed_specimens:
            predicting = [
                step
                for step in self._steps("predicting", name)
                if step.result.stage == "predict" and not MODELS[str(step.result.model)].in_space
            ]
            if predicting:
                self._walk_tests([predicting])
            steps = [*steps, *predicting]
        return [step.result for step in steps if step.path.exists()]

    def pool(self, specimens: Sequence[str] | None = None) -> None:
        """Bring specimens, by default all, up to date with the free vibrations that have been identified."""
        chosen = self._campaign.specimens if specimens is None else specimens
        identified: dict[str, dict[str, Path]] = {name: {} for name in chosen}
        for name in self.included:
            path = self.graph.layout.stage(name, "restitution")
            is_free = self._test(name).kind == "free-vibration" and self._test(name).specimen in identified
            if is_free and self.graph.catalogue.attributes(path).get("status") == "done":
                identified[self._test(name).specimen][name] = path
        steps = [self.graph.pooling(name, paths) for name, paths in identified.items()]
        self._walk_specimens(steps, workers=1)  # faster here than in a worker

    def calibrate(self, specimens: Collection[str]) -> None:
        """Bring the laws of contact of specimens up to date."""
        wanted = [name for name in self._campaign.specimens if name in specimens and name not in self.failed_specimens]
        self._walk_specimens(map(self.graph.calibrating, wanted), self.workers)

    def _in_space(self, tests: Sequence[str]) -> set[str]:
        """Specimens whose tests use a model that needs a law of contact."""
        return {
            test.specimen
            for test in map(self._test, tests)
            if any(MODELS[model].in_space for model in models_of(self._campaign, test))
        }

    def _predict(self, tests: Sequence[str]) -> None:
        layout, ready = self.graph.layout, []
        for name in tests:
            test = self._test(name)
            if test.specimen in self.failed_specimens:
                remove_later(layout, results_of(self._campaign, test), RUN_STAGES.index("restitution"))
                self.failed_tests.setdefault(name, f"specimen {test.specimen}: {self.failed_specimens[test.specimen]}")
            elif name not in self.failed_tests:
                ready.append(name)
        self._walk_tests(map(self._predicting, ready))

    def map(self, summary: Summary) -> None:
        """Bring the maps up to date of specimens with sine tests at several frequencies, by their records."""
        from colonnade.workflow.maps.kept import map_steps

        known = [name for name in self._campaign.specimens if name not in self.failed_specimens]
        self._walk_specimens(map_steps(self.graph, summary, known), self.workers)

    def assess(self, assessments: Mapping[str, Assessment], tell: Counted | None = None) -> None:
        """Bring assessments up to date, their histories in blocks on all processes."""
        for name, asked in assessments.items():
            step = self._assessing(name, asked, tell)
            if reason := self.failed_specimens.get(asked.specimen):
                files.remove(step.path)
                self.failed_assessments[name] = f"specimen {asked.specimen}: {reason}"
                continue
            chain = self.chain([step])
            self._note(if_up_to_date(chain, self.graph.catalogue.attributes) or bring_up_to_date(chain))
            forget(self.graph.layout.blocks(step.result))

    def stale_assessments(self) -> set[str]:
        """Names of the assessments whose result is missing or outdated."""
        look = self.graph.catalogue.attributes
        steps = {name: self._assessing(name, asked) for name, asked in self._campaign.assessments.items()}
        return {name for name, step in steps.items() if if_up_to_date(self.chain([step], redo=False), look) is None}

    def _assessing(self, name: str, asked: Assessment, tell: Counted | None = None) -> Step:
        from colonnade.workflow.assessing.steps import assessing

        spread = partial(in_blocks, workers=self.workers, scheduler=self.scheduler, progress=tell)
        return assessing(self.graph, name, asked, spread)

    def score(self, forecasts: Mapping[str, Known], outdated: Collection[str]) -> None:
        """
        Bring the scores of forecasts up to date, given the one that counts of each test; tests without one have none.
        """
        measured = [name for name in forecasts if name not in outdated and name not in self.failed_tests]
        for name in self._campaign.tests.keys() - measured:
            files.remove(self.graph.layout.stage(name, "forecast"))
        self._walk_tests([self.graph.scoring(self._test(name), forecasts[name])] for name in measured)

    def _predicting(self, name: str) -> list[Step]:
        return [step for step in self._steps("predicting", name) if self._asks_for(step.result.stage)]

    def _steps(self, phase: Phase, name: str) -> list[Step]:
        """Return the steps of a test, made once: gathering what they read of the campaign takes time."""
        if (phase, name) not in self._known:
            made_by = self.graph.measuring if phase == "measuring" else self.graph.predicting
            self._known[phase, name] = made_by(self._test(name))
        return self._known[phase, name]

    def _walk_tests(self, steps_of_tests: Iterable[Sequence[Step]]) -> None:
        """Bring the chains of tests up to date: those with nothing to do here, the others in worker processes."""
        chains = [self.chain(steps) for steps in steps_of_tests]
        for done, runs in enumerate(self._walk_chains(chains, self.workers, self.scheduler), 1):
            self._note(runs)
            if self.progress is not None:
                for stage in runs:
                    self.progress(stage, done, len(chains))

    def _walk_specimens(self, steps: Iterable[Step], workers: int | None) -> None:
        for runs in self._walk_chains([self.chain([step]) for step in steps], workers):
            self._note(runs)

    def _walk_chains(
        self, chains: Iterable[Chain], workers: int | None, scheduler: str | None = None
    ) -> Iterator[list[StageRun]]:
        waiting = []
        for chain in chains:
            expect_none()
            standing = if_up_to_date(chain, self.graph.catalogue.attributes)
            if standing is None:
                waiting.append(chain)
            else:
                yield standing
        yield from execute(waiting, workers, scheduler, self.tell)

    def _note(self, runs: Iterable[StageRun]) -> None:
        """Keep what became of stages, and why those failed that did."""
        for stage in runs:
            self.stages.append(stage)
            if stage.action == "failed":
                failed = {"test": self.failed_tests, "specimen": self.failed_specimens}
                failed.get(stage.of, self.failed_assessments)[stage.subject] = stage.reason

    def chain(self, steps: Sequence[Step], *, redo: bool = True) -> Chain:
        """Return the chain of some steps of one test or specimen; without `redo`, ignore `start_from`."""
        subject = steps[0].result.subject
        test = self._test(subject) if steps[0].result.of == "test" else None
        return Chain(
            steps,
            [] if test is None else results_of(self._campaign, test),
            self.graph.layout,
            self._campaign.path,
            Origin.of(self._campaign),
            self.run_id,
            self.start_from if redo else None,
            {} if test is None else self.raw[subject],
        )

    def stale(self, *phases: Phase) -> dict[str, str]:
        """Ids of the tests that have a missing or outdated result, of these phases or of any, and what to say of it."""
        look = self.graph.catalogue.attributes
        steps = ([step for phase in phases or PHASES for step in self._steps(phase, name)] for name in self.included)
        chains = [self.chain(each, redo=False) for each in steps]
        return {chain.subject: why for chain in chains if (why := why_pending(chain, look)) is not None}

    @property
    def _campaign(self) -> Campaign:
        return self.graph.campaign

    def _test(self, name: str) -> Test:
        return self._campaign.tests[name]
