"""Five hundred damaged raw and campaign files, seeded: read, warned of or refused with a message, never a traceback."""

import random
from collections import Counter

import numpy as np
import pytest

from colonnade import campaign as campaigns
from colonnade.errors import CampaignError, ColonnadeError
from colonnade.readers.registry import read
from colonnade.stages.ingest import IngestInputs, ingest
from damage import KINDS, damaged
from prism import SPECIMEN, entry

pytestmark = pytest.mark.whole

CAMPAIGN = f"""schema = 1
campaign = "damaged"
title = "Damaged"

[specimens]
{SPECIMEN}

[setups.frame]
catch = "0.3 rad"

[setups.frame.channels.top]
column = "LVDT 1"
quantity = "displacement"
unit = "V"
gain = "10.02 mm/V"
offset = "-0.13 mm"
range = "10 V"
on = "specimen"
at = ["43 mm", "0 mm", "440 mm"]
direction = [1, 0, 0]
relative_to = "table"

{entry("free-01", "free-vibration")}"""


def _raw_text():
    time = np.arange(0, 2, 0.01)
    rows = "".join(f"{t:.2f};{5 * np.exp(-t) * np.sin(9 * t):.4f};{np.cos(t):.4f}\n".replace(".", ",") for t in time)
    return "Messung 12, Prüfstand\nZeit;LVDT 1;ACC\ns;V;g\n" + rows


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
def test_damaged_files_are_read_warned_of_or_refused(kind, tmp_path, capsys):
    chance = random.Random(kind)
    sound = tmp_path / "campaign.toml"
    sound.write_text(CAMPAIGN, encoding="utf-8")
    campaign = campaigns.load(sound)
    counts = {"raw": Counter(), "campaign": Counter()}
    for number in range(21):
        raw = tmp_path / f"raw-{number}.csv"
        raw.write_bytes(damaged(_raw_text().encode("latin-1"), kind, chance))
        counts["raw"][_raw_file_outcome(raw, campaign)] += 1
        (tmp_path / str(number)).mkdir()
        of_it = tmp_path / str(number) / "campaign.toml"
        of_it.write_bytes(damaged(CAMPAIGN.encode(), kind, chance))
        counts["campaign"][_campaign_file_outcome(of_it)] += 1
    with capsys.disabled():
        print(f"\n{kind}: " + "; ".join(f"{what} {dict(sorted(each.items()))}" for what, each in counts.items()))
    assert counts["raw"].keys() | counts["campaign"].keys() <= {"read", "warned", "refused"}
    assert counts["raw"]["refused"] + counts["raw"]["warned"] > 0
    assert counts["campaign"]["refused"] > 0
