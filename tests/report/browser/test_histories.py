"""The histories of a test in a browser: zoom, cursor, curves, keyboard, the moving block, downloads."""

import csv
import io
import re

import numpy as np
import pytest

from browsing import TELEPHONE
from colonnade.store import files
from colonnade.store.results import ResultId

pytestmark = pytest.mark.whole

TEST = "span-2.5"
READY = "document.documentElement.classList.contains('scripted')"
VIEW = "[colonnade.page.view.from, colonnade.page.view.to]"
DRAWN = "new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))"


@pytest.fixture(scope="module")
def opened_page(visit_once):
    opened = visit_once(f"tests/{TEST}.html")
    opened.wait_for_function(READY)
    return opened


@pytest.fixture
def page(opened_page):
    """The page of a test as it is at first, with its first plot in view."""
    opened_page.evaluate("colonnade.page.reset(); colonnade.page.move(colonnade.page.peak())")
    opened_page.locator(".plotted").first.evaluate("plot => plot.scrollIntoView({block: 'center'})")
    opened_page.evaluate(DRAWN)
    return opened_page


def view(page):
    page.evaluate(DRAWN)
    return page.evaluate(VIEW)


def cursor(page):
    return page.evaluate("colonnade.page.cursor")


def panel(page, title):
    return page.locator(".panel", has=page.get_by_role("heading", name=title))


def opened(page, title):
    page.locator("summary", has_text=title).evaluate("summary => { summary.parentElement.open = true; }")
    page.wait_for_function(
        "title => [...document.querySelectorAll('.group-of-panels')].some(group => "
        "group.querySelector('summary').textContent === title && group.querySelector('.downloads'))",
        arg=title,
    )


def saved(page, button):
    with page.expect_download() as download:
        button.click()
    return download.value.path().read_text(encoding="utf-8-sig")


def test_every_history_has_its_panel(page):
    for title in ("Table motion", "Channels, conditioned", "Channels, as recorded"):
        opened(page, title)
    titles = page.locator(".panel h3").all_inner_texts()
    assert titles[0] == "Rocking angle θ/α; dotted: ± α"
    assert "Predicted minus measured θ/α" in titles
    assert "Base acceleration (m/s²); dotted: ± g tan α" in titles
    assert "top, as recorded (V; right: mm)" in titles
    assert page.locator(".replaced svg").is_hidden()


def test_the_wheel_zooms_with_ctrl_about_the_pointer_and_reset_shows_all(page):
    whole = view(page)
    box = page.locator(".plotted").first.bounding_box()
    page.mouse.move(box["x"] + box["width"] / 2, box["y"] + 80)
    time = cursor(page)
    page.keyboard.down("Control")
    page.mouse.wheel(0, -300)
    page.keyboard.up("Control")
    page.wait_for_function(
        "whole => colonnade.page.view.to - colonnade.page.view.from < 0.7 * whole", arg=whole[1] - whole[0]
    )
    near = view(page)
    assert near[0] < time < near[1]
    page.get_by_role("button", name="Show the whole record").click()
    assert view(page) == whole
    page.mouse.wheel(0, -300)
    assert view(page) == whole  # without Ctrl the page scrolls


def test_drag_moves_and_drag_with_shift_zooms_into_the_stretch(page):
    page.locator(".panels").press("+")
    before = view(page)
    box = page.locator(".plotted").nth(1).bounding_box()
    left, y = box["x"] + 200, box["y"] + 50
    page.mouse.move(left + 200, y)
    page.mouse.down()
    page.mouse.move(left + 100, y, steps=3)
    page.mouse.up()
    moved = view(page)
    assert moved[0] > before[0]
    assert moved[1] - moved[0] == pytest.approx(before[1] - before[0])
    page.mouse.move(left, y)
    from_ = cursor(page)
    page.mouse.move(left + 100, y)
    to = cursor(page)
    page.mouse.move(left, y)
    page.keyboard.down("Shift")
    page.mouse.down()
    page.mouse.move(left + 100, y, steps=3)
    page.mouse.up()
    page.keyboard.up("Shift")
    assert view(page) == pytest.approx([from_, to], abs=0.02)


