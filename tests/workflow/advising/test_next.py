"""The advice of a campaign: by its last run, for its own specimens, with the tests that are still to come."""

import re

import pytest

from colonnade.campaign import load
from colonnade.errors import CampaignError, StoreError
from colonnade.store.records.summary import read_summary
from colonnade.workflow.advising import next as advising
from colonnade.workflow.advising.next import advise, advise_after
from colonnade.workflow.product import Catalogue


def advised(small, *specimens):
    return advise(load(small.folder).awaiting(), small.layout, Catalogue(small.layout), specimens)


def test_free_vibrations_are_advised_from_the_pooled_restitution(undisturbed):
    (free,) = advised(undisturbed)
    assert (free.specimen, free.kind) == ("prism", "free-vibration")
    assert (free.is_enough, free.left) == (True, 0)
    assert re.fullmatch(r"e 0\.9[23].* from 2, as narrow as wanted", free.reason)


def test_what_cannot_be_advised_is_refused(small):
    with pytest.raises(CampaignError, match='no specimen "prsm"'):
        advised(small, "prsm")
    small.layout.summary_json.unlink()
    with pytest.raises(StoreError, match="Run `colonnade run` first"):
        advised(small)


def test_after_a_test_only_its_own_kind_is_advised(undisturbed):
    campaign, summary = load(undisturbed.folder), read_summary(undisturbed.layout)
    assert summary is not None
    (free,) = advise_after(campaign, undisturbed.layout, "free-01", summary.tests)
    assert free.kind == "free-vibration"
    assert advise_after(campaign, undisturbed.layout, "pulse-01", summary.tests) == []


def test_the_report_advises_while_tests_are_planned(small, monkeypatch):
    small.complete()
    assert "What next" not in small.layout.report.read_text(encoding="utf-8")

    campaign_file = small.folder / "campaign.toml"
    campaign_file.write_text(campaign_file.read_text() + '\n[table]\nstroke = "75 mm"\n')
    small.complete()
    text = small.layout.report.read_text(encoding="utf-8")
    (free,) = advised(small)
    assert "What next" in text
    assert free.row()[-1].replace("<", "&lt;") in text

    def refuse(*_):
        raise AssertionError("advice was made again")

    monkeypatch.setattr(advising, "advise_kind", refuse)
    small.layout.report.unlink()
    small.complete()
    assert "What next" in small.layout.report.read_text(encoding="utf-8")
