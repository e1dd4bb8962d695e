from __future__ import annotations

import re
import shutil
from collections import Counter
from html.parser import HTMLParser
from pathlib import Path
from posixpath import dirname, join, normpath

import pytest

from colonnade.campaign import Campaign
from colonnade.figures.stored import record
from colonnade.report import addresses
from colonnade.report.build import build
from colonnade.store import files
from colonnade.store.layout import Layout
from colonnade.workflow.catalogue import Catalogue
from colonnade.workflow.summary import write_summary

VOID = {"meta", "img", "br", "hr", "input", "link", "col", "wbr"}
STRONG = "sine-3hz-too-strong-for-the-block-1"
LATER = "later"


class Page(HTMLParser):
    """Tags, ids, references and text of a page; refuses tags that do not nest."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.tags: Counter[str] = Counter()
        self.ids: list[str] = []
        self.links: list[str] = []
        self.scripts: list[str] = []
        self.attributes: Counter[str] = Counter()
        self.words = ""
        self._open: list[str] = []
        self.feed(text)
        self.close()
        assert not self._open, f"not closed: {self._open}"

    def handle_starttag(self, tag, attrs):
        self.tags[tag] += 1
        self.words += " " if tag in ("td", "th", "li", "dd", "dt", "br") else ""
        if tag not in VOID:
            self._open.append(tag)
        self._attributes(attrs)
        self.scripts += [value for name, value in attrs if tag == "script" and name == "src"]

    def handle_startendtag(self, tag, attrs):
        self.tags[tag] += 1
        self._attributes(attrs)

    def handle_endtag(self, tag):
        assert self._open.pop() == tag

    def handle_data(self, data):
        if self._open and self._open[-1] not in ("style", "script"):
            self.words += data

    def _attributes(self, attrs):
        for name, value in attrs:
            self.attributes[name] += 1
            if name == "id":
                self.ids.append(value)
            if name in ("href", "src"):
                self.links.append(value)


def built(campaign: Campaign, layout: Layout, outdated: set[str] = frozenset(), **options) -> Path:
    """Write the summary and the report, as a run does."""
    write_summary(campaign, layout, Catalogue(layout), outdated=outdated)
    return build(campaign, layout, outdated, **options)


def written(layout: Layout) -> dict[str, str]:
    """Text of every page by its address in the report's folder."""
    folder = layout.report.parent
    paths = sorted(folder.rglob("*.html"))
    return {path.relative_to(folder).as_posix(): path.read_text(encoding="utf-8") for path in paths}


def words_of(text: str) -> str:
    return " ".join(Page(text).words.split())


@pytest.fixture(scope="module")
def texts(filled_campaign, tmp_path_factory) -> dict[str, str]:
    campaign, layout = filled_campaign[0], Layout(tmp_path_factory.mktemp("texts"))
    shutil.copytree(filled_campaign[1].processed, layout.processed)
    built(campaign, layout, {LATER})
    return written(layout)


@pytest.fixture(scope="module")
def overview(texts) -> str:
    return texts["index.html"]


def test_there_is_a_page_a_test_a_specimen_and_of_each_kind(texts, filled_campaign):
    campaign = filled_campaign[0]
    assert set(texts) == {
        *("index.html", "quality.html", "problems.html", "methods.html"),
        *(f"tests/{name}.html" for name in campaign.tests),
        *(f"specimens/{name}.html" for name in campaign.specimens),
    }


def test_each_setup_is_drawn_once_in_a_file_of_its_own(filled_campaign, tmp_path):
    campaign, layout = filled_campaign[0], Layout(tmp_path)
    (stale := tmp_path / "report" / "setups" / "gone+frame.svg").parent.mkdir(parents=True)
    stale.write_text("<svg/>", encoding="utf-8")
    built(campaign, layout, set(campaign.tests))
    drawn = {path.relative_to(layout.report.parent).as_posix() for path in stale.parent.iterdir()}
    assert drawn == {addresses.of_setup(*pair) for pair in campaign.combinations}


