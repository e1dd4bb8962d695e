"""The text of a drafted campaign file."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from colonnade.campaign.campaign import SCHEMA
from colonnade.campaign.channel import MAIN
from colonnade.campaign.draft.channels import DraftChannels
from colonnade.campaign.draft.groups import MOST_SETUPS, explained, group
from colonnade.campaign.draft.kinds import kind_lines, largest_spreads, linked
from colonnade.campaign.draft.layout import DraftSetup, DraftTest, names_of
from colonnade.campaign.draft.lines import Line, comment, key, value
from colonnade.campaign.draft.naming import unique
from colonnade.campaign.draft.survey import RawFile
from colonnade.campaign.draft.vocabulary import SHAPES, find, words

_SIZES = {
    "prism": {
        "width": "along x, the direction of shaking",
        "depth": "along y, across the shaking",
        "height": "along z",
    },
    "cylinder": {"diameter": "", "height": ""},
    "cone": {"base_diameter": "of the base circle", "top_diameter": "", "height": ""},
}


@dataclass(frozen=True)
class Draft:
    """Lines of the file, each a key or plain text."""

    lines: tuple[Line | str, ...]

    @property
    def text(self) -> str:
        """The file."""
        return "\n".join(line.text() if isinstance(line, Line) else line for line in self.lines) + "\n"


@dataclass(frozen=True)
class _NamedSetup:
    name: str
    setup: DraftSetup
    drafted: DraftChannels


def write(
    name: str, setups: Sequence[DraftSetup], copies: Sequence[tuple[str, str]], refused: Sequence[tuple[str, str]]
) -> Draft:
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
    named = list(_named(setups))
    tests = [test for setup in setups for test in setup.tests]
    specimens = _specimens(tests)
    of_setup = _tests(named, dict(zip(map(id, tests), specimens, strict=True)))
    described = [line for specimen, shape in dict.fromkeys(specimens) for line in _specimen(specimen, shape)]
    asks_first = len(setups) > MOST_SETUPS
    lines: list[Line | str] = [
        comment("Drafted by `colonnade init` from the raw files. The text after each # says why a value was chosen."),
        comment('Fill in each "?" in a value before the first run; check each guess that is marked "# ?".'),
        comment("`colonnade check` lists what is still open, with its line."),
        Line("schema", str(SCHEMA)),
        Line("campaign", value(name), "from the name of the folder"),
        Line("title", value(f"Campaign {name}"), "title of the report; write a better one"),
        comment('facility = "…"         the laboratory and its table'),
    ]
    if asks_first:
        lines += explained(len(named), sum(len(test.files) for test in tests))
        for number, each in enumerate(named, start=1):
            formats = {test.main.format for test in each.setup.tests}
            lines += group(
                f"{number} of {len(named)}", _some(each.setup), formats.pop(), [*_described(each), *of_setup[each.name]]
            )
        lines += ["", comment("==== For all groups"), *described]
    else:
        lines += described
        for each in named:
            lines += _setup(each)
        for each in named:
            lines += of_setup[each.name]
    if copies or refused:
        lines += ["", comment("Files that are not used:")]
        lines += [comment(f"{file}: the same columns as {taken}, so it is treated as a copy") for file, taken in copies]
        lines += [comment(f"{file}: {reason}") for file, reason in refused]
    return Draft(tuple(lines))


def _named(setups: Sequence[DraftSetup]) -> Iterator[_NamedSetup]:
    """Setups with names and channels; a channel of an earlier setup too is asked about with a hint at that one."""
    first: dict[str, str] = {}
    for number, setup in enumerate(setups, start=1):
        name = "setup" if len(setups) == 1 else f"setup-{number}"
        asked: set[str] = set()
        channels = []
        for channel in setup.drafted.channels:
            lines = [_briefly(line, asked) for line in channel.lines]
            if channel.id in first and not channel.id.startswith("column_"):
                lines = [_asked(line, f"perhaps as in {first[channel.id]}") for line in lines]
            channels.append(replace(channel, lines=tuple(lines)))
            first.setdefault(channel.id, name)
        yield _NamedSetup(name, setup, replace(setup.drafted, channels=tuple(channels)))


def _specimens(tests: Sequence[DraftTest]) -> list[tuple[str, str]]:
    """Specimen of each test, and its shape, if file names show them; one for all other tests."""
    found = [find(words(test.main.stem), SHAPES) for test in tests]
    return [(each[0], each[0]) if each else ("specimen", "") for each in found]


def _specimen(name: str, shape: str) -> list[Line | str]:
    others = (
        'or "cylinder" (diameter, height), "cone" (base_diameter, top_diameter, height), "measured" (critical_angle, '
    )
    others += "pole_distance, inertia)"
    first = Line("shape", value(shape), "from the names of files") if shape else Line("shape", '"prism"', "", others)
    sizes = [
        Line(size, value("? mm"), question=said or f"its {size.replace('_', ' ')}")
        for size, said in _SIZES[shape or "prism"].items()
    ]
    return ["", f"[specimens.{key(name)}]", first, *sizes, Line("mass", value("? kg"), question="weighed")]


def _setup(named: _NamedSetup) -> list[Line | str]:
    setup = named.setup
    count = "1 test" if len(setup.tests) == 1 else f"{len(setup.tests)} tests, all recorded in the same way"
    return ["", comment(f"The set-up of {count}: {_some(setup)}"), *_described(named)]


def _described(named: _NamedSetup) -> list[Line | str]:
    """Lines of a set-up: its recorders, its channels, and what is left out."""
    setup, drafted = named.setup, named.drafted
    lines: list[Line | str] = [f"[setups.{key(named.name)}]"]
    lines += _recorder_lines(setup, MAIN)
    lines.append(comment('catch = "0.3 rad"      the rotation at which a safety frame catches the specimen'))
    for recorder in setup.recorders[1:]:
        pair = linked(drafted.channels, recorder)
        lines += ["", f"[setups.{key(named.name)}.recorders.{key(recorder)}]", *_recorder_lines(setup, recorder)]
        if pair:
            reason = "both record the table's motion, which shows how late it started"
            lines.append(Line("clock", value({"align": list(pair)}), reason, '"trigger" if both start together'))
        else:
            either = 'or {align = ["a channel of main", "a channel of this one that measures the same"]}'
            lines.append(Line("clock", '"trigger"', "", either))
    lines += [
        "",
        comment("A channel may also have offset, range and delay; `colonnade schema campaign` lists all keys."),
    ]
    for channel in drafted.channels:
        lines += ["", f"[setups.{key(named.name)}.channels.{key(channel.id)}]", *channel.lines]
    return lines + _left_out(drafted)


def _some(setup: DraftSetup) -> str:
    files = [test.main.relative for test in setup.tests]
    return ", ".join(files[:3]) + (f" … {files[-1]}" if len(files) > 3 else "")


def _recorder_lines(setup: DraftSetup, recorder: str) -> list[Line]:
    files = [test.files[recorder] for test in setup.tests]
    lines = [Line("file", value({"format": files[0].format}), "recognised; the rest is detected")]
    if not any(column.has_clock for column in files[0].columns):
        lines.append(Line("sampling_rate", value("? Hz"), question="no time column found: give the samples per second"))
    return lines


def _left_out(drafted: DraftChannels) -> list[Line | str]:
    if not drafted.left_out:
        return []
    by_reason: dict[str, list[str]] = {}
    for _, heading, reason in drafted.left_out:
        by_reason.setdefault(reason, []).append(f'"{heading}"')
    lines: list[Line | str] = [
        "",
        comment("Columns that are left out; to use one, add a table like those above:"),
    ]
    for reason, headings in by_reason.items():
        some = ", ".join(headings[:4]) + (f" … {headings[-1]}" if len(headings) > 4 else "")
        lines.append(comment(f"  {some}: {reason}"))
    return lines


def _tests(named: Sequence[_NamedSetup], specimens: dict[int, tuple[str, str]]) -> dict[str, list[Line | str]]:
    """Lines of the tests of each set-up."""
    tests = [(each, test) for each in named for test in each.setup.tests]
    ids = unique(names_of(test for _, test in tests), "test")
    largest = {each.name: largest_spreads(each.setup.tests, each.drafted.channels) for each in named}
    asked: set[str] = set()
    lines: dict[str, list[Line | str]] = {each.name: [] for each in named}
    for name, (each, test) in zip(ids, tests, strict=True):
        channels = each.drafted.channels
        paths = {recorder: file.relative for recorder, file in test.files.items()}
        file = test.main
        rate = f"{file.rate:.6g} Hz, {file.duration:.4g} s" if file.rate and file.duration else ""
        lines[each.name] += [
            "",
            "[[tests]]",
            Line("id", value(name)),
            *(_briefly(line, asked) for line in kind_lines(test, channels, largest[each.name])),
            Line("specimen", value(specimens[id(test)][0])),
            Line("setup", value(each.name)),
            Line("file", value(paths[MAIN] if len(paths) == 1 else paths), rate),
            *_who_and_when(file, is_first=not lines[each.name]),
            *(comment(f"the file: {warning}") for warning in file.warnings[:3]),
        ]
    return lines


def _who_and_when(file: RawFile, *, is_first: bool) -> list[Line | str]:
    """Give the day in the file and, once, the keys that no file contains."""
    known = [Line("date", file.day.isoformat(), "from the file's own time")] if file.day else []
    asked = [comment('operator = "…"         who ran it; also photos = ["photos/….jpg"]')] if is_first else []
    return [*known, *([] if known or not is_first else [comment("date = 2013-04-26")]), *asked]


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
