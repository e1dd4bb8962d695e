"""An assessment before its histories are run: the real column, the records at their levels, and what is varied."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from math import inf
from pathlib import Path

import numpy as np
import scipy

from colonnade.arrays import Dataset
from colonnade.assessment.cases import OnContact
from colonnade.assessment.ground import NONE
from colonnade.assessment.hazard import Hazard
from colonnade.assessment.outcomes import FEWEST
from colonnade.assessment.real_column import RealColumn
from colonnade.assessment.study import Study, plan_study
from colonnade.campaign import Campaign
from colonnade.campaign import assessment as written
from colonnade.campaign.assembly import Whole
from colonnade.campaign.assessment import Assessment
from colonnade.campaign.forms.assessed import UNCORRECTED
from colonnade.campaign.settings import ContactSettings, PlaneEnsembleSettings
from colonnade.dynamics.assembly import Assembly, Placed
from colonnade.dynamics.block import Block, Side, Sided, pair
from colonnade.dynamics.uncertainty import member_block
from colonnade.errors import StageError, count
from colonnade.readers.record_set import RecordSet
from colonnade.stages.contact import assembly_law
from colonnade.stages.specimen import restitution_spread
from colonnade.store.provenance import Inputs

USUAL_MARGIN = 0.02
"""To either side of e, if neither limits nor free vibrations are known."""


class ColumnInputs(Inputs):
    """What is read of the campaign about a real column: its model, how many times larger it is, what is assumed.

    `usual_scatter` is the standard deviation of e between tests, if a single one does not show it.
    """

    block: Block
    scale: float
    prototype: written.Prototype
    usual_scatter: float = PlaneEnsembleSettings().restitution


def real_column(inputs: ColumnInputs, pooled: Dataset) -> tuple[RealColumn, str]:
    """
    Put together the real column.

    Parameters
    ----------
    inputs : ColumnInputs
    pooled : Dataset
        Result of `specimen`: the e of the model.

    Returns
    -------
    column : RealColumn
    source : str
        Of its e: "given", "identified" or "rigid-body".
    """
    given = inputs.prototype
    block = _enlarged(inputs.block, inputs.scale)
    angle, p = given.critical_angle or block.critical_angle, given.p or block.p
    block = member_block(block, angle / block.critical_angle, p / block.p)
    restitution, limits, source = _restitution(inputs, block, pooled)
    column = RealColumn(
        block,
        restitution,
        given.friction,
        given.restitution_range or limits,
        given.critical_angle_range,
        given.p_range,
        given.friction_range,
    )
    return column, source


def _enlarged(block: Block, scale: float) -> Block:
    """Enlarge a model of the same material; angles stay, lengths, mass and inertia grow."""
    inertia = scale**5
    negative, positive = (
        Side(each.critical_angle, scale * each.pole_distance, inertia * each.inertia) for each in block.sides
    )
    solid = block.solid and replace(
        block.solid,
        half_depth=scale * block.solid.half_depth,
        height=scale * block.solid.height,
        top=(scale * block.solid.top[0], scale * block.solid.top[1]),
        inertia_x=inertia * block.solid.inertia_x,
        inertia_z=inertia * block.solid.inertia_z,
    )
    mass = scale**3 * block.mass
    return replace(block, mass=mass, negative=negative, positive=positive, solid=solid)


def _restitution(inputs: ColumnInputs, block: Block, pooled: Dataset) -> tuple[Sided, tuple[float, float], str]:
    """Return e, its limits if none are given (an identified one is that of a new test), and where it comes from."""
    given = inputs.prototype
    if given.restitution != "identified":
        rigid = given.restitution == "rigid-body"
        e = block.restitution if rigid else float(given.restitution)
        return e, _around(e), "rigid-body" if rigid else "given"
    negative, positive = (float(each) for each in pooled["side_restitution"])
    e = float(np.mean((negative, positive)))
    source = str(pooled.attrs["restitution_source"])
    margin = USUAL_MARGIN
    if source == "identified":
        deviation, freedom = restitution_spread(pooled, inputs.usual_scatter)
        margin = deviation * float(scipy.special.stdtrit(freedom or np.inf, (1 + float(pooled["level"])) / 2))
    return (e if negative == positive else (negative, positive)), _around(e, margin), source


def _around(e: float, margin: float = USUAL_MARGIN) -> tuple[float, float]:
    return max(e - margin, 0.0), min(e + margin, 1.0)


ASSUMED = "as assumed"
"""The columns and records of the answer."""


class AssessmentInputs(ColumnInputs):
    """
    What an assessment reads of the campaign.

    `several` are bodies that do not rock as one block, as tested, and `contact` is theirs.
    """

    specimen: str
    asked: Assessment
    several: Assembly | None = None
    contact: ContactSettings | None = None

    def on_contact(self) -> OnContact | None:
        """Return the real bodies if there are several; one that ends too far from its place has overturned."""
        if self.several is None or self.contact is None:
            return None
        scale, displaced = self.scale, self.asked.displaced
        bodies = {
            name: Placed(_enlarged(body.block, scale), body.on, (scale * body.position[0], scale * body.position[1]))
            for name, body in self.several.bodies.items()
        }
        return OnContact(Assembly(bodies), assembly_law(self.contact), inf if displaced is None else displaced)

    @classmethod
    def of(cls, campaign: Campaign, asked: Assessment) -> AssessmentInputs:
        """Gather what an assessment reads; of its files the names: their content enters the key by itself."""
        specimen, predict, several = campaign.specimens[asked.specimen], campaign.processing.predict, None
        if isinstance(specimen, Whole) and not specimen.is_in_plane:
            several = specimen.assembly(campaign.gravity)
            friction, share = predict.contact.friction, predict.ensemble.contact.friction
            limits = friction * (1.0 - share), friction * (1.0 + share)
            prototype = written.Prototype.model_construct(
                restitution="rigid-body", friction=friction, friction_range=limits
            )
        else:
            prototype = campaign.prototype[asked.specimen]
        return cls(
            block=specimen.block(campaign.gravity),
            scale=asked.scale or specimen.scale or 1.0,
            prototype=prototype,
            several=several,
            contact=None if several is None else predict.contact,
            specimen=asked.specimen,
            asked=asked.model_copy(
                update={"records": Path(asked.records.name), "hazard": asked.hazard and Path(asked.hazard.name)}
            ),
        )


@dataclass(frozen=True)
class Plan:
    """
    An assessment before its histories are run.

    Attributes
    ----------
    inputs : AssessmentInputs
    records : RecordSet
    hazard : Hazard or None
    restitution_source : str
    studies : dict of str to Study
        `ASSUMED`, and what is compared with it.
    without_correction : str
        Why there is no study of the records without the correction that was asked for; empty if there is one, or no
        correction.
    """

    inputs: AssessmentInputs
    records: RecordSet
    hazard: Hazard | None
    restitution_source: str
    studies: dict[str, Study]
    without_correction: str = ""


def plan_assessment(pooled: Dataset, records: RecordSet, hazard: Hazard | None, inputs: AssessmentInputs) -> Plan:
    """
    Plan an assessment.

    Parameters
    ----------
    pooled : Dataset
        Result of `specimen`.
    records : RecordSet
    hazard : Hazard or None
        Of the measure that is asked for.
    inputs : AssessmentInputs

    Raises
    ------
    StageError
        If there are too few records for an answer.
    """
    try:
        column, source = real_column(inputs, pooled)
    except ValueError as error:
        raise StageError(f"The real column cannot be: {error}") from error
    asked = inputs.asked
    _expect_enough([each.name for each in records.records], "that can be used", records.left_out)
    motions = {each.name: each.motion for each in records.records}

    def planned(baseline: str) -> Study:
        return plan_study(
            column,
            motions,
            measure=asked.measure,
            levels=asked.levels_in_si(),
            measures=asked.measures,
            draws=asked.draws,
            model=asked.model,
            drift=asked.drift,
            baseline=baseline,
            seed=asked.seed,
            several=inputs.on_contact(),
        )

    try:
        study = planned(asked.baseline)
    except ValueError as error:
        raise StageError(str(error)) from error
    drifting = asked.baseline if study.left_out else ""
    _expect_enough(study.names, f"with a {study.measure.name}", {**study.left_out, **records.left_out}, drifting)
    # The contact model has no e to vary, and takes minutes for each history.
    variants = _variants(column) if inputs.several is None else {}
    studies = {ASSUMED: study} | {name: study.of(other) for name, other in variants.items()}
    why = ""
    if asked.baseline != NONE and inputs.several is None:
        # Records that are corrected because they drift may have no answer as they are.
        try:
            plain = planned(NONE)
            _expect_enough(plain.names, f"with a {plain.measure.name}", plain.left_out)
            studies[UNCORRECTED] = plain.of(column)
        except (ValueError, StageError) as error:
            why = str(error)
    return Plan(inputs, records, hazard, source, studies, why)


NAMED = 3
"""Records that are left out and named where there are too few."""


def _expect_enough(names: Sequence[str], what: str, left_out: Mapping[str, str], baseline: str = "") -> None:
    if len(names) >= FEWEST:
        return
    reasons = "; ".join(f"{name}: {reason.rstrip('.')}" for name, reason in list(left_out.items())[:NAMED])
    advice = ' A drift is taken off by baseline = "linear" (--baseline linear).' if baseline == NONE else ""
    raise StageError(
        f"{count(len(names), 'ground motion')} {what}; at least {FEWEST} were expected."
        + (f" Left out: {reasons}." if reasons else "")
        + advice
    )


def _variants(column: RealColumn) -> dict[str, RealColumn]:
    """Give the column as assumed, with the e of a rigid body, and with a smaller and a larger e."""
    e = np.array(pair(column.restitution))
    changed = {
        "nothing varied": e,
        "the e of a rigid body": np.full(2, column.block.restitution),
        f"an e smaller by {USUAL_MARGIN:g}": np.maximum(e - USUAL_MARGIN, 0.0),
        f"an e larger by {USUAL_MARGIN:g}": np.minimum(e + USUAL_MARGIN, 1.0),
    }
    return {name: replace(column, restitution=(float(both[0]), float(both[1]))) for name, both in changed.items()}
