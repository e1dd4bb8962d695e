"""The histories of an assessment, spread over processes or a cluster in blocks that outlive an interruption."""

from __future__ import annotations

from pathlib import Path

from colonnade.assessment.cases import Cases, Outcomes, gather, run_part
from colonnade.dynamics.motion import Motion
from colonnade.store.provenance import hash_of
from colonnade.workflow.execution.blocks import Spread, blocks_of


def outcomes_of(cases: Cases, spread: Spread, folder: Path, key: str) -> Outcomes:
    """
    Run all cases of an assessment.

    Parameters
    ----------
    cases : Cases
    spread : Spread
        `in_blocks` with its workers or scheduler, and its progress.
    folder : Path
        Where finished blocks are kept, see `in_blocks`; the caller removes it (`forget`) once the result is stored.
    key : str
        Hash of all that the result depends on: of a recipe whose upstream holds `given` of these cases.

    Returns
    -------
    outcomes : Outcomes
        The same to the last bit, whatever the processes and interruptions.
    """
    return gather(cases, spread(run_part, [cases.part(block) for block in blocks_of(cases.count)], folder, key))


def given(cases: Cases) -> dict[str, str | None]:
    """Hash what the outcomes are made from: column, draws, motions, factors and model."""
    column = [repr(cases.prototype), [each.values.tolist() for each in cases.draws], cases.model]
    motions = [_hash(motion) for motion in cases.motions]
    return {"column": hash_of(column), "motions": hash_of(motions), "factors": hash_of(cases.factors.tolist())}


def _hash(motion: Motion) -> str:
    parts = (motion.acceleration, motion.vertical, motion.transverse)
    return hash_of([motion.dt, *(None if part is None else part.tolist() for part in parts)])
