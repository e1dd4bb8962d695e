"""The walk over a campaign: tests up to their e, specimens, laws of contact, then predictions and what follows."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field, replace
from functools import partial
from itertools import groupby, zip_longest

from colonnade.campaign import Campaign
from colonnade.campaign.assessment import Assessment
from colonnade.dynamics.models import MODELS
from colonnade.errors import StoreError
from colonnade.findings import Finding
from colonnade.interruption import expect_none
from colonnade.store import files
from colonnade.store.forecasts import Known
from colonnade.store.layout import Layout
from colonnade.store.provenance import Origin
from colonnade.store.results import RUN_STAGES, ResultId, Subject, models_of
from colonnade.workflow.chain import Chain, StageRun, bring_up_to_date, worker_lost
from colonnade.workflow.executors import HERE, Where, spread
from colonnade.workflow.graph import Graph
from colonnade.workflow.lock import only_run
from colonnade.workflow.product import Catalogue, Product

Progress = Callable[[StageRun, int, int], None]


@dataclass
class Walk:
    """
    A run in progress: what it works on and how, and what became of each stage so far.

    Attributes
    ----------
    graph : Graph
    run_id : str
        See `only_run`.
    start_from : str or None
        First stage whose results are recomputed whatever their state.
    until : str
        Last stage.
    where : Where
        Where the work is done, and who is told of the blocks of assessments and maps.
    progress : callable or None
        Called with each stage of a test that ended, the number of tests done, and their total.
    stages : list of StageRun
        What became of each stage so far.
    failed : dict of dict of str to str
        Why tests, specimens and assessments failed.
    """

    graph: Graph
    run_id: str
    start_from: str | None = None
    until: str = "report"
    where: Where = HERE
    progress: Progress | None = None
    stages: list[StageRun] = field(default_factory=list)
    failed: dict[Subject, dict[str, str]] = field(default_factory=lambda: defaultdict(dict))
    _known: dict[str, list[Product]] = field(default_factory=dict)

    def through(self, tests: Sequence[str]) -> None:
        """Bring tests up to date, and the specimens that they need."""
        campaign = self.graph.campaign
        predicted = tests if RUN_STAGES.index("predict") <= RUN_STAGES.index(self.until) else ()
        measured = dict.fromkeys(
            [*tests, *self._free_vibrations({campaign.tests[name].specimen for name in predicted})]
        )
        self.follow(self._results(name, until="restitution") for name in measured)
        self.pool()
        models = {name: models_of(campaign, campaign.tests[name]) for name in tests}
        in_space = [name for name in tests if any(MODELS[model].in_space for model in models[name])]
        self.calibrate({campaign.tests[name].specimen for name in in_space})
        self.follow(self._results(name, "predict") for name in tests)

    def warn(self, findings: Iterable[Finding]) -> None:
        """Add findings to those of the campaign."""
        self.graph = replace(self.graph, campaign=self.graph.campaign.warned(findings))

    def at_once(self, name: str) -> list[ResultId]:
        """
        Bring one test up to date as far as it takes seconds: to the predictions by the models in the plane, with the e
        that is known so far. Return the results that are there then.
        """
        products = self._results(name, until="restitution")
        self.follow([products])
        self.pool([self.graph.campaign.tests[name].specimen])
        predicted = self._results(name, "predict", "predict")
        fast = [each for each in predicted if not MODELS[str(each.result.model)].in_space]
        self.follow([fast])
        return [product.result for product in (*products, *fast) if product.paths[0].exists()]

    def pool(self, specimens: Collection[str] | None = None) -> None:
        """Bring specimens, by default all, up to date with the free vibrations that have been identified."""
        look, layout = self.graph.catalogue.attributes, self.graph.layout
        for specimen in self.graph.campaign.specimens if specimens is None else specimens:
            free = self._free_vibrations({specimen})
            done = [name for name in free if look(layout.stage(name, "restitution")).get("status") == "done"]
            self.follow([[self.graph.pooling(specimen, done)]])

    def calibrate(self, specimens: Collection[str]) -> None:
        """Bring the laws of contact of specimens up to date."""
        blocks = [name for name, each in self.graph.campaign.specimens.items() if not each.is_assembly]
        self.follow([self.graph.calibrating(name)] for name in blocks if name in specimens)

    def assess(self, assessments: Mapping[str, Assessment]) -> None:
        """Bring assessments up to date one after the other, their histories in blocks on all processes."""
        for asked in assessments.items():
            self.follow([[self._assessing(*asked)]])

    def score(self, forecasts: Mapping[str, Known], outdated: Collection[str]) -> None:
        """
        Bring the scores of forecasts up to date, given the one that counts of each test; tests without one have none.
        """
        measured = [name for name in forecasts if name not in outdated and name not in self.failed["test"]]
        for name in self.graph.campaign.tests.keys() - measured:
            files.remove(self.graph.layout.stage(name, "forecast"))
        self.follow([self.graph.scoring(self.graph.campaign.tests[name], forecasts[name])] for name in measured)

    def stale(self, *, until: str = "compare") -> set[str]:
        """Ids of the tests that have a missing or outdated result up to a stage, and have not failed."""
        compared = {stage.subject for stage in self.stages if stage.stage == "compare"}
        unknown = self.included - compared - self.failed["test"].keys()
        return {name for name in unknown if self._is_late(self._results(name, until=until))}

    def stale_assessments(self) -> set[str]:
        """Names of the assessments whose result is missing or outdated."""
        asked = self.graph.campaign.assessments.items()
        return {name for name, each in asked if self._is_late([self._assessing(name, each)])}

    def _is_late(self, products: Sequence[Product]) -> bool:
        return self._chain(products).standing(self.graph.catalogue.attributes)[1] is not None

    def follow(self, chains: Iterable[Sequence[Product]]) -> None:
        """
        Bring chains of results, each of one subject, up to date as far as is asked for; nothing follows a failure.

        They do not depend on each other. Those with nothing to do end here. The others are worked on by workers; but
        results that several workers share in are made one after the other, when what is before them is there.
        """
        asked = map(self._asked_for, chains)
        parts = ([list(part) for _, part in groupby(chain, lambda each: each.where is None)] for chain in asked)
        for side_by_side in zip_longest(*parts, fillvalue=list[Product]()):
            standing = [part for part in side_by_side if part and not self._has_failed(part[0].result)]
            self._bring([part for part in standing if part[0].where is None], self.where)
            for part in standing:
                if part[0].where is not None:
                    self._bring([part], Where(workers=1))

    def _asked_for(self, chain: Sequence[Product]) -> list[Product]:
        last = RUN_STAGES.index(self.until)
        first = len(RUN_STAGES) if self.start_from is None else RUN_STAGES.index(self.start_from)
        return [replace(each, is_asked=each.result.order >= first) for each in chain if each.result.order <= last]

    def _has_failed(self, result: ResultId) -> bool:
        return result.subject in self.failed[result.of]

    def _bring(self, chains: Sequence[Sequence[Product]], where: Where) -> None:
        for done, runs in enumerate(self._ended(chains, where), 1):
            for stage in runs:
                self.stages.append(stage)
                if stage.action == "failed":
                    self.failed[stage.of][stage.subject] = stage.reason
                if stage.of == "test" and self.progress is not None:
                    self.progress(stage, done, len(chains))

    def _ended(self, chains: Sequence[Sequence[Product]], where: Where) -> Iterator[list[StageRun]]:
        waiting = []
        for chain in map(self._chain, chains):
            expect_none()
            runs, late = chain.standing(self.graph.catalogue.attributes)
            if late is None:
                yield runs
            else:
                waiting.append(chain)
        yield from (runs for _, runs in spread(bring_up_to_date, waiting, where, lost=worker_lost))

    def _chain(self, products: Sequence[Product]) -> Chain:
        return Chain(products, self.graph.layout, Origin.of(self.graph.campaign), self.run_id)

    @property
    def included(self) -> set[str]:
        """Ids of the tests that are run: not excluded, and not planned and still without a raw file."""
        return {name for name in self.graph.campaign.tests if not self.graph.campaign.left_out(name)}

    def _results(self, name: str, since: str = "ingest", until: str = "compare") -> list[Product]:
        """Return the results of a test from one stage to another; gathering what they read of the campaign is slow."""
        if name not in self._known:
            where = self.where._replace(progress=partial(self._tell_members, name))
            self._known[name] = self.graph.of_test(self.graph.campaign.tests[name], where)
        first, last = RUN_STAGES.index(since), RUN_STAGES.index(until)
        return [product for product in self._known[name] if first <= product.result.order <= last]

    def _tell_members(self, name: str, done: int, total: int) -> None:
        if self.progress is not None:
            self.progress(StageRun(name, "ensemble", "done"), done, total)

    def _free_vibrations(self, specimens: Collection[str]) -> list[str]:
        free = (test for test in self.graph.campaign.tests.values() if test.kind == "free-vibration")
        return [test.id for test in free if test.specimen in specimens and not self.graph.campaign.left_out(test.id)]

    def _assessing(self, name: str, asked: Assessment) -> Product:
        from colonnade.workflow.assessing import assessing

        return assessing(self.graph, name, asked, self.where)


@contextmanager
def walking(campaign: Campaign, layout: Layout, where: Where = HERE, *, verify: bool = False) -> Iterator[Walk]:
    """
    Hold a campaign's lock, walk over it, and keep what was looked at: the next walk need not look again.

    Parameters
    ----------
    campaign : Campaign
    layout : Layout
    where : Where, optional
    verify : bool, optional
        See `Catalogue`.

    Raises
    ------
    StoreError
        As `only_run`.
    """
    with only_run(layout) as run_id:
        walk = Walk(Graph(campaign, layout, Catalogue(layout, verify=verify)), run_id, where=where)
        try:
            yield walk
        finally:
            with suppress(StoreError):  # without it the next walk takes longer, no more
                walk.graph.catalogue.save()
