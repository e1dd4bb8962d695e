"""Rebuild the reference reports and the picture of the README: `python reports/rebuild.py [FOLDER]`."""

from __future__ import annotations

import json
import sys
import tempfile
from pathlib import Path
from typing import Any

from colonnade import figures, run
from colonnade.campaign import Campaign, load
from colonnade.dynamics.block import Block
from colonnade.laboratory import write_campaign
from colonnade.report import charts, results
from colonnade.store.layout import Layout

HERE = Path(__file__).resolve().parent
PICTURE = HERE.parent / "docs" / "demo.png"

TABLE_1 = {
    "prism": (
        Block.prism(width=0.086, depth=0.086, height=0.456, mass=26.10),
        {"critical_angle": 0.1886, "pole_distance": 0.232, "inertia": 1.873, "p": 5.631},
    ),
    "cylinder": (
        Block.cylinder(diameter=0.097, height=0.455, mass=26.30),
        {"critical_angle": 0.2132, "pole_distance": 0.227, "inertia": 1.883, "p": 5.631},
    ),
    "truncated cone": (
        Block.cone(base_diameter=0.097, top_diameter=0.0755, height=0.480, mass=21.94),
        {"critical_angle": 0.2203, "pole_distance": 0.220, "inertia": 1.527, "p": 5.631},
    ),
}
"""The paper's specimens (its Table 1) from their dimensions, and what the table prints."""


def rebuild(folder: Path, picture: Path | None = None) -> None:
    """Write all reference reports into a folder."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "table-1.md").write_text(table_1(), encoding="utf-8")
    with tempfile.TemporaryDirectory() as scratch:
        written = write_campaign(Path(scratch) / "demo", seed=0)
        run(written.path)
        campaign = load(written.path)
        summary = json.loads(Layout(campaign.folder).summary_json.read_text(encoding="utf-8"))
        numbers = demo_numbers(written.truth, summary)
        (folder / "demo.json").write_text(json.dumps(numbers, indent=1) + "\n", encoding="utf-8")
        (folder / "demo.md").write_text(demo_table(numbers), encoding="utf-8")
        draw(campaign, folder, picture)


def table_1() -> str:
    """Lay the paper's Table 1 beside what the dimensions give."""
    lines = [
        "# The paper's Table 1, recomputed from its dimensions",
        "",
        "Printed by Manos, Petalas and Demosthenous, and computed here with g = 9.81 m/s². The printed critical angles",
        "are tangents; the printed pole distances of cylinder and cone are heights of the centre of mass.",
        "",
        "| specimen | quantity | printed | computed | difference |",
        "|---|---|---|---|---|",
    ]
    units = {"critical_angle": "rad", "pole_distance": "m", "inertia": "kg m²", "p": "rad/s"}
    for specimen, (block, printed) in TABLE_1.items():
        for quantity, value in printed.items():
            computed = getattr(block, quantity)
            words = quantity.replace("_", " ")
            lines.append(
                f"| {specimen} | {words}, {units[quantity]} | {value} | {computed:.4f} | {value / computed - 1:+.2%} |"
            )
        lines.append(f"| {specimen} | rigid-body restitution | – | {block.restitution:.4f} | – |")
    return "\n".join(lines) + "\n"


def demo_numbers(truth: dict[str, Any], summary: dict[str, Any]) -> dict[str, Any]:
    """Return the demo campaign's results beside its truth."""
    found = summary["specimens"]["prism"]["restitution"]
    tests = {}
    for name, true in truth["tests"].items():
        test = summary["tests"][name]
        predicted = test["predicted"]["linear"]
        tests[name] = {
            "outcome": {"true": true["outcome"], "measured": test["outcome"], "linear": predicted["outcome"]},
            "peak_ratio": {
                "true": _rounded(true["peak_ratio"]),
                "measured": _rounded(test["peak_ratio"]),
                "linear": _rounded(predicted["peak_ratio"]),
            },
            "nrmse": _rounded(predicted["nrmse"]),
        }
    restitution = {"true": truth["specimens"]["prism"]["restitution"]} | {
        key: _rounded(found[key], 5) for key in ("value", "low", "high")
    }
    return {"seed": truth["seed"], "restitution": restitution, "tests": tests}


def demo_table(numbers: dict[str, Any]) -> str:
    """Write the demo's numbers as a page of text."""
    e = numbers["restitution"]
    lines = [
        f"# The demo campaign, seed {numbers['seed']}",
        "",
        f"Restitution of the prism: {e['value']} (95 % interval {e['low']} to {e['high']}), true {e['true']}.",
        "",
        "Outcome and largest |θ|/α: true (nonlinear model, adaptive integration), measured by virtual instruments,",
        "and predicted by the linear model on the recorded base motion; nrmse of predicted against measured.",
        "",
        "| test | true | measured | linear model | true max | measured max | linear max | nrmse |",
        "|---|---|---|---|---|---|---|---|",
    ]
    for name, test in numbers["tests"].items():
        outcome, peak = test["outcome"], test["peak_ratio"]
        cells = [outcome[key] for key in ("true", "measured", "linear")]
        cells += ["–" if peak[key] is None else f"{peak[key]:.4g}" for key in ("true", "measured", "linear")]
        lines.append(f"| {name} | " + " | ".join(cells) + f" | {test['nrmse']:.3g} |")
    lines += ["", "![Spans together](demo-spans.svg)", "", "![Peaks with fit](demo-peaks.svg)"]
    return "\n".join(lines) + "\n"


def draw(campaign: Campaign, folder: Path, picture: Path | None) -> None:
    """Draw Spans together and peaks with fit, and the README's picture."""
    block = campaign.block("prism")
    layout = Layout(campaign.folder)
    stored = {name: results.of_test(campaign, layout, test) for name, test in campaign.tests.items()}
    panels, described, series = [], [], []
    for test in campaign.tests.values():
        if test.kind == "earthquake":
            panels.append(charts.span_panel(test, stored[test.id], block))
            described.append(f"{panels[-1].title}: {charts.seen(stored[test.id])}")
        if test.kind == "free-vibration" and (found := charts.peak_series(test, stored[test.id])) is not None:
            series.append(found)
    title = "Measured and predicted rocking at three Spans"
    spans = charts.spans("demo-spans", title, " ".join(described), panels)
    (folder / "demo-spans.svg").write_text(spans, encoding="utf-8")
    (folder / "demo-peaks.svg").write_text(charts.peaks("demo-peaks", series, block), encoding="utf-8")
    if picture is not None:
        figures.spans_side_by_side(panels).savefig(picture, dpi=150, metadata={"Software": None})


def _rounded(value: float | None, digits: int = 4) -> float | None:
    return None if value is None else round(value, digits)


if __name__ == "__main__":
    rebuild(*([Path(sys.argv[1])] if len(sys.argv) > 1 else [HERE, PICTURE]))
