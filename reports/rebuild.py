"""Rebuild the reference reports and the picture of the README: `python reports/rebuild.py [FOLDER]`."""

from __future__ import annotations

import json
import sys
import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from colonnade import run
from colonnade.campaign import Campaign, load
from colonnade.campaign.forms.summary import Summary
from colonnade.figures.files.output import to_gif
from colonnade.figures.maps import response_orders
from colonnade.figures.moving import animation
from colonnade.figures.restitution import decay
from colonnade.figures.stored import record
from colonnade.figures.stored.subject import OfTest
from colonnade.laboratory import paper_programme, prism_programme, write_campaign
from colonnade.laboratory.programme import KEPT_AWAY
from colonnade.store.layout import Layout
from colonnade.store.records.stored import read_test
from colonnade.store.records.summary import map_points
from colonnade.store.records.wording import agreement
from study import HERE, table, write_numbers

PICTURE = HERE.parent / "docs" / "demo.gif"
MOVING, COARSE = "span-3.0", 80
"""The test that the picture of the README shows; its dots an inch."""

COLUMNS = ("true", "measured", "linear", "nonlinear")
OTHERS = COLUMNS[1:]
HEADS = ("test", "outcome: true", *OTHERS, "max: true", *OTHERS, "nrmse: linear", "nonlinear", "order")

TITLES = {
    "short": "The ten tests of `colonnade demo --short`",
    "demo": "The paper's programme, as `colonnade demo` performs it",
}


def rebuild(folder: Path, picture: Path | None = None) -> None:
    """Write the reference reports into a folder, and the picture of the README where one is wanted."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, programme in (("short", prism_programme), ("demo", paper_programme)):
        with tempfile.TemporaryDirectory() as scratch:
            written = write_campaign(Path(scratch) / "demo", seed=0, programme=programme, workers=None)
            run(written.path)
            tell(written.path, folder, name, picture if name == "short" else None)


def tell(path: Path, folder: Path, name: str, picture: Path | None = None) -> None:
    """Lay the results of a virtual campaign that was run beside its truth, as numbers and as a page with figures."""
    campaign = load(path)
    layout = Layout(campaign.folder)
    summary = json.loads(layout.summary_json.read_text(encoding="utf-8"))
    truth = json.loads((campaign.folder / "truth" / "truth.json").read_text(encoding="utf-8"))
    numbers = demo_numbers(truth, summary)
    write_numbers(folder / f"{name}.json", numbers)
    drawn = draw(campaign, summary, folder, name, picture)
    (folder / f"{name}.md").write_text(demo_table(numbers, TITLES[name], drawn), encoding="utf-8")


def demo_numbers(truth: dict[str, Any], summary: dict[str, Any]) -> dict[str, Any]:
    """Return a virtual campaign's results beside its truth."""
    tests = {}
    for name, true in truth["tests"].items():
        test = summary["tests"][name]
        both, models = {"true": true, "measured": test}, test["predicted"]
        tests[name] = {
            "outcome": {whose: each["outcome"] for whose, each in (both | models).items()},
            "peak_ratio": {whose: _rounded(each["peak_ratio"]) for whose, each in (both | models).items()},
            "nrmse": {model: _rounded(predicted["nrmse"]) for model, predicted in models.items()},
            "order": test["order"],
        }
        if true["release_ratio"] is not None:
            tests[name]["release_ratio"] = {whose: _rounded(each["release_ratio"]) for whose, each in both.items()}
    restitution = {}
    for specimen, true in truth["specimens"].items():
        found = summary["specimens"][specimen]["restitution"]
        restitution[specimen] = {"true": true["restitution"]} | {
            key: _rounded(found[key], 5) for key in ("value", "low", "high")
        }
    return {"seed": truth["seed"], "restitution": restitution, "tests": tests, "agreement": agreement(summary["tests"])}


def demo_table(numbers: dict[str, Any], title: str, drawn: Mapping[str, str]) -> str:
    """Write a campaign's numbers as a page of text, with its figures."""
    lines = [
        f"# {title}",
        "",
        f"Seed {numbers['seed']}; written by `make reports`.",
        "",
        table(
            ("specimen", "true e", "identified e", "95 % interval"),
            (
                (specimen, e["true"], e["value"], f"{e['low']} to {e['high']}")
                for specimen, e in numbers["restitution"].items()
            ),
        ),
        "",
        "Outcome and largest |θ|/α: true (nonlinear model, adaptive integration), measured by virtual instruments, and",
        "predicted on the recorded base motion; nrmse of predicted against measured. A free vibration is predicted,",
        "and its peak measured, from the first peak after an impact on.",
        "",
        table(HEADS, [_row(name, test) for name, test in numbers["tests"].items()]),
        "",
        *(f"- {told}" for told in numbers["agreement"]),
        f"- {KEPT_AWAY}",
    ]
    for caption, file in drawn.items():
        lines += ["", f"![{caption}]({file})"]
    return "\n".join(lines) + "\n"


def _row(name: str, test: dict[str, Any]) -> list[str]:
    outcomes = [test["outcome"].get(key) or "–" for key in COLUMNS]
    peaks = [_shown(test["peak_ratio"].get(key)) for key in COLUMNS]
    misfits = [_shown(test["nrmse"].get(model), 3) for model in COLUMNS[2:]]
    return [name, *outcomes, *peaks, *misfits, str(test["order"] or "–")]


def draw(campaign: Campaign, summary: dict[str, Any], folder: Path, name: str, picture: Path | None) -> dict[str, str]:
    """Draw Spans together, peaks with fit and the measured map of the prism; return the files by caption."""
    block = campaign.block("prism")
    layout = Layout(campaign.folder)
    tests = [test for test in campaign.tests.values() if test.specimen == "prism"]
    records = Summary.model_validate(summary).tests
    spans, free = (
        [
            OfTest(campaign, test, records[test.id], read_test(campaign, layout, test))
            for test in tests
            if test.kind == kind
        ]
        for kind in ("earthquake", "free-vibration")
    )
    panels = list(map(record.span_panel, spans))
    described = " ".join(f"{panel.title}: the prism" for panel in panels)
    series = list(filter(None, map(decay.peak_series, free)))
    points = map_points(records, "prism")
    title = "Measured and predicted rocking at three Spans"
    drawn = {
        title: ("spans", record.spans(f"{name}-spans", title, described, panels)),
        "Peaks with fit": ("peaks", decay.peaks(f"{name}-peaks", series, block)),
        "Measured map of the prism": ("map", response_orders.tested(f"{name}-map", points)),
    }
    for part, drawing in drawn.values():
        if drawing is not None:
            (folder / f"{name}-{part}.svg").write_text(drawing.svg, encoding="utf-8")
    if picture is not None:
        moving = animation(next(one for one in spans if one.test.id == MOVING))
        assert moving is not None
        picture.write_bytes(to_gif(moving, dpi=COARSE))
    return {caption: f"{name}-{part}.svg" for caption, (part, _) in drawn.items()}


def _shown(value: float | None, digits: int = 4) -> str:
    return "–" if value is None else f"{value:.{digits}g}"


def _rounded(value: float | None, digits: int = 4) -> float | None:
    return None if value is None else round(value, digits)


if __name__ == "__main__":
    rebuild(*([Path(sys.argv[1])] if len(sys.argv) > 1 else [HERE, PICTURE]))
