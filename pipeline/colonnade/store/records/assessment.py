"""The answer of an assessment in words."""

from __future__ import annotations

from colonnade.assessment.measures import measure_of
from colonnade.campaign.forms.assessed import UNCORRECTED, AssessmentSummary, Estimate, Variant
from colonnade.units.text import NOTHING, PERCENT, number, percent, quantity, with_minus

ONE_BLOCK = "columns of several drums, a plinth or a capital that moves by itself, "
NOT_COVERED = (
    "anchorage, rocking in two directions at once, and whether the records are those that the site has to expect."
)

SOURCES = {
    "given": "as given",
    "identified": "identified on the model and assumed for the column",
    "rigid-body": "that of a rigid body",
}
"""Where e comes from."""


def unit_of(measure: str) -> str:
    """
    Give the unit in which a measure is written.

    Examples
    --------
    >>> unit_of("pga"), unit_of("pgv")
    ('g', 'm/s')
    """
    found = measure_of(measure)
    return "g" if found.dimension == "acceleration" else found.unit


def level(measure: str, value: float | None) -> str:
    """
    Write a value of a measure.

    Examples
    --------
    >>> level("pga", 1.8501), level("pgv", 0.69754), level("pgv", None)
    ('0.189 g', '0.698 m/s', '–')
    """
    return quantity(value, unit_of(measure))


def estimated(measure: str, estimate: Estimate) -> str:
    """
    Write a value of a measure with its interval.

    Examples
    --------
    >>> estimated("pgv", Estimate(value=1.15, low=0.92, high=1.34))
    '1.15 m/s (0.92 to 1.34)'
    >>> estimated("pgv", Estimate(value=1.15))
    '1.15 m/s (no interval)'
    >>> estimated("pgv", Estimate(beyond="below"))
    'below the levels'
    """
    if estimate.value is None:
        return NOTHING if estimate.beyond is None else f"{estimate.beyond} the levels"
    ends = (estimate.low, estimate.high)
    if None in ends:
        said = [f"{word} {level(measure, end)}" for word, end in zip(("above", "below"), ends, strict=True) if end]
        return f"{level(measure, estimate.value)} ({said[0] if said else 'no interval'})"
    low, high = (level(measure, end).partition(" ")[0] for end in ends)
    return f"{level(measure, estimate.value)} ({low} to {high})"


def sentences(record: AssessmentSummary) -> list[str]:
    """Say the answer of an assessment: a sentence on each thing that was asked."""
    if record.status == "failed":
        return [f"There is no answer: {record.reason}"]
    found = [*_rate(record), _overturns(record)]
    if record.curve_reason:
        found.append(f"This is read from a curve that only rises, not from a lognormal one: {record.curve_reason}.")
    found += [
        _rocks(record),
        *_restitution_matters(record),
        *_correction_matters(record),
        *_parts(record),
        *_resurrected(record),
        _assumed(record),
        f"Not covered: {'' if _has_several(record) else ONE_BLOCK}{NOT_COVERED}",
    ]
    return found


def deciding(record: AssessmentSummary) -> str:
    """Name the records without which the answer changes most; empty if there are none."""
    without = [f"{each.record} (median without it {level(record.measure, each.median)})" for each in record.deciding]
    return f"The records that change the answer most: {', '.join(without)}." if without else ""


def _has_several(record: AssessmentSummary) -> bool:
    """Whether it is about bodies that do not rock as one block, and so have no e."""
    return record.restitution.value is None


def _rocks(record: AssessmentSummary) -> str:
    vertical = any("z" in used.components for used in record.records_used)
    without = ", without vertical motion" if vertical else ""
    said = f"It starts to rock at {quantity(record.uplift_acceleration, 'g')} of horizontal acceleration{without}"
    if record.uplift.value is None:
        return f"{said}."
    symbol = measure_of(record.measure).symbol
    return f"{said}, on half of the records at {symbol} {estimated(record.measure, record.uplift)}."


def _overturns(record: AssessmentSummary) -> str:
    symbol = measure_of(record.measure).symbol
    said = []
    for share, estimate in ((5, record.five_percent), (50, record.fifty_percent)):
        if estimate.value is not None:
            said.append(f"{share}{PERCENT} at {symbol} {estimated(record.measure, estimate)}")
        elif estimate.beyond == "below":
            said.append(f"{share}{PERCENT} already below the lowest level")
        else:
            said.append(f"{share}{PERCENT} nowhere within the levels")
    interval = any(each.low or each.high for each in (record.five_percent, record.fifty_percent))
    brackets = f" In brackets: 95{PERCENT} over the records." if interval else ""
    overturns = "A body falls" if _has_several(record) else "It overturns"
    if record.displaced is not None:
        overturns += f", or ends more than {quantity(record.displaced, 'mm')} from its place,"
    return f"{overturns} with a probability of {', and of '.join(said)}.{brackets}"


