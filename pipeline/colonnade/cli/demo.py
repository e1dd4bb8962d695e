"""`colonnade demo` and `init`: a virtual campaign with its truth, and the draft of a campaign file from raw files."""

from __future__ import annotations

import shlex
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any

import rich_click as click

from colonnade.cli.common import options
from colonnade.cli.common.console import complain, expect_places, saved, say, show_json, work_progress
from colonnade.cli.run import run_with_progress, show_result
from colonnade.errors import count
from colonnade.units.text import interval, listed, quantity

if TYPE_CHECKING:
    from colonnade.campaign.draft.write import CampaignDraft


@click.command(epilog="Example: colonnade demo demo --seed 3")
@click.argument("folder", type=click.Path(file_okay=False, path_type=Path), default=Path("demo"), metavar="[DIR]")
@click.option(
    "--seed", type=click.IntRange(min=0), default=0, show_default=True, help="Seed of the instruments' errors."
)
@click.option("--motion", type=options.FILE, metavar="FILE", help="Earthquake to play; by default El Centro 1940 NS.")
@click.option("--short", is_flag=True, help="Ten tests of the prism instead of the whole programme.")
@click.option(
    "--assemblies", is_flag=True, help="Drums, a portal and two blocks at once, moved by MuJoCo, in place of all that."
)
@options.workers_option
@options.json_option
def demo(folder: Path, motion: Path | None, short: bool, assemblies: bool, as_json: bool, **choices: Any) -> int:
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
    if assemblies and (short or motion is not None):
        raise click.UsageError("--assemblies is a campaign of its own, without --short and --motion")
    if assemblies and find_spec("mujoco") is None:
        raise click.UsageError("--assemblies needs the package `mujoco`: pip install colonnade[demo]")
    complain(f"Shaking the virtual table into {folder}")
    if assemblies:
        written = write_assemblies(folder, **choices)
    else:
        programme = prism_programme if short else paper_programme
        try:
            written = write_campaign(folder, motion=motion, programme=programme, **choices)
        except ReadError as error:
            raise click.UsageError(str(error)) from error
    result = run_with_progress(folder, workers=choices["workers"])
    compared = with_truth(written.truth, result.summary)
    if as_json:
        show_json(compared | {"report": result.report})
    else:
        show_result(result)
        say()
        _show_truth(compared)
        say(f"campaign: {written.path}")
    return int(result.failed)


def _show_truth(compared: dict[str, Any]) -> None:
    """Write what was measured beside what is true."""
    from colonnade.laboratory.programme import KEPT_AWAY

    for specimen, restitution in compared.get("restitution", {}).items():
        true, value, low, high = (restitution[key] for key in ("true", "value", "low", "high"))
        if value is None or low is None:
            say(f"{specimen}: {restitution['reason'] or restitution['source']}; true is {true:g}")
        else:
            held = "inside" if low <= true <= high else "outside"
            found = interval(value, low, high, restitution["level"])
            say(f"{specimen}: e {found}; true is {true:g}, {held} the interval")
    tests = compared["tests"]
    wrong = [name for name, test in tests.items() if test["outcome"] != test["true_outcome"]]
    say(f"{len(tests) - len(wrong)} of {len(tests)} measured outcomes are right")
    if wrong:
        say(f"wrong: {listed(wrong)}")
    _show_farthest(tests, "peak_ratio", "Peaks |θ|/α", "")
    _show_farthest(tests, "moved", "Displacements at the end", "mm")
    if "restitution" in compared:
        say(KEPT_AWAY)


def _show_farthest(tests: dict[str, dict[str, Any]], key: str, what: str, unit: str) -> None:
    """Say how far at most a measured value is from the true one, if any is known."""
    both = {name: (test[key], test[f"true_{key}"]) for name, test in tests.items() if key in test}
    off = {name: abs(found - true) for name, (found, true) in both.items() if None not in (found, true)}
    if off:
        worst = max(off, key=lambda name: off[name])
        say(f"{what} are within {quantity(off[worst], unit, 2)} of the true ones, farthest off in {worst}")


DRAWING = "drawing.svg"
"""Name of the drawing next to the draft."""


@click.command(epilog="Example: colonnade init measurements")
@click.argument("folder", type=options.FILE, default=Path(), metavar="[DIR]")
@options.json_option
def init(folder: Path, as_json: bool) -> None:
    """
    Draft a campaign.toml from the raw files.

    DIR is the folder with the raw files, or one that holds folders of them; by default the current folder. Columns,
    units, recorders and kinds of test are guessed, each guess with its reason after it. What no file shows is left
    as "?" for you to fill in. An existing campaign.toml is never overwritten. A drawing next to it shows the
    transducers with the directions that were guessed.
    """
    from colonnade.campaign.draft.write import draft
    from colonnade.figures.drawing.described import of_draft
    from colonnade.store.files import write_text

    with work_progress("Reading raw files") as advance:
        drafted = draft(folder, progress=advance)
    drawing = drafted.path.with_name(DRAWING)
    expect_places(drawing)
    write_text(drafted.path, drafted.text)
    saved(lambda: of_draft(drafted.text), drawing)
    if as_json:
        show_json(
            {"campaign": drafted.path, "drawing": drawing}
            | {key: getattr(drafted, key) for key in ("tests", "setups", "open", "doubts")}
            | {"refused": dict(drafted.refused)}
        )
    else:
        _tell(drafted, drawing)


def _tell(drafted: CampaignDraft, drawing: Path) -> None:
    say(f"campaign: {drafted.path}")
    say(f"drawing: {drawing}")
    say(f"{count(drafted.tests, 'test')}, {count(drafted.setups, 'set-up')}")
    for name, reason in drafted.refused:
        say(f"  not used: {name}: {reason}")
    if drafted.open:
        say(f'To fill in: {count(len(drafted.open), "value")} marked "?", the first in line {drafted.open[0]}.')
    say(f'To look at: {count(drafted.doubts, "guess", "guesses")} marked "# ?".')
    say(f"Then: colonnade check {shlex.quote(str(drafted.path.parent))}")
