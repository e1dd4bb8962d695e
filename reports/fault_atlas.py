"""Plant every fault, keep what colonnade prints, and write docs/faults/: `python reports/fault_atlas.py [FOLDER]`."""

from __future__ import annotations

import re
import shutil
import sys
import tempfile
from pathlib import Path

from colonnade import figures
from faults.drawing import draw
from faults.fault import Fault
from faults.page import mending_lines, page, table
from faults.registry import FAULTS, GROUPS
from faults.sound import write_sound
from faults.told import findings, keep_only
from faults.unseen import UNSEEN, effect
from faults.unseen import page as unseen_page

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
            drawn = figures.to_svg(
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
    begin, end = MARKS
    inside = f"{begin}\n\n{table(told)}\n\n{end}"
    text = index.read_text(encoding="utf-8")
    index.write_text(re.sub(f"{begin}.*{end}", lambda _: inside, text, flags=re.DOTALL), encoding="utf-8")


if __name__ == "__main__":
    rebuild(Path(sys.argv[1]) if len(sys.argv) > 1 else DOCUMENTS)
