"""The page of the real columns: the answer, what it rests on, what was left out."""

from __future__ import annotations

from html import unescape

from colonnade.campaign import load
from colonnade.report.assessments_page.page import assessments_page
from colonnade.report.paper.document import document_of
from colonnade.store.layout import Layout
from colonnade.store.records.assessment import NOT_COVERED
from colonnade.store.records.summary import read_summary
from read_pages import Page


def test_the_page_says_the_answer_and_shows_its_pictures(assessed):
    campaign, layout = load(assessed), Layout(assessed)
    [shown] = assessments_page(campaign, layout, read_summary(layout))
    text = (layout.report.parent / "assessments.html").read_text(encoding="utf-8")
    words = " ".join(Page(text).words.split())
    for sentence in (*shown.answer, NOT_COVERED):
        assert " ".join(sentence.split()) in words
    assert text.count("<svg") == 4
    assert "broken.csv" in words
    assert "West" in words
    assert "ASCE 43" in words
    assert unescape(shown.columns.description).count("m/s") >= 3


def test_it_is_on_the_way_of_the_pages_and_on_paper(assessed):
    campaign, layout = load(assessed), Layout(assessed)
    folder = layout.report.parent
    assert 'href="assessments.html"' in layout.report.read_text(encoding="utf-8")
    assert 'href="../assessments.html"' in (folder / "tests" / "free-01.html").read_text(encoding="utf-8")
    titles = [chapter["title"] for chapter in document_of(campaign, folder).data["chapters"]]
    assert titles[-2:] == ["The real column", "Methods"]
