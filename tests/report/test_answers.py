"""Pages of real columns and of forecasts: the answer, what it rests on, what was left out."""

from html import unescape

import pytest

from colonnade.campaign import load
from colonnade.report.assessments_page import assessments_page
from colonnade.report.forecasts_page import forecasts_page
from colonnade.report.paper import document_of
from colonnade.store.forecasts import read_forecasts
from colonnade.store.layout import Layout
from colonnade.store.records.summary import read_summary
from colonnade.workflow.graph import Graph
from colonnade.workflow.pages import Report
from colonnade.workflow.product import Catalogue
from colonnade.workflow.summary import choose, foreseen_of, write_summary
from read_pages import Page


def test_the_page_says_the_answer_and_shows_its_pictures(assessed):
    campaign, layout = load(assessed), Layout(assessed)
    [shown] = assessments_page(campaign, layout, read_summary(layout))
    text = (layout.report.parent / "assessments.html").read_text(encoding="utf-8")
    words = " ".join(Page(text).words.split())
    for sentence in shown.answer:
        assert " ".join(sentence.split()) in words
    assert text.count("<svg") == 3
    assert "broken.csv" in words
    assert "West" in words
    assert unescape(shown.pictures()["columns"].description).count("m/s") >= 3


def test_it_is_on_the_way_of_the_pages_and_on_paper(assessed):
    campaign, layout = load(assessed), Layout(assessed)
    folder = layout.report.parent
    assert 'href="assessments.html"' in layout.report.read_text(encoding="utf-8")
    assert 'href="../assessments.html"' in (folder / "tests" / "free-01.html").read_text(encoding="utf-8")
    titles = [chapter["title"] for chapter in document_of(campaign, folder).data["chapters"]]
    assert titles[-2:] == ["The real column", "Methods"]


@pytest.mark.whole
def test_each_forecast_is_listed_with_what_happened(foreseen_copy):
    (foreseen_copy / "forecasts" / "<b>.json").write_text("{}", encoding="utf-8")
    campaign, layout = load(foreseen_copy), Layout(foreseen_copy)
    graph, forecasts = Graph(campaign, layout, Catalogue(layout)), read_forecasts(layout)
    chosen = choose(campaign, forecasts, {name: {} for name in campaign.tests})
    summary = write_summary(graph, foreseen=foreseen_of(layout, forecasts, chosen))
    page = forecasts_page(layout, summary)
    assert [(row.forecast.level, row.entry.blind, row.happened) for row in page["rows"]] == [
        ("0.01 g", True, "not yet"),
        ("9x", True, "not yet"),
    ]
    shares = [tuple(text.replace("\xa0", " ") for text in row.models[0][1][:3]) for row in page["rows"]]
    assert shares == [("100 %", "0 %", "0 %"), ("0 %", "0 %", "100 %")]
    assert [entry.file for entry in page["refused"]] == ["<b>.json"]
    assert page["calibration"] is None
    Report(graph, forecasts=summary.forecasts).bring_up_to_date()
    folder = layout.report.parent
    text = (folder / "forecasts.html").read_text(encoding="utf-8")
    assert "0.01 g" in text
    assert "&lt;b&gt;.json" in text
    assert "<b>.json" not in text
    assert 'href="forecasts.html"' in layout.report.read_text(encoding="utf-8")
    chapters = [chapter["title"] for chapter in document_of(campaign, folder).data["chapters"]]
    assert chapters[-2:] == ["Forecasts", "Methods"]