def test_every_page_stands_alone(texts):
    for address, text in texts.items():
        page = Page(text)
        assert page.tags["script"] == len(page.scripts) + (address == "index.html"), address
        assert page.tags["img"] == text.count('class="drawing" src="../setups/'), address
        assert not re.search(r"@import|url\((?!#)|https?://(?!www\.w3\.org)", text), address
        assert len(text.encode()) < 600_000, address


def test_scripts_are_files_of_the_report(texts):
    for address, text in texts.items():
        found = [normpath(join(dirname(address), script)) for script in Page(text).scripts]
        assert found == addresses.scripts_of(address)


def test_ids_are_unique_and_every_link_leads_somewhere(texts, filled_campaign):
    drawn = {addresses.of_setup(*pair) for pair in filled_campaign[0].combinations}
    ids = {address: Page(text).ids for address, text in texts.items()}
    for address, text in texts.items():
        assert [name for name, times in Counter(ids[address]).items() if times > 1] == []
        assert set(re.findall(r"url\(#([^)]+)\)", text)) <= set(ids[address])
        page = Page(text)
        for link in set(page.links) - set(page.scripts):
            if link == "data:,":
                continue
            assert not re.match(r"/|[a-z]+:", link), (address, link)  # a report may be copied elsewhere
            target, _, anchor = link.partition("#")
            target = normpath(join(dirname(address), target)) if target else address
            assert target in (texts.keys() | drawn), (address, link)
            assert not anchor or anchor in ids[target], (address, link)


def test_what_people_wrote_is_shown_as_text_on_every_page(texts):
    for address, text in texts.items():
        assert "<script>alert" not in text, address
        assert not Page(text).attributes["onerror"], address
        assert "<script>alert('title')</script>" in Page(text).words, address
    assert '<img src=x onerror="alert(1)"> & 5 < 6' in words_of(texts["tests/span-2.5.html"])
    assert "flagged as suspect: <img src=x onerror" in words_of(texts["quality.html"])
    assert "LVDT <1> displacement" in words_of(texts["tests/span-2.0.html"])


def test_failures_come_first_with_stage_and_whole_reason(texts, overview):
    assert overview.index('id="failures"') < overview.index('id="missed"') < overview.index('id="summary"')
    for text in (overview, texts["tests/sine-dead.html"], texts["problems.html"]):
        assert "ingest:</span> sine-dead.csv: the file is empty (0 bytes): nothing was recorded" in text
        assert "Put the recording in its place." in text


def test_the_summary_counts_tests_and_gives_each_restitution(overview):
    words = words_of(overview)
    assert "9 tests: 7 done, 1 failed, 1 not finished." in words
    assert "The linear model predicts the outcome of 6 of 7 tests. Its misfit (nrmse) is" in words
    assert re.search(r"prism 0\.930\d* ± 0\.0000\d+ \(95 % interval\) identified from free vibrations 0\.9485", words)
    assert "statue 0.9 given in the campaign file" in words


@pytest.mark.parametrize(
    ("test", "expected"),
    [
        (
            "span-2.0",
            r"prism earthquake done 3 notes 2\.7\d m/s² rocking 0\.\d+( rocking 0\.\d+ 0\.0\d+ within){2}",
        ),
        ("span-2.5", r"prism earthquake done reviewed .* rocking .*"),
        ("span-3.0", r"prism earthquake done .* rocking 0\.\d+ overturned ≠ – 0\.0\d+ .*"),
        ("sine-dead", r"prism sine failed in ingest( –)+"),
        ("later", r"prism sine pending( –)+"),
        ("watched", r"statue earthquake done .* – observed: not-overturned – no-rocking 0 – – .*"),
    ],
)
def test_the_table_gives_each_test_its_row(overview, test, expected):
    table = overview[overview.index('<section id="tests">') :]
    start = table.index(f'<a href="tests/{test}.html"')
    cells = re.sub(r"<[^>]+>", " ", table[start : table.index("</tr>", start)].partition("</a>")[2])
    assert re.fullmatch(expected, " ".join(cells.split())), cells