@pytest.mark.smoke
def test_the_cursor_gives_the_stored_values_with_their_units(page, filled_campaign):
    _, layout = filled_campaign
    rocking = files.read(layout.path(ResultId(TEST, "rocking")))
    index = 700
    opened(page, "Table motion")
    time = float(rocking["elapsed"][index])
    page.evaluate("time => colonnade.page.move(time)", time)
    shown = panel(page, "Base acceleration").locator(".value").inner_text()
    assert shown.endswith(" m/s²")
    assert float(shown.split()[0].replace("−", "-")) == pytest.approx(
        float(rocking["base_acceleration"][index]), rel=1e-3
    )
    angle = panel(page, "Rocking angle θ/α").locator(".value").first.inner_text()
    assert "mrad" in angle
    assert page.locator(".time").inner_text() == f"time {time:.3f} s"


def test_every_sample_is_reached_by_zooming(page, filled_campaign):
    rocking = files.read(filled_campaign[1].path(ResultId(TEST, "rocking")))
    time = rocking["elapsed"].to_numpy()
    page.evaluate("ends => colonnade.page.look(...ends)", [float(time[500]), float(time[512])])
    page.evaluate(DRAWN)
    drawn = page.evaluate("Array.from(colonnade.page.panels[0].curves[0].source.data.x)")
    np.testing.assert_allclose(drawn[1:-1], time[500:513][: len(drawn) - 2], atol=1e-6)
    page.get_by_role("button", name="Show the whole record").click()
    page.evaluate(DRAWN)
    assert page.evaluate("colonnade.page.panels[0].curves[0].source.data.x.length") <= time.size


def test_a_curve_is_turned_off_and_on(page):
    button = panel(page, "Rocking angle θ/α").get_by_role("button", name="nonlinear model").first
    source = "colonnade.page.panels[0].curves[2].source.data.x.length"
    assert page.evaluate(source) > 0
    button.click()
    assert button.get_attribute("aria-pressed") == "false"
    assert page.evaluate(source) == 0
    button.click()
    assert page.evaluate(source) > 0


def test_the_keyboard_does_what_the_pointer_does(page):
    root, whole, start = page.locator(".panels"), view(page), cursor(page)
    root.press("ArrowRight")
    assert cursor(page) > start
    assert f"{cursor(page):.3f} s: measured" in page.get_by_role("status").inner_text()
    root.press("+")
    near = view(page)
    assert near[1] - near[0] == pytest.approx((whole[1] - whole[0]) / 2)
    root.press("Shift+ArrowRight")
    assert view(page)[0] > near[0]
    root.press("-")
    root.press("Home")
    assert view(page) == whole


def test_the_block_moves_with_the_cursor_and_plays(page):
    page.evaluate("colonnade.page.move(colonnade.page.whole.from)")
    upright = page.locator(".moving svg").screenshot()
    page.evaluate("colonnade.page.move(colonnade.page.peak())")
    assert page.locator(".moving svg").screenshot() != upright
    assert "measured θ = " in page.locator(".moving p").inner_text()
    before = cursor(page)
    page.get_by_role("button", name="Play the motion").click()
    page.wait_for_function("before => colonnade.page.cursor > before + 0.02", arg=before)
    page.get_by_role("button", name="Play the motion").click()
    stopped = cursor(page)
    page.evaluate(DRAWN)
    assert cursor(page) == stopped


def test_an_overturned_block_stays_where_it_fell(visit):
    page = visit("tests/sine-3hz-too-strong-for-the-block-1.html")
    page.wait_for_function(READY)
    end = page.evaluate("colonnade.page.block.bodies[0].parts[0].end")
    assert end < page.evaluate("colonnade.page.whole.to") - 1.0
    page.evaluate("end => colonnade.page.move(end)", end)
    assert "measured θ" in page.locator(".moving p").inner_text()
    page.evaluate("colonnade.page.move(colonnade.page.whole.to)")
    assert "measured θ" not in page.locator(".moving p").inner_text()
    assert page.locator(".moving polygon.measured").get_attribute("transform").startswith("translate(")
    assert page.locator(".moving polygon.measured").is_visible()


