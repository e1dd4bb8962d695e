from __future__ import annotations

import re
from collections import Counter
from html.parser import HTMLParser

import pytest

from colonnade.report import build
from colonnade.store import files

VOID = {"meta", "img", "br", "hr", "input", "link", "col", "wbr"}


class Page(HTMLParser):
    """Tags, ids, references and text of a page; refuses tags that do not nest."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.tags: Counter[str] = Counter()
        self.ids: list[str] = []
        self.links: list[str] = []
        self.attributes: Counter[str] = Counter()
        self.words = ""
        self._open: list[str] = []
        self.feed(text)
        self.close()
        assert not self._open, f"not closed: {self._open}"

    def handle_starttag(self, tag, attrs):
        self.tags[tag] += 1
        self.words += " " if tag in ("td", "th", "li") else ""
        if tag not in VOID:
            self._open.append(tag)
        self._attributes(attrs)

    def handle_startendtag(self, tag, attrs):
        self.tags[tag] += 1
        self._attributes(attrs)

    def handle_endtag(self, tag):
        assert self._open.pop() == tag

    def handle_data(self, data):
        if self._open and self._open[-1] != "style":
            self.words += data

    def _attributes(self, attrs):
        for name, value in attrs:
            self.attributes[name] += 1
            if name == "id":
                self.ids.append(value)
            if name in ("href", "src"):
                self.links.append(value)


@pytest.fixture(scope="module")
def text(filled_campaign) -> str:
    return build(*filled_campaign).read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def page(text) -> Page:
    return Page(text)


def row(text: str, test: str) -> str:
    """Words of a test's row in the table of all tests."""
    table = text[text.index('<section id="all-tests">') :]
    start = table.index(f'<a href="#test-{test}"')
    return " ".join(re.sub(r"<[^>]+>", " ", table[start : table.index("</tr>", start)].partition(">")[2]).split())


def section(text: str, test: str) -> str:
    start = text.index(f'<article id="test-{test}">')
    return text[start : text.index("</article>", start)]


def test_the_page_stands_alone(text, page):
    assert not page.tags["script"]
    assert not page.tags["link"]
    assert not page.tags["img"]
    assert all(link.startswith("#") for link in page.links)
    assert not re.search(r"@import|url\((?!#)", text)


def test_ids_are_unique_and_every_link_leads_somewhere(text, page):
    assert [name for name, times in Counter(page.ids).items() if times > 1] == []
    referred = {link[1:] for link in page.links} | set(re.findall(r"url\(#([^)]+)\)", text))
    assert referred <= set(page.ids)


def test_what_people_wrote_is_escaped(page, text):
    assert "<script>alert('title')</script>" in page.words
    assert '<img src=x onerror="alert(1)"> & 5 < 6' in page.words
    assert "channel <top>: the largest value" in page.words
    assert not page.attributes["onerror"]
    assert "<script" not in text


def test_the_summary_counts_tests_and_gives_each_restitution(page):
    words = " ".join(page.words.split())
    assert "10 tests: 8 done, 1 failed, 1 not yet run to the end." in words
    assert "The linear model predicts the outcome of 7 of the 8 tests" in words
    assert "Specimen prism: e = 0.9761 ± 0.0008 (95 % interval), identified from free vibrations" in words
    assert "a rigid body without bounce has 0.9485" in words
    assert "Specimen statue: e = 0.9, given in the campaign file" in words


@pytest.mark.parametrize(
    ("test", "expected"),
    [
        (
            "span-2.0",
            r"span-2.0 earthquake prism done 1 warning 2.7 m/s² .* rocking 0\.\d+ rocking 0\.\d+ 0.031",
        ),
        ("span-3.0", r"span-3.0 .* rocking 0\.\d+ overturned ≠ measured – 0.031"),
        ("sine-3hz-too-strong-for-the-block-1", r".* done .* overturned – overturned – 0.004"),
        ("sine-dead", r"sine-dead sine prism failed in condition – – – – – –"),
        ("later", r"later sine prism pending – – – – – –"),
        ("watched", r"watched earthquake statue done .* – seen: not-overturned – no-rocking 0 –"),
    ],
)
def test_the_table_gives_each_test_its_row(text, test, expected):
    assert re.fullmatch(expected, row(text, test)), row(text, test)


