"""
The pictures of the tutorial: the page is followed as a reader follows it, then its results are drawn.

`make reports` runs it; it needs a browser for the picture of the overview.
"""

from __future__ import annotations

import shutil
import sys
import tempfile
from io import BytesIO
from pathlib import Path

from PIL import Image
from playwright.sync_api import sync_playwright

PROJECT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(PROJECT / "tests" / "helpers"))

from page_blocks import Block, Reader  # noqa: E402

TUTORIAL = PROJECT / "docs" / "tutorial"
FIGURES = {
    "morning.md": {
        "free-1.svg": "angle morning free-1",
        "sine-3Hz.svg": "angle morning sine-3Hz",
        "quake-1.svg": "angle morning quake-1",
        "map.svg": "map morning prism",
    },
    "drums.md": {"drums-plan.svg": "plan . quake-1", "drums-joints.svg": "joints . quake-1"},
}
OVERVIEW = (1000, 1320)
"""Pixels of the picture of the overview."""
COLOURS = 128


def overview(page: Path) -> bytes:
    """Take a picture of the top of a page of the report, as PNG."""
    browsers = ("chromium", "chromium-browser", "google-chrome")
    executable = next(found for name in browsers if (found := shutil.which(name)))
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=executable, args=["--no-sandbox"])
        shown = browser.new_page(viewport={"width": OVERVIEW[0], "height": OVERVIEW[1]})
        shown.goto(page.as_uri())
        taken = shown.screenshot()
        browser.close()
    small = BytesIO()
    Image.open(BytesIO(taken)).convert("RGB").quantize(COLOURS).save(small, "PNG", optimize=True)
    return small.getvalue()


def main() -> None:
    """Follow the pages of the tutorial and draw."""
    for page, figures in FIGURES.items():
        with tempfile.TemporaryDirectory() as folder:
            reader = Reader(Path(folder))
            reader.follow(TUTORIAL / page)
            for name, asked in figures.items():
                reader.do(Block(name, "sh", f"colonnade figure {asked} --out {name}\n"))
                shutil.copy(reader.folder / name, TUTORIAL / name)
            if page == "morning.md":
                shutil.copy(reader.folder / "drawing.svg", TUTORIAL / "drawing.svg")
                (TUTORIAL / "overview.png").write_bytes(overview(reader.folder / "morning" / "report" / "index.html"))


if __name__ == "__main__":
    main()
