"""What the report keeps of each test, as text and back, and when its page is drawn again."""

import shutil
from dataclasses import replace

import numpy as np
import pytest

from colonnade.campaign import load
from colonnade.report import addresses
from colonnade.report.asked import Asked, asked_of
from colonnade.report.kept import ALTERED, from_text, to_text
from colonnade.report.parts import parts_of
from colonnade.store import stamps
from colonnade.store.layout import Layout
from colonnade.store.records.summary import read_summary, records_of_tests
from colonnade.workflow import run

SHAKEN = "span-2.0"
CODE = "0123abcd"


def asked(campaign, layout, test, **changes):
    """Ask for the page of a test between two others."""
    record = records_of_tests(campaign, read_summary(layout))[test]
    return replace(Asked(test, "free-01", "span-2.5", record, is_outdated=False), **changes)


def part_of(campaign, layout, test=SHAKEN, *, code="", **changes):
    (part,) = parts_of(campaign, layout, code, [asked(campaign, layout, test, **changes)])
    return part


@pytest.fixture(scope="module")
def started(empty_campaign, tmp_path_factory):
    """The small campaign, of which a few tests were run up to their restitution."""
    folder = tmp_path_factory.mktemp("started") / "campaign"
    shutil.copytree(empty_campaign[1].folder, folder, ignore=shutil.ignore_patterns("processed", "report"))
    run(folder, only=["free-01", SHAKEN, "sine-dead"], until="restitution", workers=1)
    return load(folder), Layout(folder)


@pytest.fixture
def elsewhere(started, tmp_path):
    """The same campaign and results of one test, with a report in another folder."""
    campaign, layout = started
    shutil.copytree(layout.test(SHAKEN), Layout(tmp_path).test(SHAKEN))
    return campaign, Layout(tmp_path)


def keep(layout, part, *, text=None, key=None, data=None):
    """Put the page of a test, and its data, where the report has them."""
    page = text or stamps.stamped(part.text, key or part.made_from)
    data = data or stamps.stamped(part.data, key or part.made_from, script=True)
    for address, content in ((addresses.of_test(SHAKEN), page), (addresses.of_data(addresses.of_test(SHAKEN)), data)):
        path = layout.report.parent / address
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(content, encoding="utf-8")


@pytest.mark.parametrize(
    ("test", "has_span", "has_free_vibration"),
    [
        ("free-01", False, True),
        ("span-2.0", True, False),
        ("sine-dead", False, False),
        ("watched", False, False),
        ("later", False, False),
    ],
)
def test_a_test_is_part_of_the_pages_of_its_kind(started, test, has_span, has_free_vibration):
    part = part_of(*started, test)
    assert (part.span is not None, part.free_vibration is not None) == (has_span, has_free_vibration)
    if has_span:
        assert part.span.row is part.row
    if has_free_vibration:
        assert part.free_vibration.test == test
        assert part.free_vibration.e


def test_results_that_are_out_of_date_are_not_read(started):
    part = part_of(*started, is_outdated=True)
    assert (part.span, part.channels, part.used.values) == (None, (), {})
    assert "<svg" not in part.text
    assert "<svg" in part_of(*started).text


def test_without_a_hash_of_the_code_every_page_is_drawn(elsewhere):
    keep(elsewhere[1], part_of(*elsewhere, code=CODE))
    part = part_of(*elsewhere)
    assert part.made_from == ""
    assert part.text


def test_a_page_that_is_there_is_not_drawn_again_and_all_else_is_still_given(elsewhere):
    first = part_of(*elsewhere, code=CODE)
    assert first.text
    keep(elsewhere[1], first)
    second = part_of(*elsewhere, code=CODE)
    assert (second.text, second.data) == (None, None)
    assert second.made_from == first.made_from
    assert (second.row, second.channels, second.used) == (first.row, first.channels, first.used)
    assert second.span is not None


def test_a_page_whose_data_were_altered_is_made_again(elsewhere):
    first = part_of(*elsewhere, code=CODE)
    keep(
        elsewhere[1], first, data=stamps.stamped(first.data, first.made_from, script=True).replace("Response", "Answer")
    )
    assert part_of(*elsewhere, code=CODE).data == first.data


