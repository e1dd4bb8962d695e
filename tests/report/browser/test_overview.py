"""The table of all tests in a browser: filtered, sorted, by keyboard, from a count of missed outcomes, and whole."""

import shutil
from pathlib import Path

import pytest

from browsing import TELEPHONE

pytestmark = pytest.mark.whole

SHOWN = (
    "() => [...document.querySelectorAll('#tests table tbody tr:not([hidden]) th')].map(th => th.textContent.trim())"
)


@pytest.fixture
def overview(visit):
    return visit("index.html")


def choose(page, name, value):
    page.select_option(f"#filter select[name='{name}']", value)


def test_without_scripts_the_whole_table_stands(visit):
    page = visit("index.html", scripts=False)
    assert page.locator("#tests table tbody tr").count() == 9
    assert not page.locator("#filter").is_visible()
    assert (
        page.locator("#missed + ul li", has_text="linear model predicts overturned").locator("a").first.inner_text()
        == "span-3.0"
    )


@pytest.mark.smoke
def test_it_is_filtered_by_each_choice_and_by_words(overview):
    choose(overview, "kind", "earthquake")
    assert overview.evaluate(SHOWN) == ["span-2.0", "span-2.5", "span-3.0", "watched"]
    choose(overview, "specimen", "prism")
    assert overview.evaluate(SHOWN) == ["span-2.0", "span-2.5", "span-3.0"]
    choose(overview, "linear", "overturned")
    assert overview.evaluate(SHOWN) == ["span-3.0"]
    assert overview.locator("#filter output").inner_text() == "1 of 9 tests"
    choose(overview, "linear", "≠")
    assert overview.evaluate(SHOWN) == ["span-2.5", "span-3.0"]
    choose(overview, "linear", "outside")
    assert overview.evaluate(SHOWN) == ["span-2.5"]
    choose(overview, "specimen", "")
    for name, value in (("linear", ""), ("kind", ""), ("outcome", "not-overturned")):
        choose(overview, name, value)
    assert overview.evaluate(SHOWN) == ["watched"]
    overview.click("#filter button[type=reset]")
    overview.wait_for_function("document.querySelector('#filter output').textContent === '9 of 9 tests'")
    overview.fill("#filter input[name=words]", "sine Failed")
    assert overview.evaluate(SHOWN) == ["sine-dead"]


def test_a_count_of_missed_outcomes_leads_to_its_tests_in_the_table(overview):
    overview.click("#agreement a[href='?outcome=rocking&linear=overturned#tests']")
    overview.wait_for_function("document.querySelector('#filter output').textContent === '1 of 9 tests'")
    assert overview.evaluate(SHOWN) == ["span-3.0"]
    assert overview.evaluate("document.getElementById('tests').getBoundingClientRect().top") < 300


def test_the_address_holds_the_filter(overview):
    choose(overview, "kind", "earthquake")
    overview.fill("#filter input[name=words]", "span")
    overview.wait_for_url("**/index.html?kind=earthquake&words=span")
    overview.reload()
    assert overview.evaluate(SHOWN) == ["span-2.0", "span-2.5", "span-3.0"]
    overview.click("#filter button[type=reset]")
    overview.wait_for_function("document.querySelector('#filter output').textContent === '9 of 9 tests'")
    overview.wait_for_url("**/index.html")


def test_at_1280_px_the_answers_are_seen_and_the_filters_are_one_line(visit):
    page = visit("index.html", screen=(1280, 900))
    heads = page.locator("#tests table th[data-column]")
    first = ["test", "differs", "peak", "peak-linear", "peak-nonlinear"]
    assert heads.evaluate_all("heads => heads.map(head => head.dataset.column)")[:5] == first
    assert heads.nth(4).bounding_box()["x"] + heads.nth(4).bounding_box()["width"] < 1280
    tops = page.locator("#filter > *").evaluate_all("all => all.map(one => one.getBoundingClientRect())")
    assert max(one["top"] for one in tops) < min(one["bottom"] for one in tops)


def test_the_head_of_a_long_table_stays(thousand):
    box = thousand.locator("#tests .scroll")
    box.scroll_into_view_if_needed()
    box.evaluate("box => { box.scrollTop = 900; }")
    head = thousand.locator("#tests table thead th").first
    assert head.bounding_box()["y"] == pytest.approx(box.bounding_box()["y"], abs=1)


