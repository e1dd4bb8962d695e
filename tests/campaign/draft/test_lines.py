"""What is drafted is TOML, whatever names files and columns have."""

from __future__ import annotations

import tomllib

from hypothesis import given
from hypothesis import strategies as st

from colonnade.campaign.draft.lines import Line, comment, key, value

TEXT = st.text(st.characters(exclude_categories=("Cs",)))


@given(name=TEXT.filter(bool), content=TEXT, said=TEXT)
def test_every_line_reads_back(name, content, said):
    text = f"{comment(said)}\n{Line(key(name), value({name: content}), said, said).text()}\n"
    assert tomllib.loads(text) == {name: {name: content}}