def test_sine_tests_stand_by_frequency_and_amplitude(texts, overview):
    for text in (overview, texts["specimens/prism.html"]):
        ladder = text[text.index('<table class="ladder">') :]
        assert words_of(ladder[: ladder.index("</table>") + 8]) == (
            "frequency Ω tests in order of A 3 Hz 3.347 A 3.78 overturned 4 warnings"
        )


def test_one_frequency_gives_boundaries_and_no_map(texts, overview):
    assert 'id="map-prism"' not in overview
    assert "3.347 below 3.783 below 3.783 no test without rocking" in words_of(texts["specimens/prism.html"])


def test_spans_stand_side_by_side_in_their_order(overview):
    spans = overview[overview.index('<section id="spans">') :]
    assert spans.count("<svg") == 1
    assert spans.index(">Span 2.0</text>") < spans.index(">Span 2.5</text>") < spans.index(">Span 3.0</text>")
    assert "nonlinear model" in spans


def test_a_test_says_what_was_done_and_found(texts):
    words = words_of(texts["tests/span-2.0.html"])
    for expected in (
        "motion El Centro 1940 NS",
        "time scale 0.224",
        "raw/span-2.0.csv SHA-256",
        'clock: column 1, "Time" (in s; rising)',
    ):
        assert expected in words, expected
    assert re.search(r"standard error of θ 0\.05\d mrad", words)
    assert re.search(r"largest slide 0\.01\d* mm, standard error 0\.002\d mm", words)
    assert re.search(r"at prototype scale, 1:20 duration 29\.1 s, largest slide 0\.2\d+ mm", words)


def test_a_test_compares_each_model(texts):
    words = words_of(texts["tests/span-2.0.html"])
    for model in ("linear", "nonlinear"):
        found = rf"{model} model rocking 0\.\d+ \S+ s \+0\.0\d+ 0\.0\d+ 6\.496 s 3\.9\d+ s \d+ 0\.93 \(identified\)"
        assert re.search(found, words), model
    assert re.search(
        r"Linear model: the measured angle is within its own spread up to 3\.9\d+ s \(\d+ % of the runs", words
    )


def test_the_ratios_of_a_sine_are_given_and_why_it_has_no_order(texts):
    words = words_of(texts[f"tests/{STRONG}.html"])
    assert "Ω = ω/p 3.347 A = a/(g tan α) 3.783" in words
    assert re.search(r"measured overturned – \S+ s – – – – \d+ –", words)
    assert "order of the response The specimen overturned." in words


def test_a_test_shows_how_its_channels_were_treated(texts):
    words = words_of(texts["tests/span-2.0.html"])
    assert re.search(
        r"top LVDT <1> displacement 1625 at 250 Hz 0\.062 % failed spikes on 1 sample, the first at", words
    )
    assert re.search(r"top −?0\.0\d+ mm 0 s to 0\.5 s 0\.02\d mm 25 Hz – no redundancy", words)
    overturned = words_of(texts[f"tests/{STRONG}.html"])
    assert re.search(r"top .* mm 25 Hz – [\d.]+ × noise, \S+ % of the reading", overturned)


def test_each_test_has_its_figure(texts):
    assert "base" in texts["tests/span-2.0.html"][texts["tests/span-2.0.html"].index("<svg") :]
    assert ">base" not in texts["tests/free-01.html"]
    assert texts["tests/free-01.html"].count("<svg") == 9
    assert texts["tests/free-refused.html"].count("<svg") == 8  # no joint region


def test_a_test_without_results_has_no_picture_and_no_empty_table(texts):
    assert "<svg" not in texts["tests/later.html"]
    assert "<table" not in texts["tests/later.html"]
    assert "This test is not finished, so there is nothing to show yet." in words_of(texts["tests/later.html"])


def test_what_people_decided_is_told(texts):
    told = "Reviewed by hand 2013-04-26, N. N.: channel top from 6 s to 6.1 s flagged as suspect:"
    assert told in words_of(texts["tests/span-2.5.html"])
    assert "Reviewed by hand" not in texts["tests/span-2.0.html"]


