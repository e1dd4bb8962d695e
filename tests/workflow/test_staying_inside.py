"""Nothing is written or removed through a link in the folders of results; `results` puts them on another disk."""

import os
import shutil
from dataclasses import replace
from functools import partial
from hashlib import sha256

import pytest

from colonnade.campaign import load
from colonnade.cli import invoke
from colonnade.errors import CampaignError, StoreError
from colonnade.laboratory import prism_programme, write_campaign
from colonnade.store.layout import Layout
from colonnade.workflow.calibration import calibrate
from colonnade.workflow.maps import Wanted, make_maps

pytestmark = pytest.mark.usefixtures("undrawn")


def inside(folder, *places):
    return [f"{folder}/{place}".rstrip("/") for place in places]


FOLDERS = inside("processed", "", "tests", "tests/pulse-01", "specimens", "contact", "maps", "maps/.prism-linear")
FOLDERS += inside("report", "", "tests", "specimens")
FILES = inside("processed", "summary.json", "summary.csv", "catalogue.json", ".lock", ".lock-holder")
FILES += inside("processed/tests/pulse-01", "rocking.nc", ".rocking.nc.4711.partial")
FILES += inside("processed/specimens", "prism.nc")
FILES += inside("report", "index.html", "tests/pulse-01.html", "tests/gone.html")
needs_links = pytest.mark.skipif(os.name == "nt", reason="links need a right of their own on Windows")


@pytest.fixture
def elsewhere(tmp_path):
    """A folder of somebody else, with files that are called like results."""
    folder = tmp_path / "elsewhere"
    for name in ("summary.json", "recorded.nc", "index.html", "tests/gone.html", "key/000001.npz"):
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text("of somebody else", encoding="utf-8")
    return folder


def state(folder):
    return {
        path.relative_to(folder).as_posix(): (path.stat().st_mtime_ns, sha256(path.read_bytes()).hexdigest())
        for path in sorted(folder.rglob("*"))
        if path.is_file()
    }


def replace_by_link(path, target):
    if path.is_dir():
        shutil.rmtree(path)
    path.unlink(missing_ok=True)
    path.parent.mkdir(parents=True, exist_ok=True)
    path.symlink_to(target)


@needs_links
@pytest.mark.parametrize("place", FOLDERS)
def test_a_folder_of_results_that_is_a_link_is_refused_and_nothing_is_touched(small, elsewhere, place):
    replace_by_link(small.folder / place, elsewhere)
    before = state(elsewhere), small.files()
    opened = load(small.folder), small.layout
    run = partial(small.run, until="report", start_from="ingest")
    for work in (run, partial(make_maps, *opened, Wanted()), partial(calibrate, *opened)):
        with pytest.raises(StoreError, match=r"this is a link, to .*elsewhere.*--results"):
            work()
    assert (state(elsewhere), small.files()) == before


@pytest.mark.whole
@needs_links
def test_results_that_are_links_are_replaced_and_what_they_led_to_is_left_alone(small, undisturbed, elsewhere):
    for place in FILES:
        replace_by_link(small.folder / place, elsewhere / "recorded.nc")
    before = state(elsewhere)
    assert not small.run(until="report", start_from="ingest").failed
    assert state(elsewhere) == before
    assert [place for place in FILES if (small.folder / place).is_symlink()] == []
    assert small.contents() == undisturbed.contents()


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="named pipes are POSIX's")
@pytest.mark.parametrize("place", ["processed/catalogue.json", "processed/tests/pulse-01/recorded.nc", "report/x"])
def test_a_pipe_among_the_results_is_told_and_not_waited_for(small, place):
    (small.folder / place).unlink(missing_ok=True)
    os.mkfifo(small.folder / place)
    with pytest.raises(StoreError, match="neither a file nor a folder"):
        small.run(until="report")


@pytest.mark.whole
def test_results_may_lie_on_another_disk(untouched, undisturbed, tmp_path, capsys):
    other = tmp_path / "another disk"
    result = untouched.run(until="report", results=other)
    assert not result.failed
    assert (result.summary, result.report) == (other / "processed/summary.json", other / "report/index.html")
    assert sorted(path.name for path in untouched.folder.iterdir()) == ["campaign.toml", "raw"]
    written = {path.relative_to(other).as_posix() for path in other.rglob("*") if path.is_file()}
    results = {name for name in undisturbed.files() if not name.startswith(("raw/", "campaign"))}
    assert written == results | {"processed/.lock", "processed/.campaign"}
    assert untouched.redone(results=other) == {}
    (made,) = make_maps(load(untouched.folder), Layout(untouched.folder, other), Wanted(points=(2, 3), cycles=2.0))
    assert made.path.is_relative_to(other)
    for shown in ("tests", "specimens"):
        capsys.readouterr()
        assert invoke(["show", shown, str(untouched.folder), "--results", str(other)]) == 0
        assert "not run yet" not in capsys.readouterr().out.replace("pending", "not run yet")


def test_a_folder_for_results_that_is_a_file_is_told(untouched):
    with pytest.raises(StoreError, match=r"results cannot be written here .* --results"):
        untouched.run(results=untouched.folder / "campaign.toml")


@needs_links
def test_the_demo_writes_through_no_link_of_a_former_one(tmp_path, elsewhere):
    def one_trial(*arguments, **options):
        plan = prism_programme(*arguments, **options)
        return replace(plan, trials=plan.trials[:1])

    demo = tmp_path / "demo"
    record = tmp_path / "record.csv"
    record.write_text("time [s],acceleration [m/s^2]\n" + "".join(f"{n / 100},{n % 7 - 3}\n" for n in range(99)))
    write_campaign(demo, motion=record, programme=one_trial)
    before = state(elsewhere)
    for place, target in (next((demo / "raw").iterdir()), elsewhere / "recorded.nc"), (demo / "raw", elsewhere):
        replace_by_link(place, target)
        with pytest.raises((CampaignError, StoreError), match=r"is outside the campaign's folder|this is a link"):
            write_campaign(demo, motion=record, programme=one_trial)
    assert state(elsewhere) == before
