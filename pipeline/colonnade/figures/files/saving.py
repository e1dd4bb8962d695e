"""A figure in a file of its own, in the format that its name ends with, whole or not at all."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from matplotlib.collections import Collection
from matplotlib.figure import Figure

from colonnade.errors import CampaignError, quoted
from colonnade.figures.files.output import MARK, Movie, Picture, to_csv, to_gif, to_pdf, to_png
from colonnade.store import files

PICTURES = (".svg", ".pdf", ".png")
"""Endings of pictures."""

MOVIE = ".gif"
"""Ending of a figure that moves."""

TABLE = ".csv"
"""Ending of the table of what a figure shows."""

LARGEST = 200_000_000
"""No figure of ours has as many bytes."""


def expect_place(path: Path, endings: Sequence[str] = PICTURES) -> None:
    """
    Refuse a place for a figure before any work is done for it.

    Parameters
    ----------
    path : Path
    endings : sequence of str, optional
        Those that are possible.

    Raises
    ------
    CampaignError
        If the name has another ending, or the file exists and is not a figure of colonnade.
    """
    if path.suffix.lower() not in endings:
        found = f"unknown ending {quoted(path.suffix)}" if path.suffix else "the name has no ending"
        raise CampaignError(f"{path}: {found}. Expected {' or '.join(endings)}, which says what kind of file to write.")
    if path.is_dir():
        raise CampaignError(f"{path}: this is a folder. Name a file in it.")
    if path.suffix.lower() != TABLE and (path.exists() or path.is_symlink()) and not _is_ours(path):
        raise CampaignError(
            f"{path}: this file is not a figure of colonnade and was not changed. Name another file or remove it first."
        )


def expect_places(picture: Path | None, table: Path | None, endings: Sequence[str] = PICTURES) -> None:
    """Refuse places for a picture and its table, if they are asked for; arguments and errors as of `expect_place`."""
    for place, possible in ((picture, endings), (table, (TABLE,))):
        if place is not None:
            expect_place(place, possible)


def save(picture: Picture | Movie, path: Path) -> Path:
    """
    Write a picture, or the table of what it shows, to a file.

    Parameters
    ----------
    picture : Picture or Movie
    path : Path
        Its ending says what is written.

    Returns
    -------
    path : Path

    Raises
    ------
    CampaignError
        As `expect_place`, and if a table would replace a file with other columns.
    StoreError
        If it cannot be written.
    """
    ending = path.suffix.lower()
    if isinstance(picture, Movie):
        expect_place(path, (MOVIE,))
        files.write_bytes(path, to_gif(picture))
        return path
    expect_place(path, (*PICTURES, TABLE))
    _drop_links(picture.figure)
    if ending == TABLE:
        text = to_csv(picture.figure)
        _expect_same_columns(path, text)
        files.write_text(path, text)
    elif ending == ".svg":
        files.write_text(path, f'<?xml version="1.0" encoding="UTF-8"?>\n{picture.svg}\n<!-- {MARK} -->\n')
    else:
        files.write_bytes(path, to_pdf(picture.figure) if ending == ".pdf" else to_png(picture.figure, dpi=300))
    return path


def _drop_links(figure: Figure) -> None:
    """Take away the links to pages of tests: they lead nowhere from a file of its own."""
    for artist in figure.findobj():
        artist.set_url(None)
        if isinstance(artist, Collection):
            artist.set_urls([None])


def _is_ours(path: Path) -> bool:
    try:
        return path.is_file() and path.stat().st_size < LARGEST and MARK.encode() in path.read_bytes()
    except OSError:
        return False


def _expect_same_columns(path: Path, text: str) -> None:
    if not (path.exists() or path.is_symlink()):
        return
    try:
        with path.open(encoding="utf-8", newline="") as stream:
            same = stream.readline() == text[: text.index("\n") + 1]
    except (OSError, UnicodeError):
        same = False
    if not same:
        raise CampaignError(
            f"{path}: this file has other columns than this figure and was not changed. Name another file or remove it."
        )
