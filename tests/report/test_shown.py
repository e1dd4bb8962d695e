"""What the pages of a whole report show."""

import re

import pytest

from colonnade.report.asked import Photo
from colonnade.report.build import rendered
from colonnade.report.pictures import OfSpecimen
from colonnade.report.specimens_page import of_specimen
from colonnade.store.layout import Layout
from colonnade.store.records.stored import Stored
from read_pages import Page, dead_links, words_of, written

STRONG = "sine-3hz-too-strong-for-the-block-1"


@pytest.fixture(scope="module")
def texts(report_folder):
    return written(Layout(report_folder.parent))


@pytest.fixture(scope="module")
def overview(texts):
    return texts["index.html"]


def test_there_is_a_page_a_test_a_specimen_and_of_each_kind(texts, filled_campaign):
    campaign = filled_campaign[0]
    assert set(texts) == {
        *("index.html", "quality.html", "problems.html", "methods.html"),
        *(f"tests/{name}.html" for name in campaign.tests),
        *(f"specimens/{name}.html" for name in campaign.specimens),
    }


def test_every_page_stands_alone(texts):
    for address, text in texts.items():
        page = Page(text)
        assert page.tags["script"] == len(page.scripts), address
        assert page.tags["img"] == text.count('class="drawing" src="../setups/'), address
        assert not re.search(r"@import|url\((?!#)|https?://(?!www\.w3\.org)", text), address
        assert len(text.encode()) < 400_000, address


def test_ids_are_unique_and_every_link_leads_somewhere(report_folder):
    assert dead_links(report_folder) == []


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


def test_one_thing_has_one_word(texts):
    for address, text in texts.items():
        words = words_of(text)
        assert "± <" not in words, address
        assert not re.search(r"\b[Ss]etups?\b|[Mm]easured over predicted", words), address
    assert "3 notes" in words_of(texts["specimens/prism.html"])  # not warnings


def test_the_summary_counts_tests_and_gives_each_restitution(overview):
    words = words_of(overview)
    assert "9 tests: 7 done, 1 failed, 1 not finished." in words
    assert "The linear model predicts the outcome of 6 of 7 tests. Its misfit (nrmse) is" in words
    assert re.search(r"prism 0\.9300 ± 0\.0001 identified from free vibrations 0\.9485", words)
    assert "statue 0.9 given in the campaign file" in words


@pytest.mark.parametrize(
    ("test", "expected"),
    [
        ("span-2.0", r"0\.\d+( 0\.\d+ ✓){2} prism earthquake, Span \d\.\d done 3 notes 2\.7\d m/s²( 0\.0\d+){2}"),
        ("span-2.5", r"≠ 0\.\d+( 0\.\d+ ≠){2} prism earthquake, Span \d\.\d done .*reviewed .*"),
        ("span-3.0", r"≠ 0\.\d+( overturned ≠){2} prism earthquake, Span \d\.\d done .*"),
        ("sine-dead", r"– – – prism sine failed in ingest – – –"),
        ("later", r"– – – prism sine pending – – –"),
        ("watched", r"observed: not-overturned( no-rocking){2} statue earthquake done 1\.\d+ m/s² – –"),
    ],
)
def test_the_table_gives_each_test_its_row(overview, test, expected):
    table = overview[overview.index('<section id="tests"') :]
    start = table.index(f'<a href="tests/{test}.html"')
    cells = re.sub(r"<[^>]+>", " ", table[start : table.index("</tr>", start)].partition("</a>")[2])
    assert re.fullmatch(expected, " ".join(cells.split())), cells


def test_sine_tests_stand_by_frequency_and_amplitude_and_of_one_frequency_have_no_map(texts, overview):
    for text in (overview, texts["specimens/prism.html"]):
        ladder = text[text.index('<table class="ladder">') :]
        assert words_of(ladder[: ladder.index("</table>") + 8]) == (
            "frequency Ω tests in order of A 3 Hz 3.347 A 3.78 overturned ≠ linear 4 warnings"
        )
    assert 'id="map-prism"' not in overview
    assert "3.347 below 3.783 below 3.783" in words_of(texts["specimens/prism.html"])


