import json
from dataclasses import replace

from colonnade.dynamics.maps.chart import stability_map
from colonnade.report.overview_page import maps
from colonnade.store import files
from colonnade.store.layout import Layout
from colonnade.store.records.stability_map import as_dataset

STRONG = "sine-3hz-too-strong-for-the-block-1"
ONE = [("3.347", "below 3.783", "below 3.783", "no test without rocking")]


def with_another(rows, frequency_ratio):
    """Add a sine test of another Ω that rocked."""
    (row,) = (row for row in rows if row.id == STRONG)
    changes = {"frequency_ratio": frequency_ratio, "amplitude_ratio": 1.5, "outcome": "rocking"}
    record = row.record.model_copy(update=changes)
    return [*rows, replace(row, test=row.test.model_copy(update={"id": "another"}), record=record)]


def test_tests_at_one_frequency_make_no_map_but_bracket_boundaries(rows, filled_campaign):
    (drawn,) = maps.measured_maps(*filled_campaign, rows)
    assert (drawn.specimen, drawn.computed, drawn.measured) == ("prism", None, None)
    assert list(drawn.boundaries) == ONE


def test_two_frequencies_make_a_map_whose_marks_lead_to_their_tests(rows, filled_campaign):
    (drawn,) = maps.measured_maps(*filled_campaign, with_another(rows, 5.0))
    assert drawn.computed is None
    assert [f'href="test:{name}"' in drawn.measured.svg for name in (STRONG, "another")] == [True, True]
    assert len(drawn.boundaries) == 2


def test_computed_maps_are_drawn_with_the_tests_and_a_failed_one_is_not(rows, filled_campaign, tmp_path):
    campaign, layout = filled_campaign[0], Layout(tmp_path)
    chart = stability_map(
        campaign.block("prism"),
        restitution=0.93,
        frequency_ratio=[3.0, 5.5],
        amplitude_ratio=[1.0, 2.0],
        cycles=3,
        model="nonlinear",
    )
    attributes = {"stage": "map", "settings": json.dumps(chart.options)}
    files.write_failed(layout.stage("prism", "map", "linear"), "no", attributes=attributes)
    files.write(as_dataset(chart), layout.stage("prism", "map", "nonlinear"), attributes=attributes)
    (drawn,) = maps.measured_maps(campaign, layout, with_another(rows, 5.0))
    assert "nonlinear: lower limit" in drawn.computed.svg
    assert ">linear: lower limit" not in drawn.computed.svg
    assert 'href="test:another"' in drawn.computed.svg
