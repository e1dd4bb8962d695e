"""Write what the studies measured into docs/explanation/verification.md: `python reports/verification.py`."""

from __future__ import annotations

import json
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

from colonnade.units import format_percent
from colonnade.units.text import with_minus
from faults.registry import FAULTS
from faults.unseen import UNSEEN
from monte_carlo.page import FACTORS
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
    """A study: its title, its JSON file and its page, what makes it, and its rows."""

    title: str
    numbers: str
    page: str
    maker: str
    rows: Callable[[Found], list[Row]]


def _restitution(found: Found) -> list[Row]:
    [whole] = [row for row in found["levels"] if row["level"] == "all"]
    levels = [row["coverage"] for row in found["levels"] if row["factor"] in FACTORS]
    return [
        Row(
            f"e of {found['records']} random records with known truth: bias",
            f"{_power(whole['bias'])} ± {_power(whole['bias_error'])}",
            "The truth is the plane equation with one law of e: not a real contact.",
        ),
        Row(
            "share of the 95 % intervals that hold the true e",
            f"{format_percent(whole['coverage'], 1)}; by level {format_percent(min(levels), 1)} to "
            f"{format_percent(max(levels), 1)}",
            "It counts records whose dimensions are right. Some kinds of record miss the goal; the page lists them.",
        ),
        Row(
            "records refused",
            f"{format_percent(whole['refused'], 1)}; of those with eight impacts "
            f"{format_percent(whole['refused_of_eight'], 1)}",
            "A refusal of a good record costs a test, and is not counted as an error.",
        ),
        Row(
            "RMS error of e; of an unweighted line through the highest samples",
            f"{_power(whole['scatter'])}; {_power(whole['naive_scatter'])}",
            "The naive way is ours; no program of others was compared.",
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


def _forecasts(found: Found) -> list[Row]:
    judged = found["judged"]
    return [
        Row(
            f"CRPS of {judged['tests']['count']} forecasts, in α: e identified, too high and too low by 0.01, "
            "rigid body's",
            ", ".join(
                f"{judged['scores'][name]['crps']:.3f}" for name in ("identified", "too high", "too low", "rigid")
            ),
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


def _contact(found: Found) -> list[Row]:
    nodes = {row["body"]: row["restitution"] for row in found["nodes"]}
    gap = max(abs(row["own"] - row["fitted"]) for row in found["observed"])
    worst = max(row["residual"] for row in found["nodes"])
    return [
        Row(
            "e of the prism on its 2 × 2 corners, ξ = 0.4 (rigid body: 0.9485); on 5 × 5, on 33 × 33 nodes",
            f"{nodes['2 × 2']:.4f}; {nodes['5 × 5']:.4f}, {nodes['33 × 33']:.4f}",
            "e of this contact is that of its set-up. No number of nodes is the right one.",
        ),
        Row(
            "e identified from its angle against its own velocity ratios: largest difference",
            f"{gap:.4f} in {len(found['observed'])} bodies",
            "A contact that bounces has two values of e; which one a test measures depends on how it is found.",
        ),
        Row(
            "energy that the balance misses, of the largest, at 10 µs",
            format_percent(worst, 1),
            "A closed balance is not a right contact law.",
        ),
    ]


def _convergence(found: Found) -> list[Row]:
    def error(scheme: str, case: str, refinement: int, step: float) -> float:
        [row] = [
            each for each in found if (each["scheme"], each["case"], each["refinement"]) == (scheme, case, refinement)
        ]
        return float(row["errors"][row["steps"].index(step)])

    orders = {each["scheme"]: each["order"] for each in found if each["case"] == "arc"}
    return [
        Row(
            "observed order of Runge–Kutta and Hamming on one arc, against the exact solution",
            f"{orders['runge-kutta']:.2f}, {orders['hamming']:.2f}",
            "Both were written for this check, after the paper's description.",
        ),
        Row(
            "their error at DT = 1e-4 s after 4 s of free rocking, in α: without and with DT/10 around contacts",
            f"{error('runge-kutta', 'free', 1, 1e-4):.3f}; {error('runge-kutta', 'free', 10, 1e-4):.4f}",
            "How the paper's own program took contacts is not stated.",
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
    Study("Restitution", "restitution-study", "restitution-study", "`make study NAME=restitution`", _restitution),
    Study("Verdict on a prediction", "verdict-study", "verdict-study", "`make study NAME=verdict`", _verdict),
    Study("Forecasts", "forecast-study", "forecast-study", "`make study NAME=forecast`", _forecasts),
    Study("Fragility", "fragility-study", "fragility-study", "`make study NAME=fragility`", _fragilities),
    Study(
        "Contact model",
        "contact-study",
        "contact-study",
        "a program that has left the tree since (commit `ede3d35`)",
        _contact,
    ),
    Study("The paper's schemes", "convergence", "convergence", "`python reports/convergence.py`", _convergence),
    Study("The whole programme", "demo", "demo", "`python reports/rebuild.py`", _demo),
)


def measured(folder: Path = HERE) -> str:
    """Write the tables of all studies from their numbers, and how many faults are planted."""
    parts = []
    for study in STUDIES:
        found = json.loads((folder / f"{study.numbers}.json").read_text(encoding="utf-8"))
        parts += [
            f"### {study.title}",
            f"[The study](../../reports/{study.page}.md), made by {study.maker}.",
            table(("check", "figure", "what it does not show"), study.rows(found)),
        ]
    parts += [
        "### Planted faults",
        f"{len(FAULTS)} faults, one a campaign, each found and named; {len(UNSEEN) - 1} that nothing finds. "
        "[The atlas](../faults/index.md), made by `python reports/fault_atlas.py`; `make test-all` plants each again.",
    ]
    return "\n\n".join(parts)


def _power(value: float) -> str:
    return with_minus(f"{value:.1e}")


if __name__ == "__main__":
    place = Path(sys.argv[1]) if len(sys.argv) > 1 else DOCUMENT
    place.write_text(renewed(place.read_text(encoding="utf-8"), MARKS, measured()), encoding="utf-8")
