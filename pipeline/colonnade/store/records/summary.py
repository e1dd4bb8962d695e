"""The summary of the last run, read back, and values gathered from the records of its tests."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, cast, get_args

from colonnade.campaign import Campaign
from colonnade.campaign.forms.summary import Summary, TestSummary
from colonnade.dynamics.history import Outcome
from colonnade.errors import StoreError
from colonnade.identification.response.boundaries import MapPoint
from colonnade.store.layout import Layout
from colonnade.store.records.test import as_given


def read_summary(layout: Layout) -> Summary | None:
    """
    Read the summary of the last run.

    Returns
    -------
    summary : Summary or None
        None if there was no run.

    Raises
    ------
    StoreError
        If the file was altered or damaged.
    """
    try:
        return Summary.model_validate_json(layout.summary_json.read_text(encoding="utf-8"))
    except FileNotFoundError:
        return None
    except (OSError, ValueError, RecursionError):
        raise StoreError(
            f"{layout.summary_json}: it was altered or damaged. Run `colonnade run` to make it again."
        ) from None


def records_of_tests(campaign: Campaign, summary: Summary | None) -> dict[str, TestSummary]:
    """Return the record of each test of a campaign; one that was never run is pending."""
    known = {} if summary is None else summary.tests
    return {
        name: known.get(name) or TestSummary(status="pending", **as_given(test))
        for name, test in campaign.tests.items()
    }


def records_of_specimens(campaign: Campaign, summary: Summary | None) -> dict[str, dict[str, Any]]:
    """Return each specimen as in the summary, with shape, mass and rigid-body e; before a run its e is not known."""
    records = {}
    for name, specimen in campaign.specimens.items():
        block = campaign.block(name)
        unknown = {"value": None, "low": None, "high": None, "level": None, "source": None, "reason": "not run yet"}
        records[name] = {
            "shape": specimen.shape,
            "mass": specimen.mass,
            "rigid_restitution": block.restitution,
            "critical_angle": block.critical_angle,
            "pole_distance": block.pole_distance,
            "inertia": block.inertia,
            "p": block.p,
            "restitution": unknown,
        }
        if summary is not None and name in summary.specimens:
            records[name] |= summary.specimens[name].model_dump(mode="json")
    return records


def map_points(tests: Mapping[str, TestSummary], specimen: str) -> list[MapPoint]:
    """Return the sine tests of a specimen whose Ω, A and outcome, measured or observed, are known."""
    points = []
    for name, test in tests.items():
        outcome, ratios = test.outcome or test.observed_outcome, (test.frequency_ratio, test.amplitude_ratio)
        if test.specimen == specimen and None not in ratios and outcome in get_args(Outcome):
            points.append(MapPoint(name, *cast(tuple[float, float], ratios), cast(Outcome, outcome), test.order))
    return points
