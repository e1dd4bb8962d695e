def row(reported, test):
    return reported[test][0]


def test_models_that_predict_another_outcome_are_named(reported):
    assert row(reported, "span-3.0").differing == ["linear", "nonlinear"]
    assert row(reported, "span-2.0").differing == []


def test_what_was_seen_counts_if_nothing_was_measured(reported):
    watched = row(reported, "watched")
    assert watched.record.outcome is None
    assert watched.outcome == "not-overturned"
    assert watched.agrees("linear") is True


def test_a_failure_is_told_with_its_stage(reported):
    (failure,) = row(reported, "sine-dead").failures
    assert failure.stage == "ingest"
    assert "the file is empty" in failure.text


def test_a_test_that_was_not_run_has_no_results_and_no_verdict(reported):
    later = row(reported, "later")
    assert not later.has_results
    assert later.agrees("linear") is None
    assert later.predicted("linear").outcome is None


def test_a_reviewed_test_says_so(reported):
    assert row(reported, "span-2.5").reviewed
    assert not row(reported, "span-2.0").reviewed
