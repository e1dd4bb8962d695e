"""What is known of a campaign: its file, and the summary of its last run."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from colonnade.campaign import Campaign

Record = dict[str, Any]


@dataclass(frozen=True)
class KnownCampaign:
    """A campaign and the summary of its last run, empty where it was never run."""

    campaign: Campaign
    summary: Record

    @classmethod
    def of(cls, path: Path, results: Path | None = None) -> KnownCampaign:
        """Read both, the summary in the folder of results where one is given; nothing is run."""
        from colonnade.campaign import load
        from colonnade.campaign.summary import Summary
        from colonnade.errors import StoreError
        from colonnade.store.layout import Layout

        campaign = load(path)
        written = Layout.of(campaign.folder, results).summary_json
        if not written.is_file():
            return cls(campaign, {})
        try:
            text = written.read_text(encoding="utf-8")
            Summary.model_validate_json(text)
            return cls(campaign, json.loads(text))
        except (OSError, ValueError, RecursionError):
            raise StoreError(f"{written}: it was altered or damaged. `colonnade run` makes it again.") from None


NEVER_RUN: Record = {
    "status": "pending",
    "reason": None,
    "warnings": [],
    "outcome": None,
    "observed_outcome": None,
    "peak_ratio": None,
    "predicted": {},
}


def test_records(known: KnownCampaign) -> dict[str, Record]:
    """Each test as in summary.json; as pending where it has not been run."""
    summarised = known.summary.get("tests", {})
    return {
        name: {"kind": test.kind, "specimen": test.specimen, "span": test.span}
        | NEVER_RUN
        | {"observed_outcome": test.observed_outcome}
        | summarised.get(name, {})
        for name, test in known.campaign.tests.items()
    }


def specimen_records(known: KnownCampaign) -> dict[str, Record]:
    """Each specimen as in summary.json, with shape, mass and rigid-body restitution beside it."""
    summarised = known.summary.get("specimens", {})
    records = {}
    for name, specimen in known.campaign.specimens.items():
        block = known.campaign.block(name)
        unknown = {"value": None, "low": None, "high": None, "source": None, "reason": "not run yet"}
        records[name] = {
            "shape": specimen.shape,
            "mass": specimen.mass,
            "rigid_restitution": block.restitution,
            "critical_angle": block.critical_angle,
            "pole_distance": block.pole_distance,
            "inertia": block.inertia,
            "p": block.p,
            "restitution": unknown,
        } | summarised.get(name, {})
    return records
