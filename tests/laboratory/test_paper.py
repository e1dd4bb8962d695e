"""The paper's programme: what is planned, and that each of its file formats reads back as a campaign."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace
from math import pi
from pathlib import Path

import numpy as np
import pytest

from colonnade import campaign
from colonnade.dynamics.motion import Motion
from colonnade.laboratory.experiment import Plan
from colonnade.laboratory.programme import paper_programme
from colonnade.laboratory.runs import write
from colonnade.readers.registry import read


@pytest.fixture(scope="module")
def plan() -> Plan:
    record = Motion(np.sin(np.arange(400) * 0.1) * np.hanning(400), 0.02)
    return paper_programme("a wave", record, seed=3)


def test_every_specimen_has_three_free_vibrations_three_spans_and_sines(plan: Plan) -> None:
    counted = Counter((plan.specimen_of(trial), trial.kind) for trial in plan.trials)
    for specimen in ("prism", "cylinder", "cone"):
        assert counted[specimen, "free-vibration"] == counted[specimen, "earthquake"] == 3
        assert counted[specimen, "sine"] >= 7
    frequencies = {trial.entry["frequency"] for trial in plan.trials if trial.kind == "sine"}
    assert frequencies == {f"{hertz} Hz" for hertz in range(1, 8)}


@pytest.mark.parametrize("frequency", [1.0, 7.0])
def test_a_sine_is_steady_while_it_says_so(plan: Plan, frequency: float) -> None:
    trial = next(each for each in plan.trials if each.entry.get("frequency") == f"{frequency:g} Hz")
    start, stop = trial.steady
    times = np.arange(start, stop, 1e-3)
    amplitude = float(trial.name.rsplit("-", 1)[1]) * plan.specimens["prism"].block.uplift_acceleration
    expected = amplitude * np.sin(2 * pi * frequency * (times - 1.5))
    np.testing.assert_allclose(trial.table.acceleration(times), expected, atol=1e-9)


@pytest.mark.parametrize(
    ("specimen", "suffixes"),
    [("prism", (".csv", ".csv")), ("cylinder", (".tdms", ".csv")), ("cone", (".mat", ".tdms"))],
)
def test_the_files_of_both_recorders_read_back(
    plan: Plan, specimen: str, suffixes: tuple[str, str], tmp_path: Path
) -> None:
    mine = [trial for trial in plan.trials if trial.specimen == specimen]
    chosen = (mine[0], next(trial for trial in mine if trial.kind == "sine"))
    written = write(replace(plan, trials=chosen), tmp_path, seed=1)
    loaded = campaign.load(written.path)
    block, true = loaded.specimens[specimen].block(loaded.gravity), written.truth["specimens"][specimen]
    assert (block.critical_angle, block.p) == pytest.approx((true["critical_angle"], true["p"]), rel=1e-12)
    for trial in chosen:
        test = loaded.tests[trial.name]
        assert test.specimen == specimen
        assert tuple(path.suffix for path in test.files.values()) == suffixes[: len(test.files)]
        setup = loaded.setups[test.setup]
        for recorder, path in test.files.items():
            options = setup.recorders[recorder].file
            recording = read(path, options.format, options.options)
            assert recording.warnings == ()
            assert path.suffix != ".tdms" or recording.start.date() == test.date
            for channel in (each for each in setup.channels.values() if each.recorder == recorder):
                column = recording.channel(channel.column)
                assert column.unit in (channel.unit, None)
                np.testing.assert_allclose(np.diff(column.time), 1 / (500 if recorder == "main" else 400), atol=1e-9)
                assert np.abs(column.values).max() < 9.99
