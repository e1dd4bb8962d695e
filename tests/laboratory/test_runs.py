"""One test of the virtual laboratory: what its files get, and what its truth says."""

from __future__ import annotations

import json
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from colonnade.laboratory.experiment import MAIN, Plan, Recorder, Setup, Specimen, Trial
from colonnade.laboratory.files import FileFormat, Sheet
from colonnade.laboratory.instruments import Imperfections, Transducer
from colonnade.laboratory.runs import START_SCATTER, run_test, run_tests, write_truth
from colonnade.laboratory.table import ramped_sine
from colonnade.laboratory.truth import simulate
from prism import PRISM

TOP = Transducer("top", "Top", "displacement", "specimen", 0.15, "mm", at=(0.043, 0.0, 0.44))
TABLE = Transducer("table", "Table", "acceleration", "table", 20.0, "m/s^2")
LATE = 0.3
SHAKEN = ramped_sine(2.0, 1.2 * PRISM.uplift_acceleration, start=0.5, cycles=2, ramp=1)
PERFECT = Imperfections(noise=0.0, drift=0.0, zero=0.0)


@dataclass
class Kept(FileFormat):
    """A format that keeps the sheets it was to write."""

    suffix: str = ".kept"
    sheets: list[Sheet] = field(default_factory=list)

    def content(self, sheet: Sheet) -> bytes:
        self.sheets.append(sheet)
        return b"kept"


@pytest.fixture
def formats() -> tuple[Kept, Kept]:
    return Kept(), Kept()


@pytest.fixture
def plan(formats: tuple[Kept, Kept]) -> Plan:
    main, second = formats
    recorders = {MAIN: Recorder((TOP,), 500.0, main), "daq2": Recorder((TABLE,), 400.0, second, late=LATE)}
    trials = (
        Trial("free", "free-vibration", "both", duration=2.0, theta0=0.1, release=0.5),
        Trial("sine", "sine", "both", duration=3.0, table=SHAKEN, spikes=6, steady=(1.0, 2.0)),
        Trial("rest", "sine", "both", duration=1.0),
    )
    shape = {"shape": "prism"}
    return Plan("c", "C", {"prism": Specimen(shape, PRISM, 0.97)}, {"both": Setup(recorders, 0.28)}, trials, PERFECT)


def run(plan: Plan, number: int, folder: Path, seed: int = 4) -> dict[str, Any]:
    return run_test(plan, plan.trials[number], folder, np.random.SeedSequence(seed))


def test_each_recorder_has_a_clock_that_begins_at_its_own_start(
    plan: Plan, formats: tuple[Kept, Kept], tmp_path: Path
) -> None:
    starts = run(plan, 1, tmp_path)["recorder_starts"]
    assert starts[MAIN] == 0.0
    assert 0 < abs(starts["daq2"] - LATE) <= START_SCATTER
    for kept, rate, start in zip(formats, (500.0, 400.0), starts.values(), strict=True):
        (sheet,) = kept.sheets
        assert sheet.time.size == int((3.0 - start) * rate)
        np.testing.assert_allclose(sheet.time, np.arange(sheet.time.size) / rate, atol=1e-12)


def test_each_recorder_sees_the_moment_of_its_own_clock(plan: Plan, formats: tuple[Kept, Kept], tmp_path: Path) -> None:
    trial = replace(plan.trials[1], spikes=0)
    plan = replace(plan, trials=(trial,))
    start = run(plan, 0, tmp_path)["recorder_starts"]["daq2"]
    unit, volts = formats[1].sheets[0].columns["Table"]
    assert unit == "V"
    seen = SHAKEN.acceleration(formats[1].sheets[0].time + start) / 20.0 * 10.0
    np.testing.assert_allclose(volts, seen, atol=10.0 / 2**15)
    # At the clock of a recorder that had not been late, this would be another value.
    assert np.abs(volts - SHAKEN.acceleration(formats[1].sheets[0].time) / 2.0).max() > 0.1


