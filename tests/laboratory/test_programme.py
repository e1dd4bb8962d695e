"""What the virtual laboratory plans: records, kinds of test, the paper's programme and its file formats."""

import time
from collections import Counter
from dataclasses import replace
from math import sqrt

import numpy as np
import pytest

from colonnade import campaign
from colonnade.dynamics.motion import Motion
from colonnade.errors import ReadError
from colonnade.laboratory.files import MATLAB, TDMS, Sheet
from colonnade.laboratory.programme import (
    QUIET,
    RELEASES,
    SPANS,
    earthquakes,
    free_vibrations,
    load_record,
    paper_programme,
    sine,
)
from colonnade.laboratory.runs import write
from colonnade.readers.registry import read
from prism import PRISM


@pytest.mark.parametrize("heading", ["time (s),acceleration (g)\n", ""], ids=["unit told", "no unit told"])
def test_a_file_of_ones_own_is_played_under_its_name_whatever_its_unit(heading, tmp_path):
    path = tmp_path / "north.csv"
    values = 0.2 * np.sin(np.arange(200))
    rows = [f"{0.01 * k:.2f},{value:.6f}" for k, value in enumerate(values)]
    path.write_text(heading + "\n".join(rows) + "\n")
    name, motion = load_record(path)
    assert name == "north"
    assert motion.dt == pytest.approx(0.01)
    np.testing.assert_allclose(motion.acceleration / motion.peak, values / np.abs(values).max(), atol=1e-4)


def test_a_file_in_which_nothing_moves_is_refused(tmp_path):
    path = tmp_path / "still.csv"
    path.write_text("time (s),acceleration (g)\n" + "".join(f"{0.01 * k:.2f},0.0\n" for k in range(50)))
    with pytest.raises(ReadError, match="every acceleration is zero"):
        load_record(path)


RECORD = Motion(np.sin(np.arange(400) * 0.1) * np.hanning(400), 0.02)


@pytest.mark.parametrize("seed", range(5))
def test_free_vibrations_start_near_their_angles_on_a_table_at_rest(seed):
    trials = list(free_vibrations(PRISM, np.random.default_rng(seed)))
    assert [trial.name for trial in trials] == ["free-01", "free-02", "free-03"]
    for trial, ratio in zip(trials, RELEASES, strict=True):
        assert trial.theta0 / PRISM.critical_angle == pytest.approx(ratio, abs=0.02)
        assert trial.release == pytest.approx(QUIET, abs=0.2)
        assert trial.table.stop == 0.0
        assert (trial.kind, trial.setup) == ("free-vibration", "bench")


@pytest.mark.parametrize("frequency", [1.0, 2.5])
def test_a_sine_reaches_its_multiple_of_g_tan_alpha_between_its_ramps(frequency):
    trial = sine(PRISM, "sine", frequency, 1.4, cycles=6, ramp=2)
    assert (trial.name, trial.kind, trial.setup) == ("sine", "sine", "table")
    assert trial.entry == {"frequency": f"{frequency:g} Hz"}
    assert trial.table.stop == pytest.approx(QUIET + 10 / frequency)
    assert trial.duration == pytest.approx(trial.table.stop + 4.0)
    steady = np.linspace(QUIET + 2 / frequency, QUIET + 8 / frequency, 2401)
    amplitude = 1.4 * PRISM.gravity * np.tan(PRISM.critical_angle)
    assert np.abs(trial.table.acceleration(steady)).max() == pytest.approx(amplitude, rel=1e-12)
    assert not trial.table.acceleration(np.linspace(0.0, QUIET - 1e-9, 50)).any()


def test_an_earthquake_is_played_at_three_spans_and_in_the_models_time():
    trials = list(earthquakes("a wave", RECORD))
    assert [trial.name for trial in trials] == ["span-2.0", "span-2.5", "span-3.0"]
    for trial, span in zip(trials, SPANS, strict=True):
        assert trial.entry == {"motion": "a wave", "span": span, "time_scale": pytest.approx(0.223607, abs=5e-7)}
        # Times of a 1:20 model are shorter by √20, accelerations are not: similitude of Froude.
        assert trial.table.stop - QUIET == pytest.approx(RECORD.duration / sqrt(20), rel=1e-9)
        assert trial.duration == pytest.approx(trial.table.stop + 9.0)
        played = trial.table.acceleration(QUIET + RECORD.time / sqrt(20))
        assert np.abs(played).max() == pytest.approx(1.5 * span, rel=0.05)
        assert np.corrcoef(played, RECORD.acceleration)[0, 1] > 0.999
        assert trial.spikes == 3


@pytest.fixture(scope="module")
def plan():
    return paper_programme("a wave", RECORD, seed=3)


def test_every_specimen_has_three_free_vibrations_three_spans_and_sines(plan):
    counted = Counter((trial.specimen, trial.kind) for trial in plan.trials)
    for specimen in ("prism", "cylinder", "cone"):
        assert counted[specimen, "free-vibration"] == counted[specimen, "earthquake"] == 3
        assert counted[specimen, "sine"] >= 7
    frequencies = {trial.entry["frequency"] for trial in plan.trials if trial.kind == "sine"}
    assert frequencies == {f"{hertz} Hz" for hertz in range(1, 8)}


@pytest.mark.parametrize("written", [TDMS, MATLAB], ids=["tdms", "matlab"])
def test_the_same_sheet_gives_the_same_bytes_at_another_time(written, monkeypatch):
    clock = np.arange(1000) / 400.0
    sheet = Sheet(clock, 400.0, {"top": ("V", np.sin(clock))}, np.datetime64("2013-05-14T09:00:00", "us"))
    first = written.content(sheet)
    monkeypatch.setattr(time, "asctime", lambda *_: "Thu Jan  1 00:00:00 1970")
    assert written.content(sheet) == first


SUFFIXES = {"prism": (".csv", ".csv"), "cylinder": (".tdms", ".csv"), "cone": (".mat", ".tdms")}


@pytest.mark.parametrize(("specimen", "suffixes"), SUFFIXES.items())
def test_the_files_of_both_recorders_read_back(plan, specimen, suffixes, tmp_path):
    mine = [trial for trial in plan.trials if trial.specimen == specimen]
    chosen = (mine[0], next(trial for trial in mine if trial.kind == "sine"))
    written = write(replace(plan, trials=chosen), tmp_path, seed=1)
    loaded = campaign.load(written.path)
    for trial in chosen:
        test = loaded.tests[trial.name]
        assert test.specimen == specimen
        assert tuple(path.suffix for path in test.files.values()) == suffixes[: len(test.files)]
        setup = loaded.setups[test.setup]
        for recorder, path in test.files.items():
            recording = read(path, setup.recorders[recorder].file.format, setup.recorders[recorder].file.options)
            assert recording.warnings == ()
            for channel in (each for each in setup.channels.values() if each.recorder == recorder):
                column = recording.channel(channel.column)
                assert column.unit in (channel.unit, None)
                np.testing.assert_allclose(np.diff(column.time), 1 / (500 if recorder == "main" else 400), atol=1e-9)
                assert np.abs(column.values).max() < 9.99  # of a range of 10 V
