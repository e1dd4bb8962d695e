"""Nothing is said of sound tests, whatever the block, the rig, the motion and the noise."""

import pytest

from colonnade.campaign import load
from colonnade.findings import Severity
from colonnade.workflow.check import check
from sound_tests import KINDS, write_sound

MOST = 0.01
"""Share of the tests with a false warning."""


def _doubted(folder, seeds):
    """What `check` says, above notes, of the campaigns of some seeds: by campaign and test."""
    said = {}
    for seed in seeds:
        checked = check(load(write_sound(folder / str(seed), seed)))
        found = [(test, finding) for test, findings in checked.findings.items() for finding, _ in findings]
        above = [(test, finding.text) for test, finding in found if finding.severity is not Severity.NOTE]
        above += [(stage.subject, stage.reason) for stage in checked.stages if stage.action == "failed"]
        for test, text in above:
            said.setdefault((seed, test), []).append(text)
    return said


@pytest.mark.whole
def test_one_campaign_of_each_rig_is_sound(tmp_path):
    # 60: rocking alone would blame an accelerometer that agrees with the displacement; 9: noise in a displacement.
    seeds = (60, 1, 2, 3, 9)
    assert _doubted(tmp_path, seeds) == {}


@pytest.mark.slow
def test_of_500_sound_tests_at_most_one_in_a_hundred_is_doubted(tmp_path):
    seeds = range(500 // len(KINDS))
    said = _doubted(tmp_path, seeds)
    assert len(said) <= MOST * len(KINDS) * len(seeds), said
