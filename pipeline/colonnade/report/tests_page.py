"""The page of one test: what was done, what was found, what each model says, and how the channels were treated."""

from __future__ import annotations

import re
from dataclasses import dataclass
from math import isnan, nan
from pathlib import PurePosixPath

from colonnade.campaign import Campaign
from colonnade.campaign.summary import PredictionSummary
from colonnade.dynamics.block import Block
from colonnade.dynamics.similitude import at_prototype
from colonnade.figures.output import Picture
from colonnade.figures.restitution.estimators import EstimateGroup
from colonnade.figures.stored import record
from colonnade.figures.stored import restitution as pictures
from colonnade.identification.response.rank import FEWEST, is_within
from colonnade.report import channels, restitution
from colonnade.report.channels import ChannelRow
from colonnade.report.restitution import EstimateText
from colonnade.report.rows import TestRow
from colonnade.store.records.stored import Stored
from colonnade.store.records.test import driven_by, largest_motion
from colonnade.store.records.wording import NOTHING, acceleration, number, order, quantity

Fact = tuple[str, str]


@dataclass(frozen=True)
class TestPage:
    """
    What the page of a test shows besides the test's row.

    `verdicts` are sentences, whether the measured angle is within each model's spread; `peaks` are time, angle,
    standard error, fitted angle and whether it was used; `pictures` are None if there is nothing to draw.
    """

    __test__ = False  # pytest takes a class of this name for a test

    row: TestRow
    stored: Stored
    done: list[Fact]
    found: list[Fact]
    verdicts: list[str]
    restitution: list[Fact]
    estimates: list[EstimateText]
    departures: list[str]
    peaks: list[tuple[float, ...]]
    channels: tuple[ChannelRow, ...]
    notes: list[str]
    review: list[str]
    pictures: dict[str, Picture | None]


def of_test(campaign: Campaign, row: TestRow, stored: Stored) -> TestPage:
    """Put all that is stored of a test into words and figures."""
    test, block = row.test, campaign.block(row.test.specimen)
    peaks = ("peak_time", "peak_angle", "peak_angle_standard_error", "fitted_angle", "peak_used")
    verdicts = (verdict_sentence(model, predicted) for model, predicted in row.record.predicted.items())
    return TestPage(
        row=row,
        stored=stored,
        done=_known(_done(row)),
        found=_known(_found(row, stored, campaign.specimens[test.specimen].scale)),
        verdicts=list(filter(None, verdicts)),
        restitution=restitution.facts_of(stored, row.record.restitution),
        estimates=restitution.estimates_of(stored),
        departures=stored.texts(pictures.STAGE, "departures"),
        peaks=list(zip(*(stored.array(pictures.STAGE, name).tolist() for name in peaks), strict=True)),
        channels=channels.of_test(stored),
        notes=_notes(stored),
        review=stored.texts("ingest", "review") or list(campaign.review(test.id).sentences),
        pictures=_pictures(row, stored, block),
    )


def _pictures(row: TestRow, stored: Stored, block: Block) -> dict[str, Picture | None]:
    test, name = row.test, row.id
    peaks, impacts = pictures.peak_series(test, stored, block), pictures.impact_series(test, stored)
    estimates = [EstimateGroup("", pictures.estimate_rows(stored))]
    level = pictures.level_of(stored, pictures.STAGE, "e identified")
    return {
        "record": record.record(test, row.record, stored, block),
        "bands": record.bands(test, stored, block),
        "fitted": pictures.fitted(test, stored, block),
        "estimators": pictures.estimators(f"estimators-{name}", estimates, block.restitution),
        "peaks": pictures.peaks(f"peaks-{name}", [peaks] if peaks else [], block),
        "impacts": pictures.impacts(f"impacts-{name}", [impacts] if impacts else [], level, block.restitution),
        "region": pictures.region(test, stored),
    }


def _notes(stored: Stored) -> list[str]:
    """Split the notes on the files, each of which begins with the name of its file; a note may hold a semicolon."""
    names = "|".join(re.escape(PurePosixPath(path).name) for path in stored.raw_files)
    return list(filter(None, re.split(f"; (?=(?:{names}): )", stored.text("ingest", "notes"))))


