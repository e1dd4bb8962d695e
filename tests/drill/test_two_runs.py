"""Two runs of a campaign at once: one works, the other is refused and told by whom, and nothing is damaged."""

import random
import shutil
import time

import pytest

from processes import started

pytestmark = pytest.mark.drill

ROUNDS = 5
SEED = 3


def test_of_two_runs_at_once_one_works_and_the_other_is_refused(undisturbed, copied, tmp_path, capsys):
    expected, summary, chance = undisturbed.contents(), undisturbed.summary(), random.Random(SEED)
    refused = 0
    for number in range(ROUNDS):
        small = copied(tmp_path / str(number))
        runs = [started("run", small.folder, "--workers", 2)]
        time.sleep(chance.uniform(0.0, 1.0))
        runs.append(started("run", small.folder, "--workers", 2))
        ended = [(run, *run.communicate(timeout=300)) for run in runs]
        assert sorted({0, *(run.returncode for run, _, _ in ended)}) in ([0], [0, 1])
        assert any(run.returncode == 0 for run, _, _ in ended)
        for run, _, complaints in ended:
            assert "Traceback" not in complaints
            if run.returncode:
                refused += 1
                assert "this campaign is already being run, by" in complaints
                other = next(each for each in runs if each is not run)
                assert f"process {other.pid} on" in complaints or "by another process" in complaints
        assert small.contents() == expected
        assert small.summary() == summary
        assert not list(small.folder.rglob("*.partial"))
        shutil.rmtree(small.folder)
    with capsys.disabled():
        print(f"\n{ROUNDS} times two runs at once: {refused} were refused")
    assert refused > ROUNDS // 2
