from colonnade.figures.stored import record
from colonnade.report import overview
from colonnade.report.overview import SpanTest


def rows(reported):
    return [row for row, _ in reported.values()]


def test_sines_of_known_amplitude_are_in_the_ladder_and_all_others_by_kind(reported, filled_campaign):
    prism, statue = overview.by_specimen(filled_campaign[0], rows(reported))
    assert [(group.frequency, [row.id for row in group.tests]) for group in prism.sines] == [
        ("3 Hz", ["sine-3hz-too-strong-for-the-block-1"])
    ]
    assert prism.steps == 1
    assert {group.title: [row.id for row in group.tests] for group in prism.kinds} == {
        "Free vibrations": ["free-01", "free-refused"],
        "Sine tests of unknown amplitude": ["sine-dead", "later"],
        "Earthquake tests": ["span-2.0", "span-2.5", "span-3.0"],
    }
    assert statue.steps == 0


def test_a_map_has_the_boundaries_that_its_tests_bracket(reported, filled_campaign):
    (drawn,) = overview.measured_maps(filled_campaign[0], rows(reported))
    assert drawn.specimen == "prism"
    assert drawn.boundaries == (("3.347", "below 3.783", "below 3.783", "no test without rocking"),)


def test_spans_are_drawn_together_in_rising_order(reported, filled_campaign):
    block = filled_campaign[0].block("prism")
    tests = [
        SpanTest(row, record.span_panel(row.test, stored, block), "")
        for row, stored in reversed(list(reported.values()))
        if row.id.startswith("span")
    ]
    (group,) = overview.span_groups(tests)
    assert [entry.row.id for entry in group.tests] == ["span-2.0", "span-2.5", "span-3.0"]
    assert group.title.endswith(", prism, time scale 0.2236")


def test_one_span_alone_is_not_set_beside_itself(reported, filled_campaign):
    row, stored = reported["span-2.0"]
    alone = SpanTest(row, record.span_panel(row.test, stored, filled_campaign[0].block("prism")), "")
    assert overview.span_groups([alone]) == []
