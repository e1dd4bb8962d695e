"""`colonnade demo` and `init`: a virtual campaign with its truth, and the draft of a campaign file from raw files."""

from __future__ import annotations

import shlex
from collections.abc import Callable
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any

import rich_click as click

from colonnade.cli.common.console import complain, say, show_json, show_table, shown, work_progress
from colonnade.cli.common.options import FILE, json_option, workers_option
from colonnade.cli.run import failed_rows, run_with_progress
from colonnade.errors import count

if TYPE_CHECKING:
    from colonnade.campaign.draft.write import CampaignDraft


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
@click.option(
    "--full", is_flag=True, help="Also assess the real columns of the specimens, on synthetic ground motions."
)
@click.option(
    "--assemblies", is_flag=True, help="Drums, a portal and two blocks at once, moved by MuJoCo, in place of all that."
)
@workers_option
@json_option
def demo(
    folder: Path, motion: Path | None, short: bool, full: bool, assemblies: bool, as_json: bool, **choices: Any
) -> int:
    """
    Write a virtual campaign with known truth, run all of it, and compare with the known truth.

    It has free vibrations, sines from 1 to 7 Hz and an earthquake at three Spans, of a steel prism, a cylinder and a
    truncated cone on a virtual shake table. Its instruments are imperfect; the files are text, TDMS and MATLAB. DIR, by
    default demo/, is created. If it holds an earlier demo, that is rewritten. Open DIR/report/index.html afterwards,
    and look at DIR/campaign.toml: your own will look like it.
    """
    from colonnade.campaign import FILE_NAME
    from colonnade.errors import ReadError
    from colonnade.laboratory import paper_programme, prism_programme, write_campaign
    from colonnade.laboratory.assemblies import write_assemblies
    from colonnade.laboratory.runs import with_truth

    if folder.is_dir() and any(folder.iterdir()) and not (folder / FILE_NAME).is_file():
        raise click.UsageError(f"{folder} contains other files. Name an empty folder, a new one, or an earlier demo.")
    if assemblies and (short or full or motion is not None):
        raise click.UsageError("--assemblies is a campaign of its own, without --short, --full and --motion")
    if assemblies and find_spec("mujoco") is None:
        raise click.UsageError("--assemblies needs the package `mujoco`: pip install colonnade[demo]")
    complain(f"Shaking the virtual table into {folder}")
    if assemblies:
        written = write_assemblies(folder, **choices)
    else:
        programme = prism_programme if short else paper_programme
        try:
            written = write_campaign(folder, motion=motion, programme=programme, site=full, **choices)
        except ReadError as error:
            raise click.UsageError(str(error)) from error
    result = run_with_progress(folder, workers=choices["workers"])
    comparison = with_truth(written.truth, result.summary) | {"report": result.report}
    if as_json:
        show_json(comparison)
    else:
        (_show_bodies if assemblies else _show)(comparison)
        show_table(("failed", "stage", "reason"), failed_rows(result))
        say(f"campaign: {written.path}")
        say(f"report: {result.report}")
    return int(result.failed)


def _show_tests(
    tests: dict[str, dict[str, Any]], heads: tuple[str, ...], cells: Callable[[dict[str, Any]], tuple[str, ...]]
) -> None:
    """Write the outcome of each test beside the truth, and `cells` of its own; then how often they agree."""
    from colonnade.store.records.wording import agreement

    rows = []
    for name, test in tests.items():
        right = "right" if test["outcome"] == test["true_outcome"] else "wrong"
        rows.append((name, shown(test["outcome"]), test["true_outcome"], right, *cells(test)))
    show_table(("test", "outcome", "true", "", *heads), rows)
    say(f"{sum(row[3] == 'right' for row in rows)} of {len(rows)} measured outcomes are right")
    for sentence in agreement(tests):
        say(sentence)


