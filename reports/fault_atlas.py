"""Plant every fault, keep what colonnade prints, and write docs/faults/: `python reports/fault_atlas.py [FOLDER]`."""

from __future__ import annotations

import difflib
import re
import shutil
import sys
import tempfile
from pathlib import Path

import study
from colonnade.figures.files.output import to_svg
from faults.believed import COURSE, SCALES
from faults.fault import Fault, Group
from faults.pictures import draw
from faults.recorded import CLOCKS, SAMPLES
from faults.sound import findings, keep_only, write_sound
from faults.unseen import UNSEEN, effect
from faults.unseen import page as unseen_page

GROUPS = (SCALES, CLOCKS, SAMPLES, COURSE)

FAULTS: dict[str, Fault] = {fault.slug: fault for group in GROUPS for fault in group.faults}


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


DOCUMENTS = Path(__file__).resolve().parents[1] / "docs" / "faults"
MARKS = "<!-- measured: begin -->", "<!-- measured: end -->"


def planted(fault: Fault, sound: Path, folder: Path) -> Path:
    """Copy the test of a fault from the sound campaign, and plant the fault; `folder` has to be new."""
    shutil.copytree(sound, folder)
    keep_only(fault.test, folder)
    fault.plant(folder)
    return folder


def rebuild(documents: Path) -> None:
    """Write pages, pictures and the table of the index."""
    (documents / "pictures").mkdir(parents=True, exist_ok=True)
    told: dict[str, str] = {}
    lines: dict[str, str] = {}
    with tempfile.TemporaryDirectory() as scratch:
        sound = Path(scratch) / "sound"
        write_sound(sound)
        for slug, fault in FAULTS.items():
            without, faulty = Path(scratch) / f"{slug}-without", planted(fault, sound, Path(scratch) / slug)
            shutil.copytree(sound, without)
            keep_only(fault.test, without)
            drawn = to_svg(
                draw(fault.picture, without, faulty), identity=slug, title=fault.name, description=fault.picture.shows
            )
            (documents / "pictures" / f"{slug}.svg").write_text(drawn, encoding="utf-8")
            told[slug] = findings(fault.command, faulty)
            lines[slug] = ""
            if fault.mending is not None:
                mended = shutil.copytree(faulty, Path(scratch) / f"{slug}-mended")
                fault.mending(mended)
                lines[slug] = mending_lines(faulty, mended)
        effects = [
            (unseen, effect(unseen, shutil.copytree(sound, Path(scratch) / f"unseen-{number}")))
            for number, unseen in enumerate(UNSEEN)
        ]
        (documents / "not-found.md").write_text(unseen_page(effects), encoding="utf-8")
    for group in GROUPS:
        (documents / f"{group.name}.md").write_text(page(group, told, lines), encoding="utf-8")
    index = documents / "index.md"
    index.write_text(study.renewed(index.read_text(encoding="utf-8"), MARKS, table(told)), encoding="utf-8")


if __name__ == "__main__":
    rebuild(Path(sys.argv[1]) if len(sys.argv) > 1 else DOCUMENTS)
