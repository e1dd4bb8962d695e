"""`colonnade demo`: the virtual campaign, written and run, held against its truth."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import rich_click as click

from colonnade.cli.console import complain, say, show_json, show_table, shown
from colonnade.cli.options import json_option, workers_option
from colonnade.cli.work import failed_rows, run_with_progress


@click.command(epilog="Example: colonnade demo demo --seed 3")
@click.argument("folder", type=click.Path(file_okay=False, path_type=Path), default=Path("demo"), metavar="[DIR]")
@click.option(
    "--seed", type=click.IntRange(min=0), default=0, show_default=True, help="Seed of the instruments' errors."
)
@click.option(
    "--motion",
    type=click.Path(exists=True, dir_okay=False, path_type=Path),
    metavar="FILE",
    help="Earthquake record to play; El Centro 1940 NS by default.",
)
@click.option("--short", is_flag=True, help="Ten tests of the prism instead of the whole programme.")
@workers_option
@json_option
def demo(folder: Path, seed: int, motion: Path | None, short: bool, workers: int | None, as_json: bool) -> int:
    """
    Write a virtual campaign with known truth, run all of it, and tell how near it came.

    Free vibrations, sines from 1 to 7 Hz and an earthquake at three Spans, of a steel prism, a cylinder and a truncated
    cone on a virtual shake table with imperfect instruments, recorded in text, TDMS and MATLAB files. DIR, by default
    demo/, is made; it may also be a former demo, which is then written anew. Open DIR/report/index.html afterwards, and
    have a look at DIR/campaign.toml: your own will look like it.
    """
    from colonnade.errors import ReadError
    from colonnade.laboratory import paper_programme, prism_programme, write_campaign
    from colonnade.laboratory.campaign_file import FILE_NAME

    if folder.is_dir() and any(folder.iterdir()) and not (folder / FILE_NAME).is_file():
        raise click.UsageError(f"{folder} holds other files. Name one that is empty, not there yet, or a former demo.")
    complain(f"Shaking the virtual table into {folder}")
    try:
        programme = prism_programme if short else paper_programme
        written = write_campaign(folder, seed=seed, motion=motion, programme=programme, workers=workers)
    except ReadError as error:
        raise click.UsageError(str(error)) from error
    result = run_with_progress(folder, workers=workers)
    comparison = _comparison(written.truth, result.summary) | {"report": shown(result.report)}
    if as_json:
        show_json(comparison)
    else:
        _tell(comparison)
        show_table(("failed", "stage", "reason"), failed_rows(result))
        say(f"campaign: {written.path}")
        say(f"report: {result.report}")
    return int(result.failed)


def _comparison(truth: dict[str, Any], summary_path: Path) -> dict[str, Any]:
    """Lay what was found beside what is true."""
    summary = json.loads(summary_path.read_text(encoding="utf-8"))
    found = {name: summary["tests"][name] for name in truth["tests"]}
    return {
        "restitution": {
            name: {"true": true["restitution"]} | summary["specimens"][name]["restitution"]
            for name, true in truth["specimens"].items()
        },
        "tests": {
            name: {
                "true_outcome": true["outcome"],
                "outcome": found[name]["outcome"],
                "true_peak_ratio": true["peak_ratio"],
                "peak_ratio": found[name]["peak_ratio"],
                "true_release_ratio": true["release_ratio"],
                "release_ratio": found[name]["release_ratio"],
                "predicted": found[name]["predicted"],
            }
            for name, true in truth["tests"].items()
        },
    }


def _tell(comparison: dict[str, Any]) -> None:
    from colonnade.laboratory.ladder import KEPT_AWAY
    from colonnade.report.agreement import of_summary
    from colonnade.units import format_uncertain

    for specimen, restitution in comparison["restitution"].items():
        true, value, low, high = (restitution[key] for key in ("true", "value", "low", "high"))
        if value is None or low is None:
            say(f"{specimen}: {restitution['reason'] or restitution['source']}; true is {true:g}")
        else:
            held = "holds" if low <= true <= high else "misses"
            found = f"e identified as {format_uncertain(value, (high - low) / 2)} ({restitution['level']:.0%} interval)"
            say(f"{specimen}: {found}; true is {true:g}, which the interval {held}")
    say()
    rows = []
    for name, test in comparison["tests"].items():
        right = "right" if test["outcome"] == test["true_outcome"] else "wrong"
        predicted = "; ".join(
            f"{model}: {result['outcome']} {shown(result['peak_ratio'])}".rstrip()
            for model, result in test["predicted"].items()
            if result.get("outcome")
        )
        ratios = (shown(test["peak_ratio"]), shown(test["true_peak_ratio"]))
        rows.append((name, shown(test["outcome"]), test["true_outcome"], right, *ratios, predicted))
    show_table(("test", "outcome", "true", "", "|θ|/α", "true", "predicted"), rows)
    say(f"{sum(row[3] == 'right' for row in rows)} of {len(rows)} measured outcomes are right")
    for told in of_summary(comparison["tests"]):
        say(told)
    say(KEPT_AWAY)
