"""What a planted fault is, and how it is planted: in a raw file, in campaign.toml, or in review.toml."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from colonnade.arrays import Array

Change = Callable[[Path], None]
"""Of the folder of a campaign."""

HEAD = 2
"""Rows of a raw file above its samples: names and units."""

TIME, TOP, BOTTOM = 0, 1, 2
"""Columns of the files of the main recorder."""
TABLE = 1
"""Column of the second recorder's files."""


def samples(path: Path) -> Array:
    """Read the samples of a raw file, shape (n, columns): time first."""
    return np.loadtxt(path, delimiter=",", skiprows=HEAD, ndmin=2)


def in_file(name: str, change: Callable[[Array], Array]) -> Change:
    """Change a raw file: `change` gets time and columns (n, m) and returns them changed."""

    def plant(folder: Path) -> None:
        path = folder / "raw" / name
        head = path.read_text(encoding="utf-8").splitlines()[:HEAD]
        rows = [",".join(f"{value:.6f}" for value in row) for row in change(samples(path))]
        path.write_text("\n".join([*head, *rows, ""]), encoding="utf-8")

    return plant


def in_campaign(pattern: str, replacement: str) -> Change:
    """Change the one place of campaign.toml that a pattern finds."""

    def plant(folder: Path) -> None:
        path = folder / "campaign.toml"
        text, count = re.subn(pattern, replacement, path.read_text(encoding="utf-8"))
        if count != 1:
            raise ValueError(f"{pattern!r} is {count} times in campaign.toml; once was expected")
        path.write_text(text, encoding="utf-8")

    return plant


def both(*changes: Change) -> Change:
    """Make one change after the other."""

    def plant(folder: Path) -> None:
        for change in changes:
            change(folder)

    return plant


def times(column: int, factor: float) -> Callable[[Array], Array]:
    """Multiply a column."""

    def change(table: Array) -> Array:
        table[:, column] *= factor
        return table

    return change


def swapped(table: Array) -> Array:
    """Exchange the columns of the two transducers."""
    table[:, [TOP, BOTTOM]] = table[:, [BOTTOM, TOP]]
    return table


def channel_line(setup: str, channel: str, old: str, new: str) -> Change:
    """Change the line of a channel in campaign.toml; `old` is a pattern in it."""
    return in_campaign(rf"(?s)(\[setups\.{setup}\.channels\].*?\n{channel} = [^\n]*?){old}", rf"\g<1>{new}")


def processing(lines: str) -> Change:
    """Add the table of settings to campaign.toml."""
    return in_campaign(r"\n# What was tested\.", f"\n[processing]\n{lines}\n\n# What was tested.")


def review(entry: str) -> Change:
    """Write a review.toml with one entry; who, when and why are added."""

    def write(folder: Path) -> None:
        text = f'schema = 1\n\n{entry}\nwho = "M. Rossi"\nwhen = 2013-05-15\nwhy = "found by colonnade"\n'
        (folder / "review.toml").write_text(text, encoding="utf-8")

    return write


@dataclass(frozen=True)
class Curve:
    """
    A curve of a picture.

    Attributes
    ----------
    label : str
    x, y : ndarray, shape (n,)
    """

    label: str
    x: Array
    y: Array


@dataclass(frozen=True)
class Picture:
    """
    What is drawn of a campaign, without the fault and with it.

    Attributes
    ----------
    curves : callable
        Of the folder of a campaign.
    up : str
        What the upright axis is, with its unit.
    window : pair of float
        Of the axis across.
    shows : str
        What is seen, in a sentence.
    across : str
        What the axis across is, with its unit.
    """

    curves: Callable[[Path], list[Curve]]
    up: str
    window: tuple[float, float]
    shows: str
    across: str = "time, s"


@dataclass(frozen=True)
class Fault:
    """
    A fault, planted into a sound campaign.

    Attributes
    ----------
    name : str
        Its title, unique.
    test : str
        The test of the sound campaign that it is planted in.
    happens : str
        How it comes about in a laboratory.
    plant : callable
        Changes the folder of a campaign.
    message : str
        What colonnade says: a regular expression.
    picture : Picture
    mend : str
        What to do.
    mending : callable or None
        The lines that mend it, put into campaign.toml or review.toml; None if no line does.
    command : {"check", "run"}
        Which command finds it.
    stays : bool
        Whether the message stays, because the recording is as it was, and only its use is another.
    """

    name: str
    test: str
    happens: str
    plant: Change
    message: str
    picture: Picture
    mend: str
    mending: Change | None = None
    command: str = "check"
    stays: bool = False

    @property
    def slug(self) -> str:
        """The name of its picture and the anchor of its heading."""
        kept = "".join(letter if letter.isascii() and letter.isalnum() else " " for letter in self.name.lower())
        return "-".join(kept.split())


@dataclass(frozen=True)
class Group:
    """Faults of one kind, on a page: its file's name, its title and what they have in common."""

    name: str
    title: str
    introduction: str
    faults: tuple[Fault, ...]