@pytest.mark.parametrize(
    ("angle", "corner", "there"),
    [(0.2, 3, (0.05, 0.0)), (-0.2, 0, (-0.05, 0.0)), (np.pi / 2, 2, (0.45, 0.0)), (-np.pi / 2, 1, (-0.45, 0.0))],
    ids=["pole at the right", "pole at the left", "fallen to the right", "fallen to the left"],
)
def test_corners_turn_about_the_pole(page, angle, corner, there):
    outline = [[-0.05, 0], [-0.05, 0.4], [0.05, 0.4], [0.05, 0]]
    placed = page.evaluate(
        """([[x, z], angle]) => {
          const shape = colonnade.element("polygon");
          shape.setAttribute("transform", colonnade.MovingBlock.turned([-0.05, 0.05], angle, 0, 0));
          const at = new DOMPoint(x, -z).matrixTransform(shape.transform.baseVal.consolidate().matrix);
          return [at.x, -at.y];
        }""",
        [outline[corner], angle],
    )
    assert placed == pytest.approx(there, abs=1e-6)


def test_names_are_texts_whatever_they_are(page):
    name = '<img src=x onerror=alert(1)> "Größe" θ\''
    shown = page.evaluate(
        """name => {
          const curve = { name, clock: 0, values: 0, colour: "ink" };
          const given = { title: name, unit: name, curves: [curve] };
          const made = new colonnade.Panel(given, { panels: [] }, colonnade.page);
          return [made.root.querySelector("h3").textContent, made.root.querySelector("button").textContent,
            made.root.querySelectorAll("img").length, colonnade.cell(name)];
        }""",
        name,
    )
    assert shown == [f"{name} ({name})", f"{name} ", 0, '"' + name.replace('"', '""') + '"']

    # A text is no formula in a spreadsheet.
    assert page.evaluate("['=1+1', '-x', -1.5, NaN].map(colonnade.cell)") == ["'=1+1", "'-x", "-1.5", ""]


def test_flagged_samples_of_a_recorded_channel_are_marked(page, filled_campaign):
    opened(page, "Channels, as recorded")
    recorded = files.read(filled_campaign[1].path(ResultId(TEST, "ingest")))
    suspect = int((recorded["top_quality"] == 3).sum())
    assert f"{suspect} suspect" in panel(page, "top, as recorded").locator(".mark.differs").inner_text()
    find = "colonnade.page.panels.find(panel => panel.given.title === 'top, as recorded')"
    page.evaluate("colonnade.page.look(5.9, 6.2)")
    page.evaluate(DRAWN)
    assert page.evaluate(f"{find}.marked.data.x.length") == suspect


def test_all_samples_are_saved_as_csv_with_units(page, filled_campaign):
    opened(page, "Table motion")
    group = page.locator(".group-of-panels", has_text="Table motion")
    rows = list(csv.reader(io.StringIO(saved(page, group.get_by_role("button", name="all samples as CSV")))))
    assert rows[0] == ["time (s)", "Base acceleration, measured (m/s²)"]
    rocking = files.read(filled_campaign[1].path(ResultId(TEST, "rocking")))
    np.testing.assert_allclose([float(row[0]) for row in rows[1:]], rocking["elapsed"], atol=1e-6)
    np.testing.assert_allclose([float(row[1]) for row in rows[1:]], rocking["base_acceleration"], atol=1e-5)


ORDER = ["histories", "findings", "found", "closer", "spread", "table", "channels", "done", "setup"]


