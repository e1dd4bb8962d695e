"""Reference motions are read by the rule for raw files: wrapped rows, or one of several columns."""

from __future__ import annotations

import numpy as np
import pytest

from colonnade.campaign import load
from colonnade.stages.parts import reference_motions

SERIES = np.round(np.cumsum(np.random.default_rng(5).standard_normal(800)) / 40, 5)


def rows(table, form):
    return "\n".join("".join(form % number for number in row) for row in table) + "\n"


@pytest.fixture
def with_motions(small_campaign):
    def written(motions):
        text = small_campaign.path.read_text(encoding="utf-8")
        small_campaign.path.write_text(text.replace("[setups.frame]", f"[motions]\n{motions}\n\n[setups.frame]", 1))
        return reference_motions.reference_files(load(small_campaign.path))

    return written


def test_one_of_three_components_has_to_be_named(small_campaign, with_motions):
    (small_campaign.folder / "valley.dat").write_text(
        "3F10.4\n        NS        EW        UD\n" + rows(SERIES[:798].reshape(3, -1).T, "%10.4f")
    )
    warnings = []
    known = with_motions(
        'Valley = {file = "valley.dat", interval = "0.02 s"}\n'
        'North = {file = "valley.dat", interval = "0.02 s", column = "NS"}'
    )
    loaded = reference_motions.load(known, warnings)
    (told,) = [str(warning) for warning in warnings]
    assert '"Valley" cannot be used' in told
    assert "3 columns may be the acceleration" in told
    assert loaded["North"].acceleration.size == 266