def _done(row: TestRow) -> list[Fact]:
    test = row.test
    return [
        ("setup", test.setup),
        ("motion", test.motion or ""),
        ("Span", "" if test.span is None else str(test.span)),
        ("time scale", number(test.time_scale)),
        ("frequency", quantity(test.frequency, "Hz")),
        ("Ω = ω/p", number(row.record.frequency_ratio, 4)),
        ("A = a/(g tan α)", number(row.record.amplitude_ratio, 4)),
        ("part of the file", _interval(test.window) or "all"),
        ("zero from", _interval(test.zero) if isinstance(test.zero, tuple) else test.zero),
        ("notes", test.notes or ""),
    ]


def _found(row: TestRow, stored: Stored, scale: float | None) -> list[Fact]:
    is_free = row.test.kind == "free-vibration"
    error = quantity(stored.median("rocking", "rocking_angle_standard_error"), "mrad", 2)
    return [
        (
            "largest |θ|, release included" if is_free else "largest |θ|",
            quantity(abs(stored.value("rocking", "peak_angle")), "mrad", 4),
        ),
        ("released at |θ|/α", number(row.record.release_ratio)),
        ("predictions use", driven_by(stored) if is_free else ""),
        ("overturned at", quantity(stored.value("rocking", "overturning_time"), "s", 4)),
        ("peak base acceleration", acceleration(row.record.pga)),
        ("standard error of θ", error),
        *_other_motions(stored),
        ("noise threshold", quantity(stored.value("rocking", "noise_threshold"), "mrad", 2)),
        ("measured", stored.text("rocking", "separation")),
        ("order of the response", order(row.record.order) or row.record.order_reason or ""),
        (f"at prototype scale, 1:{scale:g}" if scale else "", _at_prototype(row, stored, scale) if scale else ""),
    ]


def _known(facts: list[Fact]) -> list[Fact]:
    return [(label, text) for label, text in facts if text not in ("", NOTHING)]


def verdict_sentence(model: str, predicted: PredictionSummary) -> str:
    """Say whether the measured angle is within the model's own spread, up to its horizon."""
    if predicted.horizon is None:
        return ""
    name, until = f"{model.capitalize()} model", quantity(predicted.horizon, "s", 4)
    rank = predicted.within_spread
    within = is_within(nan if rank is None else rank)
    if within is None:
        return f"{name}: predicted up to {until}; not ranked: that needs {FEWEST} runs and a measured angle."
    said = [f"{rank:.0%} of the runs are closer to their median"]
    if predicted.peak_rank is not None:
        said.append(f"{predicted.peak_rank:.0%} stay below the measured peak")
    if predicted.overturning_probability:
        said.append(f"{predicted.overturning_probability:.0%} overturn")
    where = "within" if within else "outside"
    return f"{name}: the measured angle is {where} its own spread up to {until} ({'; '.join(said)})."


def _interval(given: tuple[float, float] | None) -> str:
    return f"{given[0]:g} s to {given[1]:g} s" if given is not None else ""


def _other_motions(stored: Stored) -> list[Fact]:
    """Give the largest of each motion besides the rocking angle, with its standard error."""
    facts = []
    for name, words, _, unit in record.MOTIONS:
        largest = largest_motion(stored, name)
        if not isnan(largest):
            error = quantity(stored.median("rocking", f"{name}_standard_error"), unit, 2)
            facts.append((f"largest {words}", f"{quantity(largest, unit, 3)}, standard error {error}"))
    return facts


def _at_prototype(row: TestRow, stored: Stored, scale: float) -> str:
    """Say what the test means for the specimen that the model stands for."""
    if row.record.prototype is None:
        return ""
    base = at_prototype("length", largest_motion(stored, "base_displacement"), scale)
    parts = (
        ("duration", row.record.prototype.duration, "s"),
        ("frequency", row.record.prototype.frequency, "Hz"),
        ("largest slide", row.record.prototype.peak_slide, "mm"),
        ("largest base displacement", base, "mm"),
    )
    known = ((name, quantity(value, unit)) for name, value, unit in parts)
    return ", ".join(f"{name} {text}" for name, text in known if text != NOTHING)
