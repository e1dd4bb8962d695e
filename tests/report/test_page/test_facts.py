"""Facts as every section lists them: what is not known is left out."""

from __future__ import annotations

from colonnade.report.test_page.facts import known
from colonnade.store.records.wording import NOTHING


def test_what_is_not_known_or_has_no_label_is_left_out_and_the_order_stays():
    facts = [("b", "2 mm"), ("", "3 mm"), ("c", ""), ("d", NOTHING), ("a", "0 mm")]
    assert known(facts) == [("b", "2 mm"), ("a", "0 mm")]