def test_tests_lead_to_the_one_before_and_after(texts):
    assert texts["tests/span-2.5.html"].count('href="../tests/span-2.0.html"') == 2
    assert texts["tests/span-2.5.html"].count('href="../tests/span-3.0.html"') == 2
    assert "<span>←" not in texts["tests/free-01.html"]


def test_a_specimen_gives_its_properties_at_both_scales(texts):
    words = words_of(texts["specimens/prism.html"])
    assert "critical angle α – 0.1864 rad 0.1864 rad 0.1864 rad" in words
    assert "pole distance R – 232 mm 232 mm 4.64 m" in words
    assert "frequency parameter p – 5.631 rad/s 5.631 rad/s 1.259 rad/s" in words
    measured = words_of(texts["specimens/statue.html"])
    assert "critical angle α 0.21 rad and 0.23 rad – 0.21 rad" in measured
    assert "prototype" not in measured


def test_a_specimen_gives_each_restitution_and_why_one_was_refused(texts):
    text = texts["specimens/prism.html"]
    words = words_of(text)
    assert "e over rigid-body e 0.98" in words
    assert "free vibration e peaks half-periods impact by impact whole history, linear" in words
    assert re.search(r"free-01 0\.930\d* ± 0\.0\d+ \(95 % interval\)( 0\.9\d+ ± 0\.0\d+){6}", words)
    assert re.search(r"free-refused –( –)+ 0\.93\d* ± 0\.01\d e of single impacts scatters by", words)
    assert words.count("e of single impacts scatters by") == 1
    assert "scatter between tests 0 (standard deviation of e); standard error within a test" in words
    assert text.count("<svg") == 3  # estimators, peaks, impacts


def test_a_free_vibration_tells_what_was_assumed_and_how_it_departs_from_the_model(texts):
    words = words_of(texts["tests/free-01.html"])
    assert "recommended estimator whole history, e of each impact assumptions plane rocking without slide" in words
    assert "whole history, e of each impact (recommended) 0.93" in words
    assert "Departures" not in words
    refused = words_of(texts["tests/free-refused.html"])
    assert "Departures from plane rocking with one e e of single impacts scatters by" in refused
    assert "refused e of single impacts scatters by" in refused
    assert "half-periods –" in refused


def test_quality_lists_the_channels_that_are_not_good_and_counts_the_others(texts):
    words = words_of(texts["quality.html"])
    assert "13 of 19 channels in 7 tests are good. The others are listed here" in words
    assert len(re.findall(r"\w+ \w+ 1625 at 250 Hz", words)) == 6
    assert "free-01" not in words
    assert "0.062 % failed" in words


def test_problems_name_the_tests_with_a_warning_and_those_that_are_not_finished(texts):
    words = words_of(texts["problems.html"])
    assert "channel top: spikes on 1 sample" in words
    assert "In span-2.0" in words
    assert "Not finished later" in words


def test_methods_tell_what_was_really_used_and_where_tests_differ(texts):
    words = words_of(texts["methods.html"])
    assert "by more than 8 robust standard deviations" in words
    assert "was 25 Hz on the specimen (setting: 25 Hz) and 50 Hz on the table (setting: auto)" in words
    assert f"or start ({STRONG})" in words
    assert "Where tests differ setting value tests zero auto free-01, free-refused, span-2.0" in words
    assert "processing.lowpass 25 Hz" in words
    assert "(changed in the campaign file)" in words
    assert "Housner, G. W. (1963)" in words
    assert re.search(r"made with colonnade \d\S*, Python 3\.\d+", words)
    assert "(free-refused)" not in words  # it has no e, so no method gave one


@pytest.fixture
def two_tests(filled_campaign, tmp_path) -> tuple[Campaign, Layout]:
    """The campaign with the results of two of its tests alone."""
    campaign, layout = filled_campaign[0], Layout(tmp_path)
    for name in ("span-2.0", "span-2.5"):
        shutil.copytree(filled_campaign[1].test(name), layout.test(name))
    return campaign, layout


