"""A draft of campaign.toml, guessed from a folder of raw files."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from colonnade.campaign.draft.groups import MOST_SETUPS
from colonnade.campaign.draft.layout import DraftSetup, arrange
from colonnade.campaign.draft.lines import Line
from colonnade.campaign.draft.naming import as_id
from colonnade.campaign.draft.survey import survey
from colonnade.campaign.draft.writing import Draft, write
from colonnade.campaign.loading import FILE_NAME
from colonnade.errors import CampaignError
from colonnade.readers.irregular import irregular

RAW_FOLDERS = ("raw", "data", "rohdaten", "dati", "daten")
"""Names of folders that say nothing about the campaign in them."""

MOST_TOLD = 5


@dataclass(frozen=True)
class Question:
    """A value that a person has to fill in or check: its line in the file, key, value and what is asked."""

    line: int
    key: str
    value: str
    asked: str

    @property
    def is_open(self) -> bool:
        """Whether the value has to be filled in."""
        return "?" in self.value


@dataclass(frozen=True)
class CampaignDraft:
    """
    A drafted campaign file.

    Attributes
    ----------
    path : Path
        Path to write it to.
    text : str
    tests, setups : int
        How many.
    open, doubts : tuple of Question
        What has to be filled in, and guesses to check.
    refused : tuple of (str, str)
        Files that are not used, with the reason.
    asks_first : bool
        Whether it asks of each kind of files whether they are recordings of tests, before anything else about them.
    """

    path: Path
    text: str
    tests: int
    setups: int
    open: tuple[Question, ...]
    doubts: tuple[Question, ...]
    refused: tuple[tuple[str, str], ...]
    asks_first: bool = False


def draft(folder: Path, progress: Callable[[int, int], None] | None = None) -> CampaignDraft:
    """
    Draft the campaign file of a folder; nothing is written.

    Parameters
    ----------
    folder : Path
        With the raw files, or with folders of them.
    progress : callable, optional
        Called with the number of files examined, and their total.

    Raises
    ------
    CampaignError
        If the folder does not exist, has a campaign file, or has no readable file.
    """
    try:
        folder = folder.resolve()
    except (OSError, RuntimeError, ValueError) as error:
        raise CampaignError(f"{folder}: invalid path ({error}). Name the folder with the raw files.") from None
    if (kind := irregular(folder)) and not folder.is_dir():
        raise CampaignError(f"{folder}: this is {kind}. Name the folder with the raw files.")
    if not folder.is_dir():
        raise CampaignError(f"{folder}: folder not found. Name the folder with the raw files.")
    path = folder / FILE_NAME
    if path.exists() or path.is_symlink():
        raise CampaignError(
            f"{path}: it exists already and was not changed. To draft another one, move or rename it first. To "
            "continue with it, run `colonnade check`."
        )
    found = survey(folder, progress)
    if not found.files:
        raise CampaignError("\n".join([f"{folder}: no readable recording found.", *_told(found.refused)]))
    arranged, copies = arrange(found.files)
    setups, empty = _with_channels(arranged)
    refused = (*found.refused, *empty)
    if not setups:
        raise CampaignError("\n".join([f"{folder}: no file has a column that measures anything.", *_told(refused)]))
    home = folder.parent if folder.name.casefold() in RAW_FOLDERS else folder
    written = write(as_id(home.name, "campaign"), setups, copies, refused)
    asked = list(_questions(written))
    return CampaignDraft(
        path,
        written.text,
        sum(len(setup.tests) for setup in setups),
        len(setups),
        tuple(each for each in asked if each.is_open),
        tuple(each for each in asked if not each.is_open),
        refused,
        asks_first=len(setups) > MOST_SETUPS,
    )


def _with_channels(setups: Sequence[DraftSetup]) -> tuple[list[DraftSetup], list[tuple[str, str]]]:
    """Keep the set-ups with a channel; give the files of the others with the reason."""
    kept: list[DraftSetup] = []
    empty = []
    for setup in setups:
        if setup.drafted.channels:
            kept.append(setup)
            continue
        reasons = "; ".join(f'"{heading}": {reason}' for _, heading, reason in setup.drafted.left_out[:MOST_TOLD])
        files = [file.relative for test in setup.tests for file in test.files.values()]
        empty += [(file, f"none of its columns measures anything ({reasons})") for file in files]
    return kept, empty


def _questions(written: Draft) -> Iterator[Question]:
    section = ""
    for number, line in enumerate(written.lines, start=1):
        if isinstance(line, Line):
            section = f"tests[{line.value.strip(chr(34))}]" if section == "tests" and line.key == "id" else section
            if line.question:
                yield Question(number, f"{section}.{line.key}".lstrip("."), line.value, line.question)
        elif line.startswith("["):
            section = line.strip("[]")


def _told(refused: tuple[tuple[str, str], ...]) -> list[str]:
    lines = [f"  {name}: {reason}" for name, reason in refused[:MOST_TOLD]]
    if len(refused) > MOST_TOLD:
        lines.append(f"  and {len(refused) - MOST_TOLD} more")
    return lines or ["  It contains only documents. Name the folder with the raw files."]
