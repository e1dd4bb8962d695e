"""What a planted fault is: how it comes about, what colonnade says, what mends it, what the picture shows."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from colonnade.arrays import Array
from faults.planting import Change


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
