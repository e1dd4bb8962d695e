"""Reproduce the paper on the virtual shake table: `python reports/reproduce.py [--campaign DIR] [--folder DIR]`."""

from __future__ import annotations

import argparse
import json
import os
from pathlib import Path

os.environ.setdefault("OMP_NUM_THREADS", "1")

from colonnade.store.files import write_text
from reproduction.campaign import perform
from reproduction.drawings import drawn
from reproduction.pages import pages
from reproduction.results import Found, Numbers, gather, read
from reproduction.statements import answers
from study import HERE, write_numbers

FOLDER = HERE / "manos"
CAMPAIGN = HERE.parent / "build" / "reproduce"


def write(numbers: Numbers, folder: Path) -> None:
    """Write numbers, with the answers that follow from them, and pages."""
    folder.mkdir(parents=True, exist_ok=True)
    answered = {name: {"verdict": each.verdict, "ours": each.ours} for name, each in answers(numbers).items()}
    write_numbers(folder / "results.json", numbers | {"answers": answered})
    for name, page in pages(numbers).items():
        write_text(folder / name, page)


def draw(found: Found, folder: Path) -> None:
    """Write the figures."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, svg in drawn(found):
        write_text(folder / name, svg + "\n")


def main() -> None:
    """Run what is out of date of the campaign, and write numbers, figures and pages."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--campaign", type=Path, default=CAMPAIGN, help="folder of the virtual campaign")
    parser.add_argument("--folder", type=Path, default=FOLDER, help="where the pages go")
    parser.add_argument("--workers", type=int, default=None, help="processes; default one a core")
    told = parser.parse_args()
    found = read(perform(told.campaign, told.workers))
    kept = json.loads((FOLDER / "results.json").read_text(encoding="utf-8"))
    write(gather(found, kept), told.folder)
    draw(found, told.folder)


if __name__ == "__main__":
    main()
