"""The page of a test has every section, each of that test."""

from __future__ import annotations

import pytest

from colonnade.report.photos import NO_PHOTOS, Photo, Photos
from colonnade.report.test_page import page
from colonnade.store.records.stored import read_test

SHOWN = Photos((Photo("photos/span-2.0-1.jpg", "Photo 1 of test span-2.0", "a.jpg"),))


@pytest.fixture
def made(filled_campaign, reported):
    campaign, layout = filled_campaign

    def of(name, shown=NO_PHOTOS):
        stored = read_test(campaign, layout, campaign.tests[name], with_samples=True)
        return page.of_test(campaign, reported[name][0], stored, shown)

    return of


def test_each_section_is_of_its_test(made):
    found = made("span-2.0", SHOWN)
    assert found.row.id == "span-2.0"
    assert found.photos is SHOWN
    pictures = (found.found.record, found.closer, found.base.picture, found.recording)
    assert {picture.identity for picture in pictures} == {
        f"{name}-span-2.0" for name in ("record", "closer", "base", "channels")
    }
    assert {row.name for row in found.channels} == {"top", "bottom", "table_acceleration"}
    assert found.spread.verdicts
    assert found.decay.facts == []


def test_decisions_of_the_review_are_shown_with_and_without_results(made):
    assert any("flagged as suspect" in sentence for sentence in made("span-2.5").review)
    assert made("span-2.0").review == []


def test_a_test_that_was_not_run_has_its_drawing_and_nothing_that_was_measured(made):
    found = made("later")
    assert found.drawing == made("span-2.0").drawing
    assert (found.found.facts, found.closer, found.channels, found.recording) == ([], None, (), None)


def test_a_free_vibration_has_its_decay(made):
    assert dict(made("free-01").decay.facts)["e"].startswith("0.93")