@pytest.mark.parametrize("state", ["altered", "not stamped", "of other results"])
def test_a_page_that_does_not_say_what_it_shows_is_drawn_again(elsewhere, state):
    first = part_of(*elsewhere, code=CODE)
    page = stamps.stamped(first.text, first.made_from)
    texts = {"altered": page.replace("rocking", "rolling", 1), "not stamped": first.text}
    keep(elsewhere[1], first, text=texts.get(state), key="ff00")
    assert part_of(*elsewhere, code=CODE).text == first.text


def test_a_page_is_known_by_all_that_it_shows(started):
    campaign, layout = started
    predict = campaign.processing.predict.model_copy(update={"models": ("linear",)})
    processing = campaign.processing.model_copy(update={"predict": predict})
    record = asked(campaign, layout, "later").record
    known = [
        part_of(campaign, layout, "later", code=CODE),
        part_of(campaign, layout, "watched", code=CODE),
        part_of(campaign, layout, "later", code="other"),
        part_of(campaign, layout, "later", code=CODE, before=SHAKEN),
        part_of(campaign, layout, "later", code=CODE, after=None),
        part_of(campaign, layout, "later", code=CODE, record=record.model_copy(update={"outcome": "overturned"})),
        part_of(campaign.but(title="Another"), layout, "later", code=CODE),
        part_of(campaign.but(gravity=9.8), layout, "later", code=CODE),
        part_of(campaign.but(processing=processing), layout, "later", code=CODE),
        part_of(campaign, layout, code=CODE),
        part_of(campaign, layout, code=CODE, is_outdated=True),
    ]
    assert len({part.made_from for part in known}) == len(known)


def test_a_page_does_not_know_other_tests_or_where_the_campaign_lies(started, tmp_path):
    campaign, layout = started
    folder = tmp_path / "moved"
    shutil.copytree(layout.folder, folder)
    shutil.rmtree(Layout(folder).test("free-01"))
    moved = part_of(load(folder), Layout(folder), code=CODE)
    assert moved.made_from == part_of(campaign, layout, code=CODE).made_from


@pytest.fixture(scope="module")
def parts(filled_campaign):
    """A free vibration, a test with a Span, and one that failed; their pages are not drawn again."""
    campaign, layout = filled_campaign
    asked = [each for each in asked_of(campaign, layout) if each.test in ("free-01", "span-2.0", "sine-dead")]
    return campaign, {
        part.row.id: replace(part, text=None, data=None) for part in parts_of(campaign, layout, "", asked)
    }


def again(campaign, part):
    return from_text(campaign, part.row.id, part.row.record, to_text(part))


@pytest.mark.parametrize("test", ["free-01", "span-2.0", "sine-dead"])
def test_a_part_comes_back_as_it_was(parts, test):
    campaign, part = parts[0], parts[1][test]
    back = again(campaign, part)
    assert (back.row, back.channels, back.thumbnail, back.used) == (part.row, part.channels, part.thumbnail, part.used)
    assert (back.text, back.data, back.made_from) == (None, None, part.made_from)
    assert to_text(back) == to_text(part)
    assert (back.span is None, back.free_vibration is None) == (part.span is None, part.free_vibration is None)


def test_curves_and_peaks_come_back_to_the_last_bit(parts):
    campaign, every = parts
    panel, back = every["span-2.0"].span.panel, again(campaign, every["span-2.0"]).span.panel
    assert back.predicted.keys() == panel.predicted.keys()
    assert np.array_equal(back.measured.values, panel.measured.values, equal_nan=True)
    series, back = (
        every["free-01"].free_vibration.drawn.peaks,
        again(campaign, every["free-01"]).free_vibration.drawn.peaks,
    )
    assert np.array_equal(back.angle, series.angle)
    assert back.used.dtype == np.bool_


def test_a_failure_keeps_its_stage(parts):
    campaign, every = parts
    assert again(campaign, every["sine-dead"]).row.failures[0].stage == "ingest"


@pytest.mark.parametrize(
    "damage", [lambda text: text[:-9], lambda text: "", lambda text: "\n[1, 2]", lambda text: "\n{}"]
)
def test_text_that_was_altered_is_refused(parts, damage):
    campaign, part = parts[0], parts[1]["free-01"]
    with pytest.raises(ALTERED):
        from_text(campaign, "free-01", part.row.record, damage(to_text(part)))
