"""What one sees first of a campaign with a wrong gain, a wrong outcome and a failed test; findings that are alike."""

import re

import pytest

from colonnade.campaign.forms.summary import Warned
from colonnade.report.overview import warning_groups
from colonnade.store.layout import Layout
from colonnade.workflow import run
from small_campaign import write_small_campaign

WRONG_GAIN = """
schema = 1

[[correct]]
test = "span-2.0"
channel = "top"
factor = 10
who = "N. N."
when = 2013-04-26
why = "a slip"
"""


@pytest.fixture(scope="module")
def first(made_once):
    """Words of the overview up to its summary."""
    page = Layout(made_once("urgent", _run)).report.read_text(encoding="utf-8")
    main = page[page.index("<main") : page.index('<section id="summary">')]
    return " ".join(re.sub(r"<[^>]+>", " ", main).split())


def _run(folder):
    write_small_campaign(folder)
    (folder / "review.toml").write_text(WRONG_GAIN, encoding="utf-8")
    path = folder / "campaign.toml"
    text = path.read_text(encoding="utf-8").replace("members = 20", "members = 0")
    text = text.replace('id = "span-2.5"', 'id = "span-2.5"\nobserved_outcome = "overturned"')
    path.write_text(text, encoding="utf-8")
    run(folder, only=["span-2.0", "span-2.5", "span-3.0", "sine-dead"], workers=1)


@pytest.mark.whole
def test_what_needs_a_look_comes_in_the_order_in_which_it_matters(first):
    assert re.match(r"What needs a look 1 test failed sine-dead ingest: sine-dead\.csv: the file is empty", first)
    wrong = first[first.index("Results are wrong until this is corrected") :]
    assert re.search(r"serious \w+: Channel top .* gain wrong by a factor of 10.*? In span-2\.0", wrong)
    assert re.search(
        r"serious compare: The transducers show rocking, the test log says overturned.*? In span-2\.5", wrong
    )
    missed = wrong[wrong.index("Outcomes that a model misses") :]
    assert re.search(r"The linear model predicts overturned in 1 test measured as rocking : span-3\.0", missed)
    assert re.search(r"All findings , with .*\d+ notes? that do(es)? not affect results\.$", missed)


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