def _restitution_matters(record: AssessmentSummary) -> list[str]:
    known = [each for each in record.variants if each.median.value is not None and each.name != UNCORRECTED]
    if len(known) < 2:
        return []
    first, *others = known
    said = ", ".join(f"with {each.name} ({number(each.restitution)}) {_median(record, each)}" for each in others)
    own = f"{_median(record, first)} with {first.name} (e {number(first.restitution)})"
    return [f"By lognormal curves half of the histories overturn it at {own}, {said}."]


def _correction_matters(record: AssessmentSummary) -> list[str]:
    """Give the answer both ways, with nothing varied."""
    by_name = {each.name: each for each in record.variants}
    if record.baseline == "none" or UNCORRECTED not in by_name:
        return []
    plain, own = by_name[UNCORRECTED], by_name.get("nothing varied")
    if plain.median.value is None:
        why = (plain.reason or "").rstrip(".")
        return [f"The records are corrected ({record.baseline}). As they are, they give no curve: {why}."]
    corrected = "" if own is None else f"; corrected, and with nothing varied either, {_median(record, own)}"
    count = f" of {plain.records} records" if plain.records else ""
    return [
        f"The records are corrected ({record.baseline}). As they are, half of the histories{count} overturn it at "
        f"{_median(record, plain)}{corrected}."
    ]


def _median(record: AssessmentSummary, variant: Variant) -> str:
    return level(record.measure, variant.median.value)


def _parts(record: AssessmentSummary) -> list[str]:
    records, parameters = record.dispersion_records, record.dispersion_parameters
    if record.dispersion.value is None or records is None or parameters is None:
        return []
    inputs = "frictions" if _has_several(record) else "e, α and p"
    more = f"records matter more than {inputs}" if records > parameters else f"{inputs} matter more than the records"
    return [
        f"β is {number(record.dispersion.value, 2)}. From record to record it is {number(records, 2)}, within a record "
        f"{number(parameters, 2)}: the {more}. They need not add up to β: a column that overturns at one level may "
        "stand at a higher one."
    ]


def _resurrected(record: AssessmentSummary) -> list[str]:
    if not record.resurrected:
        return []
    return [
        f"In {percent(record.resurrected)} of the histories it stands although it overturned on the same record at a "
        "lower level: stronger shaking is not always worse."
    ]


def _rate(record: AssessmentSummary) -> list[str]:
    if record.annual_rate.value is None:
        return []
    years = record.probability_50_years
    interval = "" if None in (years.low, years.high) else f" ({percent(years.low)} to {percent(years.high)})"
    return [
        f"Within 50 years it overturns with a probability of {percent(years.value)}{interval}: with the hazard given, "
        f"{with_minus(f'{record.annual_rate.value:.2g}')} times a year."
    ]


def _assumed(record: AssessmentSummary) -> str:
    e = record.restitution
    limits = None if e.low is None or e.high is None else (e.low, e.high)
    source = SOURCES[record.restitution_source or "given"]
    sliding = "sliding is not judged"
    friction = "" if record.friction is None else f"friction {_within(number(record.friction), record.friction_range)}"
    if friction:
        sliding = f"that it does not slide on {friction}"
    records = "as they are" if record.baseline == "none" else f"after a correction ({record.baseline})"
    if _has_several(record):
        return f"Assumed: {friction} in all joints, by the contact model. The records are scaled {records}."
    return (
        f"Assumed: α {_within(quantity(record.critical_angle, 'rad'), record.critical_angle_range)}, "
        f"p {_within(quantity(record.p, 'rad/s'), record.p_range)}, e {_within(number(e.value), limits, source)}; "
        f"{sliding}. The records are scaled {records}."
    )


def _within(text: str, limits: tuple[float, float] | None, source: str = "") -> str:
    """Add to a value where it comes from, and the limits between which it was drawn."""
    drawn = "" if limits is None else f"drawn between {number(limits[0])} and {number(limits[1])}"
    said = ", ".join(filter(None, (source, drawn)))
    return f"{text} ({said})" if said else text