def test_the_true_angle_is_that_of_the_simulation_at_the_main_clock(plan: Plan, tmp_path: Path) -> None:
    record = run(plan, 0, tmp_path)
    heading, *rows = (tmp_path / "truth" / "free.csv").read_text("utf-8").splitlines()
    assert heading == "time_s,angle_rad"
    time, angle = np.array([[float(each) for each in row.split(",")] for row in rows]).T
    truth = simulate(PRISM, time, restitution=0.97, theta0=0.1, release=0.5, catch=0.28)
    np.testing.assert_allclose(angle, truth.angle, atol=1e-9)
    assert record["impact_count"] == truth.impact_times.size > 0
    assert record["release_ratio"] == pytest.approx(0.1 / PRISM.critical_angle)
    assert (record["theta0"], record["release"], record["specimen"]) == (0.1, 0.5, "prism")


def test_tests_begin_24_minutes_apart(plan: Plan, formats: tuple[Kept, Kept], tmp_path: Path) -> None:
    for number in (2, 0):
        run(plan, number, tmp_path)
    first, third = np.datetime64("2013-05-14T09:00"), np.datetime64("2013-05-14T09:48")
    assert [sheet.begun for sheet in formats[0].sheets] == [third, first]


def test_nothing_happens_to_a_block_on_a_table_at_rest(plan: Plan, tmp_path: Path) -> None:
    record = run(plan, 2, tmp_path)
    assert (record["outcome"], record["pga"], record["impact_count"]) == ("no-rocking", 0.0, 0)
    assert (record["overturning_time"], record["release_ratio"], record["steady"]) == (None, None, None)
    assert record["channels"]["top"] == {"zero_volts": 0.0, "drift_volts": 0.0, "spikes": []}


def test_an_overturned_block_has_its_time_and_no_peak(plan: Plan, tmp_path: Path) -> None:
    fallen = replace(plan.trials[0], theta0=1.05 * PRISM.critical_angle)
    record = run(replace(plan, trials=(fallen,)), 0, tmp_path)
    assert (record["outcome"], record["peak_ratio"], record["overturning_time"]) == ("overturned", None, 0.5)


@pytest.mark.parametrize("seed", range(3))
def test_spikes_are_one_to_each_equal_part_of_a_record(plan: Plan, tmp_path: Path, seed: int) -> None:
    record = run(plan, 1, tmp_path, seed)
    sizes = {"top": 1500, "table": int((3.0 - record["recorder_starts"]["daq2"]) * 400.0)}
    shares = sorted(
        sample / sizes[channel] for channel, errors in record["channels"].items() for sample in errors["spikes"]
    )
    assert [int(6 * share) for share in shares] == list(range(6))
    assert all(0.09 < 6 * share % 1 < 0.91 for share in shares)


def test_the_largest_acceleration_is_that_of_the_table(plan: Plan, tmp_path: Path) -> None:
    record = run(plan, 1, tmp_path)
    largest = np.abs(SHAKEN.acceleration(np.linspace(0.5, 2.5, 4001))).max()
    assert largest > 1.2 * PRISM.uplift_acceleration  # a ramp of one cycle pushes more than the plateau
    assert record["pga"] == pytest.approx(largest, rel=1e-3)
    assert record["steady"] == [1.0, 2.0]


def test_each_test_has_a_seed_of_its_own_and_the_campaign_one_for_all(plan: Plan, tmp_path: Path) -> None:
    first, again, other = (run_tests(plan, tmp_path / str(place), seed, 1) for place, seed in enumerate((7, 7, 8)))
    assert list(first) == ["free", "sine", "rest"]
    assert first == again
    starts = [each["recorder_starts"]["daq2"] for found in (first, other) for each in found.values()]
    assert len(set(starts)) == 6


def test_the_truth_holds_specimens_errors_and_tests_and_reads_back(plan: Plan, tmp_path: Path) -> None:
    records = {"rest": run(plan, 2, tmp_path)}
    truth = write_truth(plan, records, tmp_path, 11)
    assert json.loads((tmp_path / "truth" / "truth.json").read_text("utf-8")) == truth
    assert truth["seed"] == 11
    assert truth["tests"] == records
    assert truth["imperfections"] == {"noise": 0.0, "drift": 0.0, "zero": 0.0}
    prism = truth["specimens"]["prism"]
    assert prism["restitution"] == 0.97
    # p² = m g R / I₀ of plane rocking.
    expected = np.sqrt(26.10 * PRISM.gravity * prism["pole_distance"] / prism["inertia"])
    assert prism["p"] == pytest.approx(expected, rel=1e-12)
