"""Five hundred damaged raw and campaign files, seeded: read, warned of or refused with a message, never a traceback."""

import random
from collections import Counter
from pathlib import Path

import pytest

from colonnade import campaign as campaigns
from colonnade.errors import CampaignError, ColonnadeError
from colonnade.readers.registry import read
from colonnade.stages.ingest import IngestInputs, ingest
from damage import KINDS, damaged

pytestmark = pytest.mark.whole

EXAMPLE = Path(__file__).resolve().parents[2] / "raw_schema" / "examples" / "delimited"


def _raw_file_outcome(path, campaign):
    """Read and ingest as a run does."""
    test = campaign.tests["free-01"]
    try:
        recording = read(path)
        recorded = ingest({"main": recording}, IngestInputs.of(campaign, test))
    except ColonnadeError as error:
        return "refused" if len(str(error)) > 20 else "refused without a word"
    return "warned" if recorded.attrs["warnings"] else "read"


def _campaign_file_outcome(path):
    try:
        campaign = campaigns.load(path)
    except CampaignError as error:
        return "refused" if path.name in str(error) else "refused without a place"
    return "warned" if campaign.warnings else "read"


@pytest.mark.parametrize("kind", KINDS)
def test_damaged_files_are_read_warned_of_or_refused(kind, tmp_path):
    chance, campaign = random.Random(kind), campaigns.load(EXAMPLE)
    sound, sound_raw = campaign.path.read_bytes(), campaign.tests["free-01"].files["main"].read_bytes()
    counts = {"raw": Counter(), "campaign": Counter()}
    for number in range(21):
        raw = tmp_path / f"raw-{number}.csv"
        raw.write_bytes(damaged(sound_raw, kind, chance))
        counts["raw"][_raw_file_outcome(raw, campaign)] += 1
        (tmp_path / str(number)).mkdir()
        of_it = tmp_path / str(number) / "campaign.toml"
        of_it.write_bytes(damaged(sound, kind, chance))
        counts["campaign"][_campaign_file_outcome(of_it)] += 1
    assert counts["raw"].keys() | counts["campaign"].keys() <= {"read", "warned", "refused"}
    assert counts["raw"]["refused"] + counts["raw"]["warned"] > 0
    assert counts["campaign"]["refused"] > 0
