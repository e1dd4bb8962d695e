"""The tests whose pages a report asks for, and what of the campaign the page of each shows."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from colonnade.report.asked import Asked, asked_of, shows
from colonnade.report.photos import address_of
from colonnade.store.layout import Layout

SHAKEN = "span-2.0"


@pytest.fixture
def asked(filled_campaign):
    return {each.test: each for each in asked_of(*filled_campaign)}


def test_every_test_is_asked_for_between_its_neighbours(filled_campaign, asked):
    tests = list(filled_campaign[0].tests)
    assert [(each.before, each.test, each.after) for each in asked.values()] == list(
        zip([None, *tests[:-1]], tests, [*tests[1:], None], strict=True)
    )


def test_each_has_its_own_record_and_whether_its_results_are_outdated(filled_campaign):
    found = {each.test: each for each in asked_of(*filled_campaign, outdated={"free-01"})}
    assert [name for name, each in found.items() if each.is_outdated] == ["free-01"]
    assert (found["free-01"].record.kind, found["sine-dead"].record.status) == ("free-vibration", "failed")


def test_photos_are_those_in_the_folder_of_the_report(filled_campaign, tmp_path):
    campaign = filled_campaign[0]
    test = campaign.tests[SHAKEN].model_copy(update={"photos": ("a.jpg", "b.jpg")})
    campaign = replace(campaign, tests=campaign.tests | {SHAKEN: test})
    second = Layout(tmp_path).report.parent / address_of(SHAKEN, 2)
    second.parent.mkdir(parents=True)
    second.write_bytes(b"")
    found = {each.test: each.photos.shown for each in asked_of(campaign, Layout(tmp_path))}
    assert [photo.written for photo in found[SHAKEN]] == ["b.jpg"]
    assert found["free-01"] == ()


def test_a_page_shows_its_own_test_and_no_other(filled_campaign, asked):
    campaign = filled_campaign[0]
    before = shows(campaign, asked[SHAKEN])

    def changed(name):
        test = campaign.tests[name].model_copy(update={"notes": "another"})
        return shows(replace(campaign, tests=campaign.tests | {name: test}), asked[SHAKEN])

    assert changed(SHAKEN) != before
    assert changed("free-01") == before
    assert shows(campaign, replace(asked[SHAKEN], is_outdated=True)) != before
    assert shows(replace(campaign, title="Another"), asked[SHAKEN]) != before


def test_where_the_campaign_is_does_not_show(filled_campaign, asked):
    said = shows(filled_campaign[0], asked[SHAKEN])
    assert str(filled_campaign[0].folder) not in said
    assert Path("raw", f"{SHAKEN}.csv").name in said


def test_without_photos_none_are_shown(asked):
    bare = Asked("a", None, None, asked[SHAKEN].record, is_outdated=False)
    assert (bare.photos.shown, bare.photos.problems) == ((), ())