@pytest.mark.parametrize(
    ("test", "screen", "screens", "said"),
    [
        ("free-01", (1280, 900), 1, r"e 0\.93\d* ± 0\.000\d+; nonlinear.*"),
        (TEST, (390, 844), 2, r"rocking 0\.6\d* α; nonlinear 0\.5\d* α ≠; linear 0\.5\d* α ≠"),
    ],
)
def test_the_answer_is_in_the_heading_and_the_angle_on_the_screen(visit, test, screen, screens, said):
    page = visit(f"tests/{test}.html", screen=screen)
    page.wait_for_function(READY)
    answer = page.locator("header .answer")
    box = answer.bounding_box()
    assert box["y"] + box["height"] < screen[1] / 2
    assert re.fullmatch(said, answer.inner_text())
    assert page.locator(".plotted").first.bounding_box()["y"] < screens * screen[1]


def test_on_a_telephone_sections_stand_in_order_names_are_below_their_curves_and_no_key_is_named(visit):
    page = visit(f"tests/{TEST}.html", screen=TELEPHONE)
    page.wait_for_function(READY)
    assert page.locator("main section[id]").evaluate_all("all => all.map(one => one.id)") == ORDER
    plot, keys = (page.locator(f".panel {part}").first.bounding_box() for part in (".plotted", ".curves"))
    assert keys["y"] >= plot["y"] + plot["height"]
    assert "Shift" not in page.locator("body").inner_text()


def test_a_specimen_begins_with_e_and_its_decay_and_the_map_follows(visit):
    page = visit("specimens/prism.html", screen=(1280, 900))
    ids = page.locator("main section[id]").evaluate_all("all => all.map(one => one.id)")
    assert ids[:3] == ["restitution", "map", "properties"]
    assert page.locator("header .answer").inner_text().startswith("e 0.93")
    assert page.locator("#restitution figure").first.bounding_box()["y"] < 900


@pytest.mark.parametrize("address", ["specimens/prism.html", "index.html"])
def test_every_picture_of_every_page_can_be_taken_along(visit, address):
    page = visit(address)
    page.wait_for_function("document.querySelector('.downloads')")
    pictures = page.locator("figure:has(svg[role])")
    for picture in pictures.all():
        assert picture.locator(".downloads button").all_inner_texts() == ["SVG", "PNG", "CSV"]
    row = pictures.last
    assert "," in saved(page, row.get_by_role("button", name="as CSV")).splitlines()[0]
    assert saved(page, row.get_by_role("button", name="as SVG")).startswith('<?xml version="1.0"')
    with page.expect_download() as download:
        row.get_by_role("button", name="as PNG").click()
    assert download.value.path().read_bytes().startswith(b"\x89PNG")
    assert download.value.suggested_filename.endswith(".png")


def test_without_scripts_alone_and_on_paper_the_picture_stands(visit, page, browser, report_folder, tmp_path):
    bare = visit(f"tests/{TEST}.html", scripts=False)
    assert bare.locator(".replaced svg").is_visible()
    assert bare.locator(".panels").count() == 0
    (tmp_path / "alone.html").write_bytes((report_folder / "tests" / f"{TEST}.html").read_bytes())
    alone = browser.new_page()
    alone.goto((tmp_path / "alone.html").as_uri())
    assert alone.locator(".replaced svg").is_visible()
    alone.close()
    page.emulate_media(media="print")
    assert page.locator(".replaced svg").is_visible()
    assert page.locator(".panels").is_hidden()
    page.emulate_media(media="screen")


def test_a_test_without_results_has_no_histories(visit):
    page = visit("tests/sine-dead.html")
    page.wait_for_load_state()
    assert page.locator("#histories").is_hidden()


def test_readings_have_no_powers_of_ten_and_no_more_digits_than_the_curve_deserves(page):
    written = "([value, ...more]) => colonnade.written(value, ...more)"
    for given, text in (
        ([4.256e-4, 4, 0.08], "0.000426"),
        ([-0.3067, 4, 0.31], "−0.3067"),
        ([1.234e-6], "0.000001234"),
        ([0, 4, 2.5], "0.000"),
        ([123456.7], "123457"),
    ):
        assert page.evaluate(written, given) == text
