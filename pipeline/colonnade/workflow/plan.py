"""From a campaign to the steps that its tests and specimens need."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from colonnade.campaign import Campaign
from colonnade.store.layout import Layout
from colonnade.workflow.chain import Chain, Step
from colonnade.workflow.freshness import source_hash
from colonnade.workflow.rawfiles import RawIndex
from colonnade.workflow.selection import Selection
from colonnade.workflow.table import Stage, Table


@dataclass(frozen=True)
class Plan:
    """
    What there is to do for a campaign.

    Attributes
    ----------
    campaign : Campaign
    table : Table
        The stages.
    layout : Layout
    index : RawIndex
    selection : Selection or None
        Stages that are asked for and redone; None for all, none of them redone.
    verify : bool
        Hold stored values against their hashes.
    """

    campaign: Campaign
    table: Table
    layout: Layout
    index: RawIndex
    selection: Selection | None = None
    verify: bool = False

    @property
    def of_all(self) -> Plan:
        """The same with every stage of the table, for looking at what is there."""
        return replace(self, selection=None, verify=False)

    def measured(self, test_id: str) -> Chain:
        """Steps of a test up to its restitution."""
        return Chain(tuple(self._steps(test_id, self.table.measured)), self.verify)

    def predicted(self, test_id: str) -> Chain:
        """Steps of a test after that."""
        return Chain(tuple(self._steps(test_id, self.table.predicted)), self.verify)

    def pooled(self, specimen: str, tests: Collection[str]) -> Chain:
        """Step of a specimen, from the restitution of these tests."""
        stage = self.table.pooled
        step = Step(
            subject=specimen,
            stage=stage.name,
            model=None,
            path=self.layout.specimen(specimen),
            work=stage.work,
            instructions=stage.instructions(self.campaign, specimen),
            described=self._described(stage, specimen=specimen),
            code=source_hash(),
            error_log=self.layout.specimen_error_log(specimen),
            inputs={test: self.layout.stage(test, "restitution") for test in tests},
            redo=self.selection is not None and self.selection.redoes("restitution"),
        )
        return Chain((step,), self.verify)

    def _steps(self, test_id: str, stages: tuple[Stage, ...]) -> Iterator[Step]:
        test = self.campaign.tests[test_id]
        recorders = self.campaign.setups[test.setup].recorders
        for stage in stages:
            if not stage.applies(test) or not (self.selection is None or self.selection.includes(stage.name)):
                continue
            for model in self.campaign.processing.predict.models if stage.each_model else (None,):
                yield Step(
                    subject=test_id,
                    stage=stage.name,
                    model=model,
                    path=self.layout.stage(test_id, stage.name, model),
                    work=stage.work,
                    instructions=stage.instructions(self.campaign, test, *([model] if model else [])),
                    described=self._described(stage, test=test_id),
                    code=source_hash(),
                    error_log=self.layout.error_log(test_id),
                    inputs=self._inputs(test_id, stage),
                    raw={} if stage.upstream else {name: self.index.look(path) for name, path in test.files.items()},
                    formats={name: recorder.file for name, recorder in recorders.items()},
                    redo=self.selection is not None and self.selection.redoes(stage.name),
                )

    def _inputs(self, test_id: str, stage: Stage) -> dict[str, Path]:
        inputs = {}
        rows = {row.name: row for row in self.table.of_tests}
        for name in stage.upstream:
            if name == self.table.pooled.name:
                inputs[name] = self.layout.specimen(self.campaign.tests[test_id].specimen)
            elif rows[name].each_model:
                for model in self.campaign.processing.predict.models:
                    inputs[f"{name} {model}"] = self.layout.stage(test_id, name, model)
            else:
                inputs[name] = self.layout.stage(test_id, name)
        return inputs

    def _described(self, stage: Stage, **subject: str) -> dict[str, Any]:
        campaign = self.campaign
        return {
            "campaign": campaign.campaign,
            "title": campaign.title,
            "facility": campaign.facility,
            "stage": stage.name,
            **subject,
        }
