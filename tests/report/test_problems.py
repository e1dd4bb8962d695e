from colonnade.campaign.forms.summary import Warned
from colonnade.report.problems import warning_groups


def warned(text, severity="warning", stage="ingest"):
    return Warned(stage=stage, severity=severity, kind="quality", text=text)


def test_warnings_that_differ_in_their_numbers_alone_are_one_group():
    groups = warning_groups([("a", warned("3 spikes at 1.2 s")), ("b", warned("17 spikes at 0.3 s"))])
    assert [(group.first.text, group.subjects) for group in groups] == [("3 spikes at 1.2 s", ["a", "b"])]


def test_a_number_in_a_name_is_part_of_the_name():
    groups = warning_groups([("a", warned("channel top-1 is dead")), ("a", warned("channel top-2 is dead"))])
    assert len(groups) == 2


def test_stage_and_severity_keep_groups_apart():
    given = [("a", warned("5 m")), ("a", warned("5 m", stage="condition")), ("a", warned("5 m", severity="note"))]
    assert len(warning_groups(given)) == 3


def test_the_worst_come_first_and_then_what_most_tests_have():
    given = [("a", warned("one")), ("a", warned("two")), ("b", warned("two")), ("c", warned("bad", "serious"))]
    assert [group.first.text for group in warning_groups(given)] == ["bad", "two", "one"]


def test_a_subject_with_the_same_warning_twice_is_named_once():
    (group,) = warning_groups([("a", warned("1 gap")), ("a", warned("2 gaps"))])
    assert group.subjects == ["a"]