def test_a_test_says_what_was_done_and_found_and_compares_each_model(texts):
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
    assert re.search(
        r"top LVDT <1> displacement 1625 at 250 Hz 0\.062 % failed spikes on 1 sample, the first at", words
    )
    assert re.search(r"top −?0\.0\d+ mm 0 s to 0\.5 s 0\.02\d mm 25 Hz – no redundancy", words)
    for model in ("linear", "nonlinear"):
        found = rf"{model} model rocking 0\.\d+ \S+ s (\+0\.0\d+|< 0\.001) 0\.0\d+ 6\.496 s (3\.9|4\.0)\d+ s \d+ "
        found += r"0\.93 \(identified\)"
        assert re.search(found, words), model
    assert re.search(
        r"Linear model: the measured angle is within its own spread up to (3\.9|4\.0)\d+ s \(\d+ % of the runs", words
    )


def test_the_ratios_of_a_sine_are_given_and_why_it_has_no_order(texts):
    words = words_of(texts[f"tests/{STRONG}.html"])
    assert re.search(r"top .* mm 25 Hz – [\d.]+ × noise, \S+ % of the reading", words)
    assert "Ω = ω/p 3.347 A = a/(g tan α) 3.783" in words
    assert re.search(r"measured overturned – \S+ s – – – – \d+ –", words)
    assert "order of the response The specimen overturned." in words


def test_a_test_without_results_has_no_picture_and_no_empty_table(texts):
    assert "<svg" not in texts["tests/later.html"]
    assert "<table" not in texts["tests/later.html"]
    assert "This test is not finished, so there is nothing to show yet." in words_of(texts["tests/later.html"])


def test_what_people_decided_is_told(texts):
    told = "Reviewed by hand 2013-04-26, N. N.: channel top from 6 s to 6.1 s flagged as suspect:"
    assert told in words_of(texts["tests/span-2.5.html"])
    assert "Reviewed by hand" not in texts["tests/span-2.0.html"]


def test_a_specimen_gives_its_properties_at_both_scales(texts):
    words = words_of(texts["specimens/prism.html"])
    assert "critical angle α – 0.1864 rad 0.1864 rad 0.1864 rad" in words
    assert "pole distance R – 232 mm 232 mm 4.64 m" in words
    assert "frequency parameter p – 5.631 rad/s 5.631 rad/s 1.259 rad/s" in words
    measured = words_of(texts["specimens/statue.html"])
    assert "critical angle α 0.21 rad and 0.23 rad – 0.21 rad" in measured
    assert "prototype" not in measured


def test_a_block_too_wide_to_rock_on_has_a_page(filled_campaign):
    campaign = filled_campaign[0]
    wide = campaign.specimens["prism"].model_copy(update={"width": 0.8})
    wide = campaign.model_copy(update={"specimens": campaign.specimens | {"prism": wide}})
    known = dict(of_specimen(OfSpecimen(wide, "prism", Stored()), [])["restitution"])
    assert known["rigid-body e, without bounce"] == "0"
    assert "e over rigid-body e" not in known


def test_a_specimen_gives_each_restitution_and_why_one_was_refused(texts):
    text = texts["specimens/prism.html"]
    words = words_of(text)
    assert "e over rigid-body e 0.98" in words
    assert "free vibration e whole history peaks, a cross-check" in words
    assert re.search(r"free-01 0\.930\d* ± 0\.0\d+( 0\.9\d+ ± 0\.0\d+){2}", words)
    assert re.search(r"free-refused – 0\.\d+ ± 0\.\d+ – With the sign of the table's acceleration turned", words)
    assert words.count("With the sign of the table's acceleration turned") == 1
    assert "scatter between tests 0 (standard deviation of e); standard error within a test" in words
    assert text.count("<svg xmlns") == 3  # estimators, peaks, impacts


def test_a_free_vibration_tells_its_method_and_how_it_departs_from_the_model(texts):
    words = words_of(texts["tests/free-01.html"])
    assert "from whole history method whole history: penalised least squares" in words
    assert "whole history (given) 0.93" in words
    assert "Departures" not in words
    refused = words_of(texts["tests/free-refused.html"])
    assert "Departures from plane rocking with one e With the sign of the table's acceleration turned" in refused
    assert "refused With the sign of the table's acceleration turned" in refused


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


HOSTILE = '"><script>alert(1)</script>.jpg'


def test_the_section_shows_paths_as_text(empty_campaign):
    campaign, _ = empty_campaign
    photos = [Photo("photos/a-1.jpg", "Photo 1 of test a", HOSTILE)]
    text = rendered(campaign, "photos", "tests/a.html", photos=photos)[0]
    assert '<img src="../photos/a-1.jpg" alt="Photo 1 of test a">' in text
    assert "<script>" not in text
    assert rendered(campaign, "photos", "tests/a.html", photos=[])[0].strip() == ""
