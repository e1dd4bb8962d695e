"""What is doubtful about the answer on a real column, and which ground motions it leaves out."""

from __future__ import annotations

from colonnade.assessment.cases import FALLS_AWAY, NOT_RUN, Outcomes
from colonnade.assessment.fragility import MISFITS, Fragility
from colonnade.campaign.assessing.assessed import RecordLeftOut
from colonnade.stages.assessing.plan import ASSUMED, Plan
from colonnade.units import format_percent, with_minus


def doubts(plan: Plan, outcomes: Outcomes, found: Fragility, sliding: float | None) -> list[str]:
    """Say what is doubtful, the gravest first; arguments as of `answer`, with the study as assumed."""
    said = [*_of_the_column(plan), *_of_the_histories(outcomes, sliding), *_of_the_records(plan, found)]
    return said + _of_the_rate(plan, found)


def left_out(plan: Plan) -> tuple[RecordLeftOut, ...]:
    """Name the files, records and components that are not used, with the reason."""
    named = [(each.name, each.reason.removeprefix(f"{each.name}: ")) for each in plan.records.left_out]
    return tuple(
        RecordLeftOut(record=name, reason=reason) for name, reason in (*named, *plan.studies[ASSUMED].left_out.items())
    )


def _of_the_column(plan: Plan) -> list[str]:
    column, said = plan.studies[ASSUMED].cases.prototype, []
    if plan.inputs.prototype.restitution == "identified" and plan.restitution_source == "rigid-body":
        said.append("No e is identified on the model. That of a rigid body is assumed.")
    rows = zip(("e", "α (rad)", "p (rad/s)"), column.central, column.ranges, strict=False)
    return said + [
        f"{name} is {value:.4g}, outside the limits {limits[0]:.4g} and {limits[1]:.4g} between which it is drawn."
        for name, value, limits in rows
        if limits is not None and not limits[0] <= value <= limits[1]
    ]


def _of_the_histories(outcomes: Outcomes, sliding: float | None) -> list[str]:
    said = []
    if sliding:
        said.append(
            f"In {format_percent(sliding)} of the histories the column would slide: it needs more friction than there "
            "is. There the answer does not hold."
        )
    if (falling := float((outcomes.outcome == FALLS_AWAY).sum() / (outcomes.outcome != NOT_RUN).sum())) > 0.0:
        said.append(
            f"{format_percent(falling)} of the histories are not run, and do not count: their base falls faster than "
            "the column. Their levels are too high."
        )
    return said


def _of_the_records(plan: Plan, found: Fragility) -> list[str]:
    said, missing = [], left_out(plan)
    if missing:
        first = missing[0]
        others = "" if len(missing) == 1 else f" and {len(missing) - 1} more"
        said.append(f"Left out: {first.record}{others}. {first.record}: {first.reason.splitlines()[0]}")
    return [*said, found.lognormal.no_interval] if found.lognormal.no_interval else said


def _of_the_rate(plan: Plan, found: Fragility) -> list[str]:
    rate, said = found.rate, []
    if rate is not None and rate.is_extrapolated:
        said.append(
            f"{format_percent(rate.below_hazard + rate.above_hazard)} of the annual rate is from outside the hazard "
            f"curve, and {format_percent(rate.below_levels + rate.above_levels)} from outside the levels."
        )
    if rate is not None and found.misfit.p_value < MISFITS:
        said.append(
            "The annual rate is by the lognormal curve, which does not fit. By the curve that only rises it is "
            f"{with_minus(f'{rate.isotonic:.2g}')} a year."
        )
    if plan.hazard is not None and rate is None:
        said.append("There is a hazard, and no annual rate: that needs a lognormal curve.")
    return said