def _show_bodies(comparison: dict[str, Any]) -> None:
    def moved(test: dict[str, Any]) -> tuple[str, ...]:
        model = test["predicted"].get("contact", {}).get("outcome")
        farthest = [f"{1e3 * test[key]:.2f} mm" if "body" in test else "" for key in ("moved", "true_moved")]
        return shown(model), test.get("body", ""), *farthest

    _show_tests(comparison["tests"], ("contact model", "moved farthest", "by", "true"), moved)


def _show(comparison: dict[str, Any]) -> None:
    from colonnade.laboratory.programme import KEPT_AWAY
    from colonnade.units.text import interval, ratio

    for specimen, restitution in comparison["restitution"].items():
        true, value, low, high = (restitution[key] for key in ("true", "value", "low", "high"))
        if value is None or low is None:
            say(f"{specimen}: {restitution['reason'] or restitution['source']}; true is {true:g}")
        else:
            held = "inside" if low <= true <= high else "outside"
            found = interval(value, low, high, restitution["level"])
            say(f"{specimen}: e {found}; true is {true:g}, {held} the interval")
    say()

    def peaks(test: dict[str, Any]) -> tuple[str, ...]:
        return ratio(test["peak_ratio"], 4), ratio(test["true_peak_ratio"], 4)

    _show_tests(comparison["tests"], ("|θ|/α", "true"), peaks)
    say(KEPT_AWAY)


DRAWING = "drawing.svg"
"""Name of the drawing next to the draft."""

MOST_SHOWN = 12
"""Questions that are listed; the file has all of them."""


@click.command(epilog="Example: colonnade init measurements")
@click.argument("folder", type=FILE, default=Path(), metavar="[DIR]")
@json_option
def init(folder: Path, as_json: bool) -> int:
    """
    Draft a campaign.toml from the raw files.

    DIR is the folder with the raw files, or one that holds folders of them; by default the current folder. Columns,
    units, recorders and kinds of test are guessed, each guess with its reason after it. What no file shows is left
    as "?" for you to fill in. An existing campaign.toml is never overwritten. A drawing next to it shows the
    transducers with the directions that were guessed.
    """
    from colonnade.campaign.draft.write import draft
    from colonnade.figures.drawing.described import of_draft
    from colonnade.figures.files.saving import expect_place, save
    from colonnade.store.files import write_text

    with work_progress("Reading raw files") as advance:
        drafted = draft(folder, progress=advance)
    drawing = None if drafted.asks_first else drafted.path.with_name(DRAWING)
    if drawing:
        expect_place(drawing)
    write_text(drafted.path, drafted.text)
    if drawing:
        save(of_draft(drafted.text), drawing)
    if as_json:
        show_json(
            {"campaign": drafted.path, "drawing": drawing}
            | {key: getattr(drafted, key) for key in ("tests", "setups", "open", "doubts")}
            | {"refused": dict(drafted.refused)}
        )
    else:
        _tell(drafted, drawing)
    return 0


def _tell(drafted: CampaignDraft, drawing: Path | None) -> None:
    say(f"campaign: {drafted.path}")
    if drawing:
        say(f"drawing: {drawing}")
    say(f"{count(drafted.tests, 'test')}, {count(drafted.setups, 'set-up')}")
    for name, reason in drafted.refused:
        say(f"  not used: {name}: {reason}")
    if drafted.asks_first:
        say(
            f"First question: which of these {drafted.setups} kinds of files are recordings of tests? Remove the # "
            "from their groups."
        )
    show_table(
        ("line", "to fill in", "", "what is asked"),
        [(str(each.line), each.key, each.value, each.asked) for each in drafted.open[:MOST_SHOWN]],
    )
    if len(drafted.open) > MOST_SHOWN:
        say(f"… and {len(drafted.open) - MOST_SHOWN} more")
    if drafted.open:
        say(f'To fill in: {count(len(drafted.open), "value")} marked "?".')
    say(f'To look at: {count(len(drafted.doubts), "guess", "guesses")} marked "# ?".')
    say(f"Then: colonnade check {shlex.quote(str(drafted.path.parent))}")
