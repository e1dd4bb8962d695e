"""The pages of the atlas: a page a group, and the table of all faults."""

from __future__ import annotations

import difflib
import re
from pathlib import Path

import study
from faults.fault import Fault, Group
from faults.registry import GROUPS


def page(group: Group, told: dict[str, str], lines: dict[str, str]) -> str:
    """Write the page of a group; `told` and `lines` are what was printed and what mends it, by fault."""
    parts = [f"# {group.title}", group.introduction]
    for fault in group.faults:
        parts += [f"## {fault.name}", *_section(fault, told[fault.slug], lines[fault.slug])]
    return "\n\n".join(parts) + "\n"


def _section(fault: Fault, told: str, lines: str) -> list[str]:
    stays = " The message stays, as the recording is what it is." if fault.stays else ""
    return [
        fault.happens,
        f"![{fault.picture.shows}](pictures/{fault.slug}.svg)",
        f"*{fault.picture.shows}*",
        f"`colonnade {fault.command}` says:",
        f"```text\n{told}\n```",
        f"**Mend.** {fault.mend}{stays}",
        *([lines] if lines else []),
    ]


def mending_lines(before: Path, after: Path) -> str:
    """Write what differs between two campaigns: the new lines of campaign.toml, and review.toml as a whole."""
    parts = []
    one, other = ((folder / "campaign.toml").read_text(encoding="utf-8").splitlines() for folder in (before, after))
    changed, heading, written = [], [""], [""]
    for line in difflib.ndiff(one, other):
        if line[:2] not in ("  ", "+ ") or not line[2:]:
            continue
        if line[2] == "[":
            heading = [line[2:].split("#")[0].rstrip()]
        if heading[0] == "[[tests]]" and line.startswith("  id ="):
            heading = ["[[tests]]", line[2:]]
        if line[0] == "+":
            changed += heading if heading not in (written, [line[2:]]) else []
            changed.append(line[2:])
            written = heading
    if changed:
        parts += ["In `campaign.toml`:", _toml("\n".join(changed))]
    review = after / "review.toml"
    if review.exists():
        parts += ["In `review.toml`:", _toml(review.read_text(encoding="utf-8").rstrip())]
    return "\n\n".join(parts)


def _toml(text: str) -> str:
    return f"```toml\n{text}\n```"


def table(told: dict[str, str]) -> str:
    """Write the table of all faults, with the finding that names each."""
    rows = []
    for group in GROUPS:
        for fault in group.faults:
            line = next(line for line in told[fault.slug].splitlines() if re.search(fault.message, line, re.IGNORECASE))
            rows.append((f"[{fault.name}]({group.name}.md#{fault.slug})", line.split(": ")[0], f"`{fault.command}`"))
    return study.table(("fault", "finding", "found by"), rows)