def test_failures_are_told_with_stage_and_whole_reason(text):
    for part in (text[text.index('id="failures"') :], section(text, "sine-dead")):
        assert "condition:</span> channel &lt;top&gt;: the largest value is 0.2 % of its range." in part
        assert "is the sensor plugged in?" in part


def test_warnings_are_told_in_full_where_the_test_is(text):
    assert "3 spikes bridged. &lt;img src=x" in section(text, "span-2.5")


def test_each_test_has_its_overlay_and_its_channels(text):
    assert "<svg" in section(text, "span-2.0")
    assert "of base (m/s²)" in section(text, "span-2.0")
    assert "of base" not in section(text, "free-01")
    for expected in ("1.23 mm", "25 Hz", "20.10 ms ± 0.20 ms", "3 samples are spikes"):
        assert expected in section(text, "span-2.0")


def test_a_test_without_results_has_no_picture_and_no_empty_table(text):
    assert "<svg" not in section(text, "later")
    assert "<table" not in section(text, "later")


def test_spans_stand_together_in_their_order(text):
    spans = text[text.index('<section id="spans">') : text.index('<section id="restitution">')]
    assert spans.count("<svg") == 1
    assert spans.index("Span 2.0</text>") < spans.index("Span 2.5</text>") < spans.index("Span 3.0</text>")


def test_a_refused_restitution_says_why(text):
    part = text[text.index('<section id="restitution">') : text.index('<section id="each-test">')]
    assert "The peaks do not decay. &lt;img" in part
    assert "peak left out" in part


def test_settings_and_provenance_are_given(page):
    words = " ".join(page.words.split())
    assert "processing.lowpass 25 Hz" in words
    assert "(changed in the campaign file)" in words
    assert "raw/span-2.0.csv" in words
    assert len(re.findall(r"\b[0-9a-f]{64}\b", words)) == 9
    assert "later not ingested" in words


def test_the_same_results_give_the_same_bytes_and_no_new_file(filled_campaign, text):
    path = filled_campaign[1].report
    before = path.stat().st_mtime_ns
    assert build(*filled_campaign) == path
    assert path.stat().st_mtime_ns == before
    assert path.read_text(encoding="utf-8") == text


def test_a_campaign_without_any_result_has_a_report(empty_campaign):
    text = build(*empty_campaign).read_text(encoding="utf-8")
    words = " ".join(Page(text).words.split())
    assert "10 tests: 0 done, none failed, 10 not yet run to the end." in words
    assert "Specimen prism: no coefficient of restitution yet; a rigid body without bounce has 0.9485." in words
    assert "<svg" not in text


def test_a_campaign_in_which_everything_failed_has_a_report(empty_campaign, tmp_path):
    campaign, layout = empty_campaign[0], type(empty_campaign[1])(tmp_path)
    for name in campaign.tests:
        files.write_failed(
            layout.stage(name, "ingest"), f"{name}: the file is empty <b>", attributes={"stage": "ingest"}
        )
    text = build(campaign, layout).read_text(encoding="utf-8")
    assert "10 failed" in Page(text).words
    assert text.count("the file is empty &lt;b&gt;") == 20


def test_a_damaged_result_is_told_as_a_failure(empty_campaign, tmp_path):
    campaign, layout = empty_campaign[0], type(empty_campaign[1])(tmp_path)
    layout.test("free-01").mkdir(parents=True)
    layout.stage("free-01", "rocking").write_bytes(b"no NetCDF")
    text = build(campaign, layout).read_text(encoding="utf-8")
    assert "rocking:</span>" in text[text.index('id="failures"') :]
    assert "1 failed" in Page(text).words