def test_the_same_results_give_the_same_bytes_and_no_new_file(two_tests):
    folder = built(*two_tests).parent
    texts, before = written(two_tests[1]), {path: path.stat().st_mtime_ns for path in folder.rglob("*.html")}
    built(*two_tests)
    assert written(two_tests[1]) == texts
    assert {path: path.stat().st_mtime_ns for path in folder.rglob("*.html")} == before


def test_a_page_is_drawn_again_only_where_its_test_or_the_program_changed(two_tests, monkeypatch):
    drawn: list[str] = []
    draw = record.record
    monkeypatch.setattr(record, "record", lambda test, *rest: drawn.append(test.id) or draw(test, *rest))

    def drawn_now(code: str) -> list[str]:
        drawn.clear()
        built(*two_tests, code=code)
        return [name for name in drawn if name.startswith("span-2")]

    assert drawn_now("one") == ["span-2.0", "span-2.5"]
    texts = written(two_tests[1])
    assert drawn_now("one") == []
    assert written(two_tests[1]) == texts
    path = two_tests[1].stage("span-2.0", "compare")
    compared = files.read(path)
    compared["nrmse"] = compared["nrmse"] * 2
    files.write(compared.drop_attrs(deep=False), path, attributes={"stage": "compare"})
    assert drawn_now("one") == ["span-2.0"]
    assert drawn_now("two") == ["span-2.0", "span-2.5"]


def test_outdated_results_are_pending_and_not_shown(two_tests):
    built(*two_tests, outdated={"span-2.0"})
    texts = written(two_tests[1])
    assert "pending" in words_of(texts["tests/span-2.0.html"])
    assert "<svg" not in texts["tests/span-2.0.html"]
    assert "<svg" in texts["tests/span-2.5.html"]


def test_pages_of_what_is_no_longer_there_are_removed(empty_campaign, tmp_path):
    campaign, layout = empty_campaign[0], Layout(tmp_path)
    built(campaign, layout)
    strangers = [layout.report.parent / place for place in ("tests/gone.html", "specimens/gone.html")]
    own = layout.report.parent / "tests" / "notes.txt"
    for path in (*strangers, own):
        path.write_text("old", encoding="utf-8")
    built(campaign, layout)
    assert not any(path.exists() for path in strangers)
    assert own.exists()


def test_a_campaign_without_any_result_has_a_report(empty_campaign):
    built(*empty_campaign)
    texts = written(empty_campaign[1])
    words = words_of(texts["index.html"])
    assert "9 tests: 0 done, none failed, 9 not finished." in words
    assert "prism – not yet known 0.9485" in words
    assert not [address for address, text in texts.items() if "<svg" in text]
    assert "No result is stored yet." in words_of(texts["methods.html"])


def test_a_campaign_in_which_everything_failed_has_a_report(empty_campaign, tmp_path):
    campaign, layout = empty_campaign[0], Layout(tmp_path)
    for name in [*campaign.tests]:
        files.write_failed(
            layout.stage(name, "ingest"), f"{name}: the file is empty <b>", attributes={"stage": "ingest"}
        )
    text = built(campaign, layout).read_text(encoding="utf-8")
    assert "9 failed" in Page(text).words
    assert text.count("the file is empty &lt;b&gt;") == 9


def test_a_damaged_result_is_told_as_a_failure(empty_campaign, tmp_path):
    campaign, layout = empty_campaign[0], Layout(tmp_path)
    layout.test("free-01").mkdir(parents=True)
    layout.stage("free-01", "rocking").write_bytes(b"no NetCDF")
    text = built(campaign, layout).read_text(encoding="utf-8")
    assert "rocking:</span>" in text[text.index('id="failures"') :]
    assert "1 failed" in Page(text).words


def test_the_overviews_path_is_returned(empty_campaign, tmp_path):
    assert built(empty_campaign[0], Layout(tmp_path)) == Path(tmp_path) / "report" / "index.html"
