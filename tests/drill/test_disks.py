"""A disk that fills and a folder that cannot be written: told in words, nothing half-written, taken up again."""

import random
import shutil

import pytest

pytestmark = pytest.mark.drill

FILLS = 15
SEED = 11
MEASURED = ("recorded.nc", "conditioned.nc", "rocking.nc", "restitution.nc")
"""Results that rest on one test. What is pooled or predicted without a free vibration that failed differs until it is
there, and is then made anew."""


def test_a_disk_that_fills_is_told_and_the_run_ends_after_room_was_made(
    undisturbed, copied, command, small_disk, capfd
):
    expected, summary, chance = undisturbed.contents(), undisturbed.summary(), random.Random(SEED)
    small, ballast = copied(small_disk / "small"), small_disk / "ballast"
    empty = shutil.disk_usage(small_disk).free
    assert command("run", small.folder, "--workers", 1)[0] == 0
    needed = empty - shutil.disk_usage(small_disk).free
    stopped = 0
    for number in range(FILLS):
        for folder in (small.layout.processed, small.folder / "report"):
            shutil.rmtree(folder)
        left = 0 if number == 0 else chance.randrange(needed)
        ballast.write_bytes(bytes(shutil.disk_usage(small_disk).free - left))
        code, told = command("run", small.folder, "--workers", 2 if number % 3 == 0 else 1)
        there = small.contents()
        measured = {name: content for name, content in there.items() if name.endswith(MEASURED)}
        assert measured.items() <= expected.items()
        assert not list(small.folder.rglob("*.partial"))
        if code:
            assert code == 1
            assert "the disk is full" in told or "results cannot be written here" in told, told
            stopped += 1
        else:
            assert there == expected
        ballast.unlink()
        assert command("run", small.folder, "--workers", 1)[0] == 0, number
        assert small.contents() == expected
        assert small.summary() == summary
    with capfd.disabled():
        print(f"\n{FILLS} times a full disk, where {needed / 1e6:.1f} MB are needed: {stopped} runs were stopped")
    assert stopped > FILLS // 2


@pytest.mark.parametrize("has_results", [False, True], ids=["never run", "with results of another day"])
@pytest.mark.parametrize("arguments", [("run",), ("run", "--from", "ingest"), ("ingest",), ("report",)])
def test_a_folder_that_may_not_be_written_is_told(copied, command, read_only, tmp_path, has_results, arguments):
    small = read_only(copied(tmp_path / "small", with_results=has_results).folder)
    before = set(small.rglob("*"))
    name, *rest = arguments
    code, told = command(name, small, *rest, "--workers", 1)
    assert code == 1
    assert "results cannot be written here" in told
    assert str(small) in told
    assert set(small.rglob("*")) == before


def test_what_only_looks_works_where_nothing_may_be_written(copied, command, read_only, tmp_path):
    small = read_only(copied(tmp_path / "small", with_results=True).folder)
    for arguments in (("check", small), ("show", "tests", small), ("show", "specimens", small), ("show", "settings")):
        code, told = command(*arguments)
        assert code == 0, told


@pytest.mark.parametrize("name", ["init", "demo"])
def test_a_new_campaign_where_nothing_may_be_written_is_refused(copied, command, read_only, tmp_path, name):
    small = read_only(copied(tmp_path / "small").folder / "raw")
    code, told = command(name, small if name == "init" else small / "demo")
    assert code == 1
    assert str(small) in told
    assert any(words in told for words in ("cannot be written", "Read-only", "Permission denied")), told
