"""Write what the studies measured into docs/explanation/verification.md: `python reports/verification.py`."""

from __future__ import annotations

import json
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

from colonnade.units.text import format_percent
from fault_atlas import FAULTS
from faults.unseen import UNSEEN
from study import HERE, renewed, table

DOCUMENT = HERE.parent / "docs" / "explanation" / "verification.md"
MARKS = "<!-- measured: begin -->", "<!-- measured: end -->"

Found = Any
"""What a study's JSON file holds."""


class Row(NamedTuple):
    """A check with its figure, and what it does not show."""

    check: str
    figure: str
    limit: str


class Study(NamedTuple):
    """A study: its title, the name of its JSON file and page, what makes it, and its rows."""

    title: str
    name: str
    maker: str
    rows: Callable[[Found], list[Row]]


def _restitution(found: Found) -> list[Row]:
    kinds, tests = found["kinds"], found["new_test"]
    held = [row["coverage"] for row in kinds]
    content = [row["content"] for row in tests]
    return [
        Row(
            f"share of the 95 % intervals that hold the true e, {len(kinds)} kinds of {found['records']} records",
            f"{format_percent(min(held), 1)} to {format_percent(max(held), 1)}",
            "The truth is plane rocking of a rigid block: not a real contact.",
        ),
        Row(
            "median width over that of the best possible interval",
            f"{min(row['width'] for row in kinds):.2f} to {max(row['width'] for row in kinds):.2f}",
            "The errors of α, p and gain have the standard deviation that the estimator is told.",
        ),
        Row(
            "records with eight impacts refused, at most of a kind",
            format_percent(max(row["refused"] for row in kinds), 1),
            "A refusal of a good record costs a test, and is not counted as an error.",
        ),
        Row(
            "probability content of the 95 % range of e for a new test",
            f"{format_percent(min(content), 1)} to {format_percent(max(content), 1)}",
            "e of each test is normal about the specimen's mean.",
        ),
    ]


def _verdict(found: Found) -> list[Row]:
    whole = found["all"]
    return [
        Row(
            f"measured rank on {found['tests']} virtual tests, true model: within its spread",
            f"{format_percent(whole['within'], 1)} (nominal {format_percent(whole['nominal'], 1)})",
            "The uncertainties drawn are those that the model assumes. If yours are larger, more tests are outside.",
        ),
        Row(
            f"the same with e wrong by {found['wrong']:g}: called outside",
            format_percent(whole["found"], 1),
            'Most of such errors are not seen, above all in short records: a verdict "within" proves little.',
        ),
    ]


FORECASTS = ("identified", "too high", "too low", "rigid")


def _forecasts(found: Found) -> list[Row]:
    judged = found["judged"]
    return [
        Row(
            f"CRPS of {judged['tests']['count']} forecasts, in α: e identified, too high and too low by 0.01, "
            "rigid body's",
            ", ".join(f"{judged['scores'][name]['crps']:.3f}" for name in FORECASTS),
            "Forecast and truth are the same model with other numbers.",
        )
    ]


def _fragilities(found: Found) -> list[Row]:
    shares = [each["shares"] for each in found["designs"].values() if not each["population"]["two_kinds"]]

    def span(name: str) -> str:
        values = [each[name] for each in shares if each[name] is not None]
        return f"{format_percent(min(values), 1)} to {format_percent(max(values), 1)}"

    others = [each["shares"]["misfit"] for each in found["designs"].values() if each["population"]["two_kinds"]]
    return [
        Row(
            "95 % intervals that hold the median; β; β of records; the rate",
            "; ".join(span(name) for name in ("median", "beta", "beta of records", "rate")),
            "Capacities are drawn, no column is run: it is a check of the statistics. β of records covers too seldom.",
        ),
        Row(
            "curves rejected: lognormal ones (nominal 5 %); records of two kinds",
            f"{span('misfit')}; {format_percent(min(others), 1)}",
            "Only one kind of misfit was tried.",
        ),
    ]


def _demo(found: Found) -> list[Row]:
    tests = found["tests"].values()
    measured = [each["outcome"]["measured"] == each["outcome"]["true"] for each in tests]
    predicted = [each["outcome"]["nonlinear"] == each["outcome"]["true"] for each in tests]
    held = [each["low"] <= each["true"] <= each["high"] for each in found["restitution"].values()]
    values = [f"{each['value']:.3f} ({each['true']:.3f})" for each in found["restitution"].values()]
    return [
        Row(
            f"the paper's programme on the virtual table, {len(measured)} tests: outcomes measured; predicted by the "
            "nonlinear model",
            f"{sum(measured)} right; {sum(predicted)} right",
            "Every outcome follows from the equation that the model solves; noise, drift and spikes are those that we "
            "thought of.",
        ),
        Row(
            "e of its three specimens, to three digits (true); intervals that hold it",
            f"{', '.join(values)}; {sum(held)} of {len(held)}",
            "One e for all impacts, plane rocking.",
        ),
    ]


STUDIES = (
    Study("Restitution", "restitution-study", "`make study NAME=restitution`", _restitution),
    Study("Verdict on a prediction", "verdict-study", "`make study NAME=verdict`", _verdict),
    Study("Forecasts", "forecast-study", "`make study NAME=forecast`", _forecasts),
    Study("Fragility", "fragility-study", "`make study NAME=fragility`", _fragilities),
    Study("The whole programme", "demo", "`python reports/rebuild.py`", _demo),
)


def measured(folder: Path = HERE) -> str:
    """Write the tables of all studies from their numbers, and how many faults are planted."""
    parts = []
    for study in STUDIES:
        found = json.loads((folder / f"{study.name}.json").read_text(encoding="utf-8"))
        parts += [
            f"### {study.title}",
            f"[The study](../../reports/{study.name}.md), made by {study.maker}.",
            table(("check", "figure", "what it does not show"), study.rows(found)),
        ]
    parts += [
        "### Planted faults",
        f"{len(FAULTS)} faults, one a campaign, each found and named; {len(UNSEEN) - 1} that nothing finds. "
        "[The atlas](../faults/index.md), made by `python reports/fault_atlas.py`; `make test-all` plants each again.",
    ]
    return "\n\n".join(parts)


if __name__ == "__main__":
    place = Path(sys.argv[1]) if len(sys.argv) > 1 else DOCUMENT
    place.write_text(renewed(place.read_text(encoding="utf-8"), MARKS, measured()), encoding="utf-8")
