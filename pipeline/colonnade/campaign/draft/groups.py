"""A folder with files of many kinds: the draft first asks which of them are recordings of tests."""

from __future__ import annotations

from collections.abc import Sequence

from colonnade.campaign.draft.lines import Line, comment, value

MOST_SETUPS = 5
"""Largest usual number of ways of recording in one campaign; with more, most files are something else."""

KEPT = ("column", "recorder", "id", "kind", "frequency", "motion", "span", "specimen", "setup", "file")
"""Keys of a group that can stay before it is known whether it is needed."""

PUBLISHED = ("cosmos", "peer")
"""Formats in which networks publish base motions."""


def explained(groups: int, files: int) -> list[Line | str]:
    """Write the comment above the groups: what is asked, and how to answer."""
    return [
        "",
        comment(f"{files} files of {groups} kinds were found. The first question is: which are recordings of tests?"),
        comment(
            'Each group asks this once, at format = "?". If they are recordings: replace "?" by the format named '
            "after it,"
        ),
        comment("and remove the # from the lines that you need. Until then the channels are kept as recorded."),
        comment("If they are not: delete the group, from its line with ==== to the next one."),
    ]


def group(number: str, files: str, format: str, lines: Sequence[Line | str]) -> list[Line | str]:
    """
    Turn the draft of a set-up and its tests into a group that asks one question.

    Parameters
    ----------
    number, files, format : str
        Number of the group and of all groups, the files in it, and their format.
    lines : sequence of Line or str
        Of the set-up, its channels and its tests.

    Returns
    -------
    lines : list of Line or str
        Its channels are kept as recorded; what else is known or asked about them is there as a comment.
    """
    asked = f"recordings of tests ({files})? Then {value({'format': format})}; if not, delete this group"
    kept: list[Line | str] = ["", comment(f"==== Group {number}: {files}")]
    if format in PUBLISHED:
        kept.append(
            comment('In a format of seismic networks: a base motion belongs under [motions], "its name" = "its file"')
        )
    is_first = True
    for line in lines:
        if isinstance(line, str):
            kept.append(line)
        elif line.key == "file" and is_first:
            is_first = False
            kept.append(Line("file", value({"format": "?"}), question=asked))
        elif line.key == "quantity":
            guess = (
                "" if "?" in line.value else f"or {line.value}, {line.reason}, with the lines below".replace(", ,", ",")
            )
            kept.append(Line("quantity", value("other"), guess))
        elif line.key in KEPT:
            kept.append(line)
        else:
            kept.append(comment(line.text()))
    return kept
