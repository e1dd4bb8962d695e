"""Ids of tests and channels are such as the campaign file takes, whatever files are called."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from colonnade.campaign.draft.naming import unique
from colonnade.campaign.syntax.identifier import clashes, identifier


@given(st.lists(st.text(), max_size=8))
def test_ids_are_valid_and_differ(names):
    ids = unique(names, "test", as_variables=True)
    assert [identifier(each) for each in ids] == ids
    assert not clashes(ids, as_variables=True)
