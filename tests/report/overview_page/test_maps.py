from colonnade.report.overview_page import maps


def test_a_map_has_the_boundaries_that_its_tests_bracket(rows, filled_campaign):
    (drawn,) = maps.measured_maps(filled_campaign[0], rows)
    assert drawn.specimen == "prism"
    assert drawn.boundaries == (("3.347", "below 3.783", "below 3.783", "no test without rocking"),)
