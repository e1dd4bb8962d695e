"""A draft of campaign.toml, guessed from a folder of raw files: its text, and what a person has to fill in or check."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from colonnade.campaign.campaign import SCHEMA
from colonnade.campaign.channel import MAIN
from colonnade.campaign.draft.guess import DraftSetup, arrange, kind_lines, names_of
from colonnade.campaign.draft.survey import RawFile, survey
from colonnade.campaign.draft.words import Line, as_id, comment, find, unique
from colonnade.campaign.loading import FILE_NAME
from colonnade.campaign.syntax.document import toml_key, toml_value
from colonnade.errors import CampaignError
from colonnade.readers.files import irregular

RAW_FOLDERS = ("raw", "data", "rohdaten", "dati", "daten")
"""Names of folders that say nothing about the campaign in them."""

MOST_TOLD = 5

MOST_SETUPS = 5
"""Largest usual number of ways of recording in one campaign; with more, most files are something else."""

KEPT = ("column", "recorder", "id", "kind", "frequency", "motion", "span", "specimen", "setup", "file")
"""Keys of a group that can stay before it is known whether it is needed."""

PUBLISHED = ("cosmos", "peer")
"""Formats in which networks publish base motions."""

_SIZES = {
    "prism": {
        "width": "along x, the direction of shaking",
        "depth": "along y, across the shaking",
        "height": "along z",
    },
    "cylinder": {"diameter": "its diameter", "height": "its height"},
    "cone": {"base_diameter": "of the base circle", "top_diameter": "its top diameter", "height": "its height"},
}
_SHAPES = (
    'or "cylinder" (diameter, height), "cone" (base_diameter, top_diameter, height), "measured" (critical_angle, '
    "pole_distance, inertia)"
)
_FIRST_LINES = (
    comment("Drafted by `colonnade init` from the raw files. The text after each # says why a value was chosen."),
    comment('Fill in each "?" in a value before the first run; check each guess that is marked "# ?".'),
    comment("`colonnade check` lists what is still open, with its line."),
)
_GROUPED = (
    comment(
        'Each group asks this once, at format = "?". If they are recordings: replace "?" by the format named after it,'
    ),
    comment("and remove the # from the lines that you need. Until then the channels are kept as recorded."),
    comment("If they are not: delete the group, from its line with ==== to the next one."),
)

Lines = list[Line | str]


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
    folder = _expected(folder)
    files, refused = survey(folder, progress)
    if not files:
        raise CampaignError("\n".join([f"{folder}: no readable recording found.", *_told(refused)]))
    arranged, copies = arrange(files)
    setups = [setup for setup in arranged if setup.drafted.channels]
    refused += [each for setup in arranged if not setup.drafted.channels for each in _without_channels(setup)]
    if not setups:
        raise CampaignError("\n".join([f"{folder}: no file has a column that measures anything.", *_told(refused)]))
    home = folder.parent if folder.name.casefold() in RAW_FOLDERS else folder
    lines = written(as_id(home.name, "campaign"), setups, copies, refused)
    asked = list(_questions(lines))
    return CampaignDraft(
        folder / FILE_NAME,
        text_of(lines),
        sum(len(setup.tests) for setup in setups),
        len(setups),
        tuple(each for each in asked if each.is_open),
        tuple(each for each in asked if not each.is_open),
        tuple(refused),
        asks_first=len(setups) > MOST_SETUPS,
    )


def _expected(folder: Path) -> Path:
    try:
        folder = folder.resolve()
    except (OSError, RuntimeError, ValueError) as error:
        raise CampaignError(f"{folder}: invalid path ({error}). Name the folder with the raw files.") from None
    if not folder.is_dir():
        kind = irregular(folder)
        found = f"this is {kind}" if kind else "folder not found"
        raise CampaignError(f"{folder}: {found}. Name the folder with the raw files.")
    path = folder / FILE_NAME
    if path.exists() or path.is_symlink():
        raise CampaignError(
            f"{path}: it exists already and was not changed. To draft another one, move or rename it first. To "
            "continue with it, run `colonnade check`."
        )
    return folder


def _told(refused: Sequence[tuple[str, str]]) -> list[str]:
    lines = [f"  {name}: {reason}" for name, reason in refused[:MOST_TOLD]]
    if len(refused) > MOST_TOLD:
        lines.append(f"  and {len(refused) - MOST_TOLD} more")
    return lines or ["  It contains only documents. Name the folder with the raw files."]


def _without_channels(setup: DraftSetup) -> Iterator[tuple[str, str]]:
    reasons = "; ".join(f'"{heading}": {reason}' for _, heading, reason in setup.drafted.left_out[:MOST_TOLD])
    for test in setup.tests:
        for file in test.files.values():
            yield file.relative, f"none of its columns measures anything ({reasons})"


def _questions(lines: Lines) -> Iterator[Question]:
    section = ""
    for number, line in enumerate(lines, start=1):
        if isinstance(line, Line):
            section = f"tests[{line.value.strip(chr(34))}]" if section == "tests" and line.key == "id" else section
            if line.question:
                yield Question(number, f"{section}.{line.key}".lstrip("."), line.value, line.question)
        elif line.startswith("["):
            section = line.strip("[]")


def text_of(lines: Lines) -> str:
    """Write the file."""
    return "\n".join(line.text() if isinstance(line, Line) else line for line in lines) + "\n"


def written(
    name: str, setups: Sequence[DraftSetup], copies: Sequence[tuple[str, str]], refused: Sequence[tuple[str, str]]
) -> Lines:
    """
    Write out what was found.

    Parameters
    ----------
    name : str
        Id of the campaign.
    setups : sequence of DraftSetup
    copies, refused : sequence of (str, str)
        Files that are left out, with the file that is used instead, or the reason.
    """
    _name(setups)
    tests = [test for setup in setups for test in setup.tests]
    shapes = [found[0] if (found := find(test.main.stem, "shapes")) else "" for test in tests]
    of_setup = _tests(setups, shapes)
    specimens = [line for shape in dict.fromkeys(shapes) for line in _specimen(shape)]
    lines: Lines = [
        *_FIRST_LINES,
        Line("schema", str(SCHEMA)),
        Line("campaign", toml_value(name), "from the name of the folder"),
        Line("title", toml_value(f"Campaign {name}"), "title of the report; write a better one"),
        comment('facility = "…"         the laboratory and its table'),
    ]
    if len(setups) > MOST_SETUPS:
        files = sum(len(test.files) for test in tests)
        asked = (
            f"{files} files of {len(setups)} kinds were found. The first question is: which are recordings of tests?"
        )
        lines += ["", comment(asked), *_GROUPED]
        for number, setup in enumerate(setups, start=1):
            described = [*_described(setup), *of_setup[setup.name]]
            lines += _group(f"{number} of {len(setups)}: {_some(setup)}", setup, described)
        lines += ["", comment("==== For all groups"), *specimens]
    else:
        lines += specimens
        for setup in setups:
            how_many = "1 test" if len(setup.tests) == 1 else f"{len(setup.tests)} tests, all recorded in the same way"
            lines += ["", comment(f"The set-up of {how_many}: {_some(setup)}"), *_described(setup)]
        lines += [line for setup in setups for line in of_setup[setup.name]]
    if copies or refused:
        lines += ["", comment("Files that are not used:")]
        lines += [comment(f"{file}: the same columns as {taken}, so it is treated as a copy") for file, taken in copies]
        lines += [comment(f"{file}: {reason}") for file, reason in refused]
    return lines


def _name(setups: Sequence[DraftSetup]) -> None:
    """Name the setups; a channel that an earlier one has too is asked about with a hint at that one."""
    first: dict[str, str] = {}
    for number, setup in enumerate(setups, start=1):
        setup.name = "setup" if len(setups) == 1 else f"setup-{number}"
        asked: set[str] = set()
        channels = []
        for channel in setup.drafted.channels:
            lines = [_briefly(line, asked) for line in channel.lines]
            if channel.id in first and not channel.id.startswith("column_"):
                lines = [_asked(line, f"perhaps as in {first[channel.id]}") for line in lines]
            channels.append(replace(channel, lines=tuple(lines)))
            first.setdefault(channel.id, setup.name)
        setup.drafted = replace(setup.drafted, channels=tuple(channels))


def _specimen(shape: str) -> Lines:
    first = (
        Line("shape", toml_value(shape), "from the names of files") if shape else Line("shape", '"prism"', "", _SHAPES)
    )
    sizes = [Line(size, toml_value("? mm"), question=said) for size, said in _SIZES[shape or "prism"].items()]
    return ["", f"[specimens.{shape or 'specimen'}]", first, *sizes, Line("mass", '"? kg"', question="weighed")]


def _described(setup: DraftSetup) -> Lines:
    """Lines of a set-up: its recorders, its channels, and what is left out."""
    drafted, place = setup.drafted, f"setups.{toml_key(setup.name)}"
    lines: Lines = [f"[{place}]", *_recorder_lines(setup, MAIN)]
    lines.append(comment('catch = "0.3 rad"      the rotation at which a safety frame catches the specimen'))
    table = {
        each.recorder: each.id
        for each in reversed(drafted.channels)
        if each.meaning.is_of_table and each.meaning.axis in (None, "x")
    }
    for recorder in setup.recorders[1:]:
        lines += ["", f"[{place}.recorders.{toml_key(recorder)}]", *_recorder_lines(setup, recorder)]
        if {MAIN, recorder} <= table.keys():
            reason = "both record the table's motion, which shows how late it started"
            align = toml_value({"align": [table[MAIN], table[recorder]]})
            lines.append(Line("clock", align, reason, '"trigger" if both start together'))
        else:
            either = 'or {align = ["a channel of main", "a channel of this one that measures the same"]}'
            lines.append(Line("clock", '"trigger"', "", either))
    note = "A channel may also have offset, range and delay; `colonnade schema campaign` lists all keys."
    lines += ["", comment(note)]
    for channel in drafted.channels:
        lines += ["", f"[{place}.channels.{toml_key(channel.id)}]", *channel.lines]
    if drafted.left_out:
        lines += ["", comment("Columns that are left out; to use one, add a table like those above:")]
    for reason in dict.fromkeys(reason for _, _, reason in drafted.left_out):
        headings = [f'"{heading}"' for _, heading, own in drafted.left_out if own == reason]
        some = ", ".join(headings[:4]) + (f" … {headings[-1]}" if len(headings) > 4 else "")
        lines.append(comment(f"  {some}: {reason}"))
    return lines


def _recorder_lines(setup: DraftSetup, recorder: str) -> Lines:
    file = setup.tests[0].files[recorder]
    lines: Lines = [Line("file", toml_value({"format": file.format}), "recognised; the rest is detected")]
    if not any(column.has_clock for column in file.columns):
        lines.append(Line("sampling_rate", '"? Hz"', question="no time column found: give the samples per second"))
    return lines


def _some(setup: DraftSetup) -> str:
    files = [test.main.relative for test in setup.tests]
    return ", ".join(files[:3]) + (f" … {files[-1]}" if len(files) > 3 else "")


def _group(title: str, setup: DraftSetup, lines: Lines) -> Lines:
    """
    Turn the draft of a set-up and its tests into a group that asks one question: whether they are recordings of tests.

    Its channels are kept as recorded; what else is known or asked about them is there as a comment.
    """
    form = setup.tests[0].main.format
    asked = f"recordings of tests ({_some(setup)})? Then {toml_value({'format': form})}; if not, delete this group"
    kept: Lines = ["", comment(f"==== Group {title}")]
    if form in PUBLISHED:
        kept.append(
            comment('In a format of seismic networks: a base motion belongs under [motions], "its name" = "its file"')
        )
    for line in lines:
        if isinstance(line, str):
            kept.append(line)
        elif line.key == "file" and asked:
            kept.append(Line("file", toml_value({"format": "?"}), question=asked))
            asked = ""
        elif line.key == "quantity":
            guess = f"or {line.value}, {line.reason}, with the lines below".replace(", ,", ",")
            kept.append(Line("quantity", '"other"', "" if "?" in line.value else guess))
        else:
            kept.append(line if line.key in KEPT else comment(line.text()))
    return kept


def _tests(setups: Sequence[DraftSetup], shapes: Sequence[str]) -> dict[str, Lines]:
    """Lines of the tests of each set-up."""
    tests = [(setup, test) for setup in setups for test in setup.tests]
    ids = unique(names_of(test for _, test in tests), "test")
    asked: set[str] = set()
    lines: dict[str, Lines] = {setup.name: [] for setup in setups}
    for name, shape, (setup, test) in zip(ids, shapes, tests, strict=True):
        paths = {recorder: file.relative for recorder, file in test.files.items()}
        file = test.main
        rate = f"{file.rate:.6g} Hz, {file.duration:.4g} s" if file.rate and file.duration else ""
        lines[setup.name] += [
            "",
            "[[tests]]",
            Line("id", toml_value(name)),
            *(_briefly(line, asked) for line in kind_lines(test, setup.drafted.channels, setup.tests)),
            Line("specimen", toml_value(shape or "specimen")),
            Line("setup", toml_value(setup.name)),
            Line("file", toml_value(paths[MAIN] if len(paths) == 1 else paths), rate),
            *_who_and_when(file, is_first=not lines[setup.name]),
            *(comment(f"the file: {warning}") for warning in file.warnings[:3]),
        ]
    return lines


def _who_and_when(file: RawFile, *, is_first: bool) -> Iterator[Line | str]:
    """Give the day in the file and, once, the keys that no file contains."""
    if file.day:
        yield Line("date", file.day.isoformat(), "from the file's own time")
    elif is_first:
        yield comment("date = 2013-04-26")
    if is_first:
        yield comment('operator = "…"         who ran it; also photos = ["photos/….jpg"]')


def _briefly(line: Line | str, asked: set[str]) -> Line | str:
    """Ask in full once only."""
    question = line.question if isinstance(line, Line) else ""
    if question in asked:
        return _asked(line, "as above")
    asked.add(question)
    return line


def _asked(line: Line | str, question: str) -> Line | str:
    """Return a line with another question, if it asks one."""
    return replace(line, question=question) if isinstance(line, Line) and line.question else line
