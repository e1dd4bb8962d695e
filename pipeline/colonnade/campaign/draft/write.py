"""A draft of campaign.toml, guessed from a folder of raw files: its text, and what a person has to fill in or check."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from operator import attrgetter
from pathlib import Path, PurePosixPath

from colonnade.campaign.channel import MAIN
from colonnade.campaign.draft.guess import channel_lines, draft_channels, kind_lines, marker_lines, markers_of
from colonnade.campaign.draft.survey import Files, arrange, survey
from colonnade.campaign.draft.words import AXES, asked, comment, line, unique
from colonnade.campaign.loading import FILE_NAME
from colonnade.campaign.setup import Recorder, Tracking
from colonnade.campaign.specimen import Prism, Specimen
from colonnade.campaign.syntax.document import toml_key
from colonnade.errors import CampaignError, count, quoted
from colonnade.units.text import listed

MOST_TOLD = 5

_FIRST_LINES = (
    comment("Drafted by `colonnade init` from the raw files. The text after each # says why a value was chosen."),
    comment('Fill in each "?" in a value before the first run; check each guess that is marked "# ?".'),
    comment("`colonnade check` lists what is still open, with its line; `colonnade schema campaign` lists all keys."),
)
_SPECIMEN = (
    "",
    "[specimens.specimen]",
    asked(Specimen, "shape", "prism"),
    *(asked(Prism, size, "? mm") for size in ("width", "depth", "height")),
    asked(Prism, "mass", "? kg"),
)
_TRACKING = (asked(Tracking, "axes", list(AXES.values())), asked(Tracking, "relative_to", "?"))
_QUESTION = re.compile(r"[a-z_]+ = (.*)    # \? .*")


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
    open : tuple of int
        Lines, from 1, with a value that has to be filled in.
    doubts : int
        How many guesses have to be checked.
    refused : tuple of (str, str)
        Files that are not used, with the reason.
    """

    path: Path
    text: str
    tests: int
    setups: int
    open: tuple[int, ...]
    doubts: int
    refused: tuple[tuple[str, str], ...]


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
    folder = _expected(folder)
    files, refused = survey(folder, progress)
    arranged, copies = arrange(files)
    refused += copies
    setups = [DraftSetup(tests) for tests in arranged]
    for each in setups:
        files = [] if each.channels else [file for test in each.tests for file in test.values()]
        refused += [(file.relative, f"no column measures anything: {'; '.join(each.left_out)}") for file in files]
    setups = [each for each in setups if each.channels]
    for number, each in enumerate(setups, start=1):
        each.name = "setup" if len(setups) == 1 else f"setup-{number}"
    if not setups:
        told = [f"  {name}: {reason}" for name, reason in refused[:MOST_TOLD]]
        told = told or ["  It contains only documents. Name the folder with the raw files."]
        raise CampaignError("\n".join([f"{folder}: no readable recording found.", *told]))
    lines = written(unique([folder.name], "campaign")[0], setups, refused)
    asked = [(number, each[1]) for number, each in enumerate(map(_QUESTION.fullmatch, lines), start=1) if each]
    open_lines = tuple(number for number, value in asked if "?" in value)
    return CampaignDraft(
        folder / FILE_NAME,
        "\n".join([*lines, ""]),
        sum(len(each.tests) for each in setups),
        len(setups),
        open_lines,
        len(asked) - len(open_lines),
        tuple(refused),
    )


def _expected(folder: Path) -> Path:
    folder = Path(os.path.realpath(folder))
    if not folder.is_dir():
        raise CampaignError(f"{folder}: no folder of this name was found. Name the folder with the raw files.")
    path = folder / FILE_NAME
    if path.exists() or path.is_symlink():
        raise CampaignError(
            f"{path}: it exists already and was not changed. To draft another one, move or rename it first. To "
            "continue with it, run `colonnade check`."
        )
    return folder


def written(name: str, setups: Sequence[DraftSetup], refused: Sequence[tuple[str, str]]) -> list[str]:
    """Write out what was found, and the files that are left out with the reason."""
    ids = iter(unique((PurePosixPath(test[MAIN].stem).name for each in setups for test in each.tests), "test"))
    lines = [
        *_FIRST_LINES,
        line("schema", 1),
        line("campaign", name, "from the name of the folder"),
        line("title", f"Campaign {name}", "title of the report; write a better one"),
        comment('facility = "…"         the laboratory and its table'),
        *_SPECIMEN,
    ]
    for each in setups:
        some = listed([test[MAIN].relative for test in each.tests], 3)
        how_many = count(len(each.tests), "test", "tests, all recorded in the same way")
        lines += ["", comment(f"The set-up of {how_many}: {some}"), *each.lines()]
        for test in each.tests:
            lines += each.test(test, next(ids))
    if refused:
        lines += ["", comment("Files that are not used:"), *(comment(f"{file}: {why}") for file, why in refused)]
    return lines


class DraftSetup:
    """Tests that were recorded in the same way, their channels, and the other columns by the reason."""

    def __init__(self, tests: list[Files]) -> None:
        self.name, self.tests = "setup", tests
        columns = {recorder: [test[recorder].columns for test in tests] for recorder in tests[0]}
        # Each column is as it is in the file where it moves most.
        self.columns = {
            recorder: [max(alike, key=attrgetter("spread")) for alike in zip(*each, strict=True)]
            for recorder, each in columns.items()
        }
        self.channels, self.left_out = draft_channels(self.columns)
        self.markers = markers_of(self.channels.values())

    def lines(self) -> list[str]:
        """Give its recorders, its channels, and what is left out."""
        place = f"setups.{toml_key(self.name)}"
        lines = [f"[{place}]", *self._recorder(MAIN)]
        lines.append(comment('catch = "0.3 rad"      the rotation at which a safety frame catches the specimen'))
        for recorder in list(self.tests[0])[1:]:
            lines += ["", f"[{place}.recorders.{toml_key(recorder)}]", *self._recorder(recorder)]
            lines.append(asked(Recorder, "clock", "?"))
        tracked = [each for marker in self.markers.values() for each in marker]
        for name, channel in self.channels.items():
            if channel not in tracked:
                lines += ["", f"[{place}.channels.{toml_key(name)}]"]
                lines += channel_lines(channel, self.columns[channel.recorder])
        if self.markers:
            lines += ["", f"[{place}.tracking]", *_TRACKING]
        for name, marker in self.markers.items():
            lines += ["", f"[{place}.markers.{toml_key(name)}]"]
            lines += marker_lines(marker, self.columns[marker[0].recorder])
        if self.left_out:
            lines += ["", comment("Columns that are left out; to use one, add a table like those above:")]
        for reason, headings in self.left_out.items():
            lines.append(comment(f"  {listed(list(map(quoted, headings)), MOST_TOLD)}: {reason}"))
        return lines

    def _recorder(self, recorder: str) -> list[str]:
        file = self.tests[0][recorder]
        lines = [line("file", {"format": file.format}, "recognised; the rest is detected")]
        if not any(column.has_clock for column in file.columns):
            lines.append(line("sampling_rate", "? Hz", question="no time column found: give the samples per second"))
        return lines

    def test(self, test: Files, name: str) -> list[str]:
        """Give the entry of a test."""
        paths = {recorder: file.relative for recorder, file in test.items()}
        return [
            *("", "[[tests]]"),
            line("id", name),
            *kind_lines(PurePosixPath(test[MAIN].stem).name),
            line("specimen", "specimen"),
            line("setup", self.name),
            line("file", paths if len(paths) > 1 else paths[MAIN]),
        ]
