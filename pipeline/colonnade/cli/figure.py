"""`colonnade figure`: one figure at the size of a journal, with its data."""

from __future__ import annotations

from pathlib import Path

import rich_click as click

from colonnade.cli.common import options
from colonnade.cli.common.console import say, say_drawn, show_json, show_table


@click.command(
    epilog="Example: colonnade figure angle demo span-2.5 --width single --out span-2.5.pdf --data span-2.5.csv"
)
@click.argument("name", required=False)
@options.campaign_and_id_argument
@options.file_option(
    "--out", "Where to write it: .svg, .pdf, .png, or .csv for its data. By default NAME-ID.svg in the current folder."
)
@options.file_option("--data", "Also write its data, as a .csv table.")
@click.option(
    "--width",
    type=click.Choice(("single", "double")),
    default="double",
    show_default=True,
    help="Of a journal's column, 90 mm, or of its page, 190 mm.",
)
@click.option("--list", "listed", is_flag=True, help="List the figures.")
@options.result_options
def figure(
    name: str | None, arguments: tuple[str, ...], width: str, listed: bool, as_json: bool, **places: Path | None
) -> None:
    """
    Draw one figure at the size of a journal, with its data.

    NAME is a figure of `colonnade figure --list`, ID the test or specimen that it is of. A single argument after the
    name is taken as CAMPAIGN if such a file or folder exists, else as ID. The figure shows the results of the last run;
    its table has all samples.

    `colonnade figure animation TEST` writes the rocking block, measured and by each model, as a GIF.
    """
    if listed or name is None:
        _list(as_json=as_json)
        return
    from colonnade.campaign import load
    from colonnade.figures.files.saving import MOVIE, PICTURES, TABLE, expect_places, save
    from colonnade.figures.style import journal
    from colonnade.workflow.documents import chosen, draw

    path, identifier = options.campaign_and_id(arguments)
    campaign, out, data = load(path), places["out"], places["data"]
    entry, subject = chosen(campaign, name, identifier)
    moves = name == "animation"
    target = out or (None if data else Path(f"{'-'.join(filter(None, (name, subject)))}{MOVIE if moves else '.svg'}"))
    if moves and data is not None:
        raise click.UsageError('An animation has no table. Use the figure "angle" with --data.')
    expect_places(target, data, (MOVIE,) if moves else (*PICTURES, TABLE))
    if width == "single" and not entry.is_narrow:
        raise click.UsageError(f'"{name}" is not legible in a single column. Use --width double.')
    with journal(width):
        picture = draw(campaign, entry, subject, places["results"])
        written = [save(picture, place) for place in (target, data) if place is not None]
    note = getattr(picture, "note", "")
    if as_json:
        told = {"title": picture.title, "description": picture.description, "note": note}
        show_json({"figure": target, "data": data, **told})
    else:
        say_drawn(written)
        if note:
            say(note)


def _list(*, as_json: bool) -> None:
    from colonnade.report.pictures import FIGURES

    if as_json:
        show_json([{"name": each.name, "of": each.of, "shows": each.shows, "needs": each.needs} for each in FIGURES])
    else:
        show_table(("figure", "of a", "shows"), [(each.name, each.of, each.shows) for each in FIGURES])