def test_it_is_sorted_by_the_keyboard_and_what_is_not_known_stays_last(overview):
    head = overview.locator("#tests table th[data-column='peak']")
    head.locator("button").focus()
    overview.keyboard.press("Enter")
    assert head.get_attribute("aria-sort") == "ascending"
    rows = overview.locator("#tests table tbody tr")
    peaks = [rows.nth(place).locator("td").nth(1).inner_text() for place in range(9)]
    known = [float(peak) for peak in peaks[:5]]
    assert known == sorted(known)
    assert peaks[5] == "overturned"
    assert set(peaks[6:]) == {"–", "observed: not-overturned"}
    overview.keyboard.press("Enter")
    assert head.get_attribute("aria-sort") == "descending"
    assert rows.first.locator("td").nth(1).inner_text() == "overturned"
    overview.click("#tests table th[data-column='test'] button")
    assert overview.evaluate(SHOWN) == sorted(overview.evaluate(SHOWN))
    assert overview.locator("[aria-sort]").count() == 1


def test_the_keyboard_skips_to_the_content_and_a_mark_of_a_figure_leads_to_its_test(overview):
    overview.keyboard.press("Tab")
    assert overview.evaluate("document.activeElement.className") == "skip"
    overview.keyboard.press("Enter")
    assert overview.evaluate("document.activeElement.id") == "content"
    overview.locator("#peaks a[aria-label='span-2.0']").first.click()
    assert overview.url.endswith("tests/span-2.0.html")


def test_contents_stay_in_sight_at_the_side_of_a_wide_screen(visit):
    page = visit("index.html", screen=(1440, 900))
    page.evaluate("document.getElementById('tests').scrollIntoView()")
    box = page.locator("nav.contents").bounding_box()
    assert box["y"] == pytest.approx(0, abs=1)
    assert box["x"] + box["width"] < page.locator("main").bounding_box()["x"]
    links = page.locator("nav.contents a").evaluate_all("links => links.map(link => link.getAttribute('href'))")
    assert links[:2] == ["#attention", "#summary"]


def test_on_a_telephone_what_is_wider_says_that_it_scrolls(visit):
    page = visit("index.html", screen=TELEPHONE)
    boxes = page.locator(".scroll").evaluate_all(
        "boxes => boxes.map(box => [box.scrollWidth > box.clientWidth,"
        " parseFloat(getComputedStyle(box, '::before').fontSize) > 5])"
    )
    assert [True, True] in boxes
    assert all(wider == said for wider, said in boxes)


@pytest.fixture
def thousand(visit, report_folder, tmp_path):
    """The overview with each of its nine rows 112 times."""
    folder = Path(shutil.copytree(report_folder, tmp_path / "report"))
    page = folder / "index.html"
    text = page.read_text(encoding="utf-8")
    start = text.index("<tbody>", text.index('class="tests"')) + len("<tbody>")
    end = text.index("</tbody>", start)
    page.write_text(text[:start] + 112 * text[start:end] + text[end:], encoding="utf-8")
    return visit("index.html", folder=folder)


def test_a_thousand_rows_are_all_there_again_after_a_filter_and_after_a_sort(thousand):
    page = thousand
    choose(page, "kind", "earthquake")
    assert page.locator("#filter output").inner_text() == "448 of 1008 tests"
    shown = "document.querySelectorAll('#tests table tbody tr:not([hidden])').length"
    page.wait_for_function(f"{shown} === 448")
    choose(page, "kind", "")
    page.wait_for_function(f"{shown} === 1008")
    page.click("#tests table th[data-column='test'] button")
    page.wait_for_function(f"{shown} === 1008")
    assert page.evaluate(SHOWN) == sorted(page.evaluate(SHOWN))


def test_an_answer_waits_for_a_screen_of_rows_and_print_for_all(thousand):
    counted = "document.querySelectorAll('#tests table tbody tr').length"
    at_once, printed = thousand.evaluate(
        f"""() => {{
          const form = document.getElementById("filter");
          form.elements.kind.value = "earthquake";
          form.dispatchEvent(new Event("input", {{ bubbles: true }}));
          const counts = [{counted}];
          window.dispatchEvent(new Event("beforeprint"));
          return [...counts, {counted}];
        }}"""
    )
    assert 30 <= at_once <= 50
    assert printed == 448
    assert set(thousand.evaluate(SHOWN)) == {"span-2.0", "span-2.5", "span-3.0", "watched"}
