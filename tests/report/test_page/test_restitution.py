from colonnade.report.test_page import restitution


def test_the_recommended_estimator_gives_the_value_with_its_interval(reported):
    row, stored = reported["free-01"]
    facts = dict(restitution.facts_of(stored, row.record.restitution))
    assert facts["e"].startswith("0.930")
    assert " ± 0.0" in facts["e"]
    assert "refused" not in facts
    (chosen,) = (each for each in restitution.estimates_of(stored) if each.recommended)
    assert facts["recommended estimator"] == chosen.name
    assert facts["assumptions"] == chosen.assumptions
    assert "interval" not in chosen.value


def test_a_refused_identification_has_a_reason_and_no_value(reported):
    row, stored = reported["free-refused"]
    facts = dict(restitution.facts_of(stored, row.record.restitution))
    assert "e" not in facts
    assert "recommended estimator" not in facts
    assert facts["refused"].startswith("e of single impacts scatters by")


def test_an_estimator_without_a_value_says_why(reported):
    without = [each for each in restitution.estimates_of(reported["free-refused"][1]) if each.value == "–"]
    assert without
    assert all(each.reason and each.assumptions for each in without)


def test_a_test_of_another_kind_has_no_restitution(reported):
    row, stored = reported["span-2.0"]
    assert restitution.facts_of(stored, row.record.restitution) == []
    assert restitution.estimates_of(stored) == []
