"""The pages in a real browser: no script, no complaint, nothing wider than a telephone outside a box that scrolls."""

from __future__ import annotations

import re
import shutil
import struct
import subprocess
from pathlib import Path

import pytest

from colonnade.report.build import build
from colonnade.store.layout import Layout

BROWSER = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
QUIET = (
    *("--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--hide-scrollbars"),
    *("--disable-background-networking", "--disable-component-update", "--disable-sync"),
)
PAGES = (
    *("index.html", "quality.html", "problems.html", "methods.html", "specimens/prism.html"),
    *("tests/span-2.5.html", "tests/free-refused.html", "tests/sine-3hz-too-strong-for-the-block-1.html"),
)
# Measures the pages from outside: the report itself holds no script.
PROBE = """<script>
document.body.dataset.result = '';
for (const template of document.querySelectorAll('template')) {
  const frame = document.createElement('iframe');
  frame.style.cssText = 'width:%dpx;height:900px;border:0';
  frame.srcdoc = template.innerHTML;
  frame.onload = () => {
    const root = frame.contentDocument.documentElement;
    const outside = [...frame.contentDocument.querySelectorAll('body *')].filter(element =>
      !element.closest('.scroll') && element.getBoundingClientRect().right > root.clientWidth + 1);
    document.body.dataset.result += `${template.id} ${root.scrollWidth} ${root.clientWidth} ${outside.length};`;
  };
  document.body.append(frame);
}
</script>"""

pytestmark = pytest.mark.skipif(BROWSER is None, reason="no chromium on this machine: `apt-get install chromium`")


def browse(tmp_path: Path, page: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    command = [str(BROWSER), *QUIET, f"--user-data-dir={tmp_path / 'profile'}", *arguments, page.as_uri()]
    return subprocess.run(command, check=True, capture_output=True, text=True, timeout=120)


@pytest.fixture(scope="module")
def folder(filled_campaign, tmp_path_factory) -> Path:
    campaign, layout = filled_campaign[0], Layout(tmp_path_factory.mktemp("browsed"))
    shutil.copytree(filled_campaign[1].processed, layout.processed)
    return build(campaign, layout).parent


@pytest.mark.parametrize("width", [360, 1200], ids=["on a telephone", "on a desk"])
def test_only_boxes_that_scroll_are_wider_than_the_screen(folder, tmp_path, width):
    templates = [f'<template id="{page}">{(folder / page).read_text(encoding="utf-8")}</template>' for page in PAGES]
    probe = tmp_path / "probe.html"
    probe.write_text(f"<!DOCTYPE html><body>{''.join(templates)}{PROBE % width}</body>", encoding="utf-8")
    shown = browse(tmp_path, probe, "--virtual-time-budget=8000", "--dump-dom").stdout
    found = re.findall(r"([\w./-]+) (\d+) (\d+) (\d+);", shown)
    assert {page for page, *_ in found} == set(PAGES)
    for page, page_width, screen_width, outside in found:
        assert int(screen_width) == width
        assert int(page_width) <= width, page
        assert int(outside) == 0, page


def test_a_page_is_drawn_without_a_complaint(folder, tmp_path):
    picture = tmp_path / "page.png"
    browse(tmp_path, folder / "index.html", f"--screenshot={picture}", "--window-size=1200,1600")
    data = picture.read_bytes()
    assert struct.unpack(">II", data[16:24]) == (1200, 1600)
    assert len(data) > 30_000  # an empty page of this size has 5 kB
    told = browse(tmp_path, folder / "tests" / "span-2.5.html", "--enable-logging=stderr", "--dump-dom").stderr
    assert "CONSOLE" not in told
