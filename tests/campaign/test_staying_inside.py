"""Whatever a campaign names is taken from its own folder, also where a folder or file in it is a link to elsewhere."""

import shutil

import pytest

from colonnade.campaign import load
from colonnade.errors import CampaignError

LOG = "id,kind,specimen,setup,file\nfree-01,free-vibration,prism,frame,raw/free-01.csv\n"
REVIEW = 'schema = 1\n[[exclude]]\ntest = "free-01"\nwho = "A"\nwhen = 2013-04-26\nwhy = "b"\n'


def raw_file(contract, written):
    return contract.replace('file = "raw/span20.csv"', f'file = "{written}/span20.csv"', 1)


def motion(contract, written):
    return contract.replace("[setups.frame]\n", f'[motions]\nValley = "{written}/valley.txt"\n\n[setups.frame]\n', 1)


def log_of_tests(contract, written):
    head = contract[: contract.index("[[tests]]")]
    return head.replace("[specimens]", f'tests = "{written}/tests.csv"\n\n[specimens]', 1)


PLACES = {"a raw file": raw_file, "a motion": motion, "the log of tests": log_of_tests}


@pytest.mark.parametrize("written", ["..", "raw/../..", "away", "raw/away", "../campaign-2"])
@pytest.mark.parametrize("place", PLACES.values(), ids=PLACES.keys())
def test_a_path_out_of_the_folder_is_refused(contract, load_text, tmp_path, tmp_path_factory, place, written):
    elsewhere = tmp_path_factory.mktemp("elsewhere")
    (elsewhere / "tests.csv").write_text(LOG, encoding="utf-8")
    (tmp_path / "raw").mkdir()
    for link in (tmp_path / "away", tmp_path / "raw" / "away"):
        link.symlink_to(elsewhere)
    with pytest.raises(CampaignError, match="is outside the campaign's folder"):
        load_text(place(contract, written))


def test_a_review_that_is_a_link_out_of_the_folder_is_refused(contract, load_text, tmp_path, tmp_path_factory):
    review = tmp_path_factory.mktemp("elsewhere") / "review.toml"
    review.write_text(REVIEW, encoding="utf-8")
    (tmp_path / "review.toml").symlink_to(review)
    with pytest.raises(CampaignError, match="is outside the campaign's folder"):
        load_text(contract)


@pytest.mark.parametrize("named", [".", "campaign.toml"])
def test_a_campaign_file_that_is_a_link_belongs_to_the_folder_it_stands_in(contract, load_text, tmp_path, named):
    load_text(contract)
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    shutil.move(tmp_path / "campaign.toml", elsewhere / "campaign.toml")
    (tmp_path / "campaign.toml").symlink_to(elsewhere / "campaign.toml")
    assert load(tmp_path / named).folder == tmp_path
