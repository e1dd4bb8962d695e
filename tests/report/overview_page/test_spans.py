from colonnade.figures.stored import record
from colonnade.report.overview_page import spans
from colonnade.report.overview_page.spans import SpanTest


def test_spans_are_drawn_together_in_rising_order(reported, filled_campaign):
    block = filled_campaign[0].block("prism")
    tests = [
        SpanTest(row, record.span_panel(row.test, stored, block), "")
        for row, stored in reversed(list(reported.values()))
        if row.id.startswith("span")
    ]
    (group,) = spans.span_groups(tests)
    assert [entry.row.id for entry in group.tests] == ["span-2.0", "span-2.5", "span-3.0"]
    assert group.title.endswith(", prism, time scale 0.2236")


def test_one_span_alone_is_not_set_beside_itself(reported, filled_campaign):
    row, stored = reported["span-2.0"]
    alone = SpanTest(row, record.span_panel(row.test, stored, filled_campaign[0].block("prism")), "")
    assert spans.span_groups([alone]) == []
