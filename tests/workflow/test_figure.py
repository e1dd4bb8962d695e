"""One figure by its name: what it is of, what it is drawn from, and why it cannot be drawn."""

import shutil

import pytest

from colonnade.campaign import load
from colonnade.errors import CampaignError
from colonnade.workflow.documents import chosen, draw
from every import every


@pytest.fixture
def campaign(filled_campaign):
    return filled_campaign[0]


SUBJECTS = {"span-2.0": ("angle", "test"), "prism": ("impacts", "specimen"), "free-01": ("impacts", "test")}


@every(("subject", "expected"), (SUBJECTS | {None: ("agreement", "campaign")}).items())
def test_a_figure_is_of_what_its_subject_is(campaign, subject, expected):
    entry, found = chosen(campaign, expected[0], subject)
    assert ((entry.name, entry.of), found) == (expected, subject or "")


def test_with_one_specimen_alone_nobody_has_to_name_it(empty_campaign):
    campaign = empty_campaign[0]
    alone = campaign.but(specimens={"prism": campaign.specimens["prism"]})
    entry, subject = chosen(alone, "estimators", None)
    assert (entry.of, subject) == ("specimen", "prism")


def test_a_figure_of_a_specimen_and_of_a_test_under_one_name_differ(campaign):
    of_specimen, of_test = (draw(campaign, *chosen(campaign, "peaks", name), None) for name in ("prism", "free-01"))
    assert of_specimen.identity != of_test.identity


def test_what_a_failed_test_cannot_show_is_said_with_the_reason(campaign):
    with pytest.raises(CampaignError, match=r'sine-dead: there is nothing to draw for "angle"\..*ingest: .*is empty'):
        draw(campaign, *chosen(campaign, "angle", "sine-dead"), None)


def test_before_any_run_it_says_to_run_first(empty_campaign, tmp_path):
    fresh = tmp_path / "fresh"
    shutil.copytree(empty_campaign[1].folder, fresh, ignore=shutil.ignore_patterns("processed", "report"))
    with pytest.raises(CampaignError, match="nothing has been run yet; run `colonnade run` first"):
        draw(load(fresh), *chosen(load(fresh), "angle", "span-2.0"), None)
