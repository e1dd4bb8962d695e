"""What the report keeps of each test, and when its page is drawn again."""

from __future__ import annotations

import shutil
from dataclasses import replace

import pytest

from colonnade.campaign import load
from colonnade.report import addresses
from colonnade.report.asked import Asked
from colonnade.report.parts import Part, parts_of
from colonnade.store import stamps
from colonnade.store.layout import Layout
from colonnade.store.records.summary import read_summary, records_of_tests
from colonnade.workflow import run

SHAKEN = "span-2.0"
CODE = "0123abcd"


def asked(campaign, layout, test, **changes) -> Asked:
    """Ask for the page of a test between two others."""
    record = records_of_tests(campaign, read_summary(layout))[test]
    return replace(Asked(test, "free-01", "span-2.5", record, is_outdated=False), **changes)


def part_of(campaign, layout, test=SHAKEN, *, code="", **changes) -> Part:
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


def keep(layout, part, *, text=None, key=None, data=None) -> None:
    """Put the page of a test, and its data, where the report has them."""
    page = text or stamps.stamped(part.text, key or part.made_from)
    data = data or stamps.stamped(part.data, key or part.made_from, script=True)
    for address, content in ((addresses.of_test(SHAKEN), page), (addresses.of_data(addresses.of_test(SHAKEN)), data)):
        path = layout.report.parent / address
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(content, encoding="utf-8")


def test_parts_come_in_the_order_in_which_they_are_asked_for(started):
    names = ["later", "watched", "sine-dead"]
    found = parts_of(*started, "", [asked(*started, name) for name in names])
    assert [part.row.id for part in found] == names
    assert all(part.row.test is started[0].tests[part.row.id] for part in found)


def test_no_test_asked_for_gives_no_part(started):
    assert parts_of(*started, "", []) == []


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


def test_what_a_test_was_made_with_names_that_test_alone(started):
    used = part_of(*started).used
    assert used.values
    assert used.versions
    assert {test for values in used.values.values() for tests in values.values() for test in tests} == {SHAKEN}


def test_a_test_that_was_not_run_has_a_page_and_nothing_else(started):
    part = part_of(*started, "later")
    assert (part.channels, part.used.values, part.used.versions) == ((), {}, {})
    assert "later" in part.text


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
        part_of(replace(campaign, title="Another"), layout, "later", code=CODE),
        part_of(replace(campaign, gravity=9.8), layout, "later", code=CODE),
        part_of(replace(campaign, processing=processing), layout, "later", code=CODE),
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
