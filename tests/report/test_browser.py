"""The page in a real browser: no script, nothing wider than a telephone outside a box that scrolls."""

from __future__ import annotations

import re
import shutil
import struct
import subprocess
from pathlib import Path

import pytest

from colonnade.report import build

BROWSER = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
QUIET = (
    *("--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--hide-scrollbars"),
    *("--disable-background-networking", "--disable-component-update", "--disable-sync"),
)
# Measures the page from outside: the report itself holds no script.
PROBE = """<script>
const frame = document.createElement('iframe');
frame.style.cssText = 'width:%dpx;height:900px;border:0';
frame.srcdoc = document.querySelector('template').innerHTML;
frame.onload = () => {
  const root = frame.contentDocument.documentElement;
  const outside = [...frame.contentDocument.querySelectorAll('body *')].filter(element =>
    !element.closest('.scroll') && element.getBoundingClientRect().right > root.clientWidth + 1);
  document.body.dataset.result = `${root.scrollWidth} ${root.clientWidth} ${outside.length}`;
};
document.body.append(frame);
</script>"""

pytestmark = pytest.mark.skipif(BROWSER is None, reason="no chromium on this machine: `apt-get install chromium`")


def browse(tmp_path: Path, page: Path, *arguments: str) -> str:
    command = [str(BROWSER), *QUIET, f"--user-data-dir={tmp_path / 'profile'}", *arguments, page.as_uri()]
    return subprocess.run(command, check=True, capture_output=True, text=True, timeout=120).stdout


@pytest.mark.parametrize("width", [360, 1200], ids=["on a telephone", "on a desk"])
def test_only_boxes_that_scroll_are_wider_than_the_screen(filled_campaign, tmp_path, width):
    report = build(*filled_campaign).read_text(encoding="utf-8")
    probe = tmp_path / "probe.html"
    probe.write_text(f"<!DOCTYPE html><body><template>{report}</template>{PROBE % width}</body>", encoding="utf-8")
    found = re.search(
        r'data-result="(\d+) (\d+) (\d+)"', browse(tmp_path, probe, "--virtual-time-budget=5000", "--dump-dom")
    )
    assert found is not None
    page_width, screen_width, outside = map(int, found.groups())
    assert screen_width == width
    assert page_width <= width
    assert outside == 0


def test_the_page_is_drawn(filled_campaign, tmp_path):
    picture = tmp_path / "page.png"
    browse(tmp_path, build(*filled_campaign), f"--screenshot={picture}", "--window-size=1200,1600")
    data = picture.read_bytes()
    assert struct.unpack(">II", data[16:24]) == (1200, 1600)
    assert len(data) > 30_000  # an empty page of this size has 5 kB
