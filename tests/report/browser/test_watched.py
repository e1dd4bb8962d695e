"""An open page of a report that is watched: it follows what is on disk, and stays as the person left it."""

import shutil
from pathlib import Path

import pytest

from colonnade.report.addresses import state_script

pytestmark = pytest.mark.whole

READY = "typeof colonnade !== 'undefined' && colonnade.is_ready"
CHANGED = "document.getElementById('changed')"
CHOSEN = """() => ({
  view: colonnade.page.view, cursor: colonnade.page.cursor,
  hidden: [...document.querySelectorAll('.curves [aria-pressed=false]')].map(key => key.textContent),
  open: [...document.querySelectorAll('details[open] > summary')].map(summary => summary.textContent),
  below: document.querySelector('[data-interactive]').getBoundingClientRect().top,
})"""
ROWS = "[...document.querySelectorAll('#tests table tbody tr:not([hidden]) th')].map(th => th.textContent.trim())"
SORTED = "document.querySelector('[aria-sort=descending]')?.dataset.column"
TEST = "tests/span-2.5.html"


@pytest.fixture
def folder(report_folder, tmp_path):
    """A report of its own."""
    return Path(shutil.copytree(report_folder, tmp_path / "report"))


@pytest.fixture
def tell(folder):
    """Write the state script as a watch does; each time gives a sign of life."""
    times = iter(range(1_700_000_000, 1_800_000_000))

    def write(*, is_watched=True, shown="1", line="", every=5.0):
        text = state_script(is_watched=is_watched, written=next(times), shown=shown, line=line, line_written=1.7e9)
        (folder / "new.js").write_text(text.replace('"every": 5.0', f'"every": {every}'), encoding="utf-8")
        (folder / "new.js").replace(folder / "state.js")

    return write


def change(path):
    """Change a page on disk: it gets longer above its first section."""
    text = path.read_text(encoding="utf-8")
    place = text.index("<section")
    added = '<p id="changed" style="height: 5rem">An earlier test has a new warning.</p>'
    path.write_text(text[:place] + added + text[place:], encoding="utf-8")


def asked(page):
    """Collect what the page asks for."""
    found = []
    page.on("request", lambda request: found.append(request.url))
    return found


def says(page, text):
    page.wait_for_function("text => document.querySelector('.watched').textContent.includes(text)", arg=text)


def test_an_open_page_follows_the_report_and_stays_as_it_was(visit, folder, tell):
    tell(line="free-01: rocking, peak 0.52 α")
    page, overview = visit(TEST, folder=folder), visit("index.html", folder=folder)
    page.wait_for_function("document.documentElement.classList.contains('scripted')")
    says(page, "free-01: rocking")
    page.locator(".panels").press("+")
    page.locator(".panels").press("ArrowRight")
    page.locator(".curves button").nth(1).click()
    for title in ("Table motion", "Channels, as recorded"):
        page.locator("summary", has_text=title).click()
    page.wait_for_function("document.querySelectorAll('.panel').length > 6")
    overview.select_option("#filter select[name='kind']", "earthquake")
    overview.fill("#filter input[name=words]", "span")
    overview.locator("#filter input[name=words]").blur()
    for _ in range(2):
        overview.click("#tests table th[data-column='peak'] button")
    rows = overview.evaluate(ROWS)
    assert rows == ["span-3.0", "span-2.5", "span-2.0"]

    # A test more: only the line changes.
    tell(line="free-02: rocking, peak 0.48 α")
    says(page, "free-02: rocking")
    assert page.evaluate(CHANGED) is None

    # A run has ended, and the person drags.
    box = page.locator(".plotted").nth(1)
    box.evaluate("plot => plot.scrollIntoView({block: 'center'})")
    corner = box.bounding_box()
    page.mouse.move(corner["x"] + 300, corner["y"] + 50)
    page.mouse.down()
    page.mouse.move(corner["x"] + 260, corner["y"] + 50, steps=3)
    for address in (TEST, "index.html"):
        change(folder / address)
    tell(shown="2", line="free-02: rocking, peak 0.48 α")
    says(page, "follows when you pause")
    overview.wait_for_function(CHANGED)
    overview.wait_for_function(READY)
    assert overview.evaluate(ROWS) == rows
    assert overview.evaluate(SORTED) == "peak"
    assert overview.input_value("#filter input[name=words]") == "span"
    assert page.evaluate(CHANGED) is None
    before = page.evaluate(CHOSEN)
    assert "linear model " in before["hidden"]
    assert before["open"][-1] == "Channels, as recorded"
    page.mouse.up()
    page.wait_for_function(CHANGED)
    page.wait_for_function(READY)
    after = page.evaluate(CHOSEN)
    assert after["below"] == pytest.approx(before["below"], abs=2)
    assert after | {"below": 0} == before | {"below": 0}

    # The watch ends, and nobody asks any more.
    tell(is_watched=False, shown="2", line="free-02: rocking, peak 0.48 α")
    for opened in (page, overview):
        says(opened, "The watch has ended. Last: ")
    urls = asked(page)
    page.wait_for_timeout(2000)
    assert urls == []


def test_a_report_that_nobody_watches_asks_once_and_says_nothing(visit, report_folder):
    page = visit("methods.html")
    urls = asked(page)
    page.goto((report_folder / "index.html").as_uri())
    page.wait_for_function(READY)
    page.wait_for_timeout(2000)
    assert sum("state.js" in url for url in urls) == 1
    assert page.locator(".watched").count() == 0


def test_without_a_sign_of_life_it_stops_asking(visit, folder, tell):
    tell(line="free-01: </script><b>bold</b>", every=0.1)
    page = visit("index.html", folder=folder)
    urls = asked(page)
    assert page.get_by_role("status").last.inner_text().endswith(" free-01: </script><b>bold</b>")
    says(page, "The watch has ended. Last: ")
    page.wait_for_timeout(2000)
    assert len(urls) == 1


def test_it_is_not_printed(visit, folder, tell):
    tell(is_watched=False, line="free-01: rocking")
    page = visit("index.html", folder=folder)
    assert page.locator(".watched").is_visible()
    page.emulate_media(media="print")
    assert page.locator(".watched").is_hidden()
