from colonnade.report.overview_page.confusion import confusions

MODELS = ("linear", "nonlinear")


def test_each_test_is_counted_once_by_measured_and_predicted_outcome(row_of):
    rows = [
        row_of("a", "rocking", 0.3, linear=("rocking", 0.3)),
        row_of("b", "rocking", 0.3, linear=("overturned", None)),
        row_of("c", "overturned", linear=("rocking", 0.8)),
        row_of("d", "overturned", linear=("rocking", 0.7)),
        row_of("e", "no-rocking", 0.0, linear=("no-rocking", 0.0)),
    ]
    (found,) = confusions(rows, MODELS)
    assert found.model == "linear"
    counted = {(cell.measured, cell.predicted): cell.tests for row in found.rows for cell in row if cell.tests}
    assert counted == {
        ("no-rocking", "no-rocking"): ("e",),
        ("rocking", "rocking"): ("a",),
        ("rocking", "overturned"): ("b",),
        ("overturned", "rocking"): ("c", "d"),
    }


def test_the_wrong_cells_are_those_with_tests_off_the_diagonal_the_fullest_first(row_of):
    rows = [row_of(name, "overturned", linear=("rocking", 0.8)) for name in "ab"]
    rows += [
        row_of("c", "rocking", 0.2, linear=("overturned", None)),
        row_of("d", "rocking", 0.2, linear=("rocking", 0.2)),
    ]
    (found,) = confusions(rows, MODELS)
    assert [(cell.measured, cell.predicted, cell.tests) for cell in found.wrong] == [
        ("overturned", "rocking", ("a", "b")),
        ("rocking", "overturned", ("c",)),
    ]


def test_what_was_only_seen_to_stand_agrees_with_every_outcome_but_overturning(row_of):
    rows = [
        row_of("a", None, observed_outcome="not-overturned", linear=("rocking", 0.2)),
        row_of("b", None, observed_outcome="not-overturned", linear=("overturned", None)),
    ]
    (found,) = confusions(rows, MODELS)
    assert [(cell.predicted, cell.tests) for cell in found.wrong] == [("overturned", ("b",))]


def test_a_model_without_a_known_outcome_has_no_table(row_of):
    assert confusions([row_of("a", None, linear=("rocking", 0.2)), row_of("b", "rocking", 0.2)], MODELS) == []
