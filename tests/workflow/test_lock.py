"""One run at a time; a crash frees the lock and leaves nothing in the way."""

import shutil

import pytest

from colonnade.errors import StoreError
from colonnade.store.layout import Layout
from colonnade.workflow.lock import only_run

HOLD = """
import sys, time
from pathlib import Path
from colonnade.store.layout import Layout
from colonnade.workflow.lock import only_run
with only_run(Layout(Path(sys.argv[1]))):
    print("held", flush=True)
    time.sleep(60)
"""


@pytest.fixture
def holder(start, small):
    return start(HOLD, small.folder, said="held")


def test_a_second_run_at_the_same_time_is_refused_and_told_who_runs(small, holder):
    before = small.files()
    with pytest.raises(StoreError, match=f"process {holder.pid} on"):
        small.run()
    assert small.files() == before


def test_a_crash_frees_the_lock_also_after_a_run_that_was_refused(small, holder):
    with pytest.raises(StoreError):
        small.run()
    holder.kill()
    holder.wait()
    for _ in range(2):
        assert not small.run().failed
        assert not small.layout.lock_holder.exists()


@pytest.mark.parametrize("place", ["processed/tests/pulse-01/.rocking.nc.4711.partial", "report/.a.html.4711.partial"])
def test_half_a_file_of_a_killed_run_is_swept(small, place):
    half = small.folder / place
    half.write_bytes(b"half")
    small.run()
    assert not half.exists()


def run_once(campaign_file, results=None):
    with only_run(Layout.of(campaign_file, results)):
        pass


def test_two_campaigns_or_files_do_not_share_one_folder_of_results_and_a_copy_is_a_campaign_of_its_own(small, tmp_path):
    results, other = tmp_path / "results", shutil.copytree(small.folder, tmp_path / "other")
    of_small, of_other = small.folder / "campaign.toml", other / "campaign.toml"
    for _ in range(2):
        run_once(of_small, results)
    run_once(of_other)
    with pytest.raises(StoreError, match=r"results of another campaign, .*small.campaign\.toml, are in this folder"):
        run_once(of_other, results)
    with pytest.raises(StoreError, match="results of another campaign"):
        run_once(of_other, small.folder)
    second = shutil.copy(of_small, small.folder / "second.toml")
    with pytest.raises(StoreError, match=r"another campaign, .*campaign\.toml, .* of its own with --results"):
        run_once(second)
    run_once(small.folder.rename(tmp_path / "moved") / "campaign.toml", results)
