"""Virtual campaigns on disk: what each test writes, the campaign that reads back, and the truth next to it."""

import json
from dataclasses import replace

import numpy as np
import pytest

from colonnade import campaign
from colonnade.campaign.channel import MAIN
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.rock import rock
from colonnade.errors import CampaignError, StoreError
from colonnade.laboratory.files import GERMAN, FileFormat
from colonnade.laboratory.plan import TESTS_A_DAY, Plan, Recorder, Trial, begun
from colonnade.laboratory.programme import COLUMNS, CYCLES, LADDERS, LASTING, MARGIN, RAMP, RAMPS, RESTITUTION, sine
from colonnade.laboratory.runs import START_SCATTER, run_test, write
from colonnade.laboratory.table import Imperfections, ramped_sine
from colonnade.laboratory.truth import simulate
from colonnade.workflow import executors
from prism import PRISM, campaign_of

pytestmark = pytest.mark.whole

VOLTS = 'unit = "V", range = "10 V", direction = [1, 0, 0]'
AT = 'on = "specimen", relative_to = "table", at = ["43 mm", "0 mm", "440 mm"]'
HEAD = campaign_of(
    f'top = {{column = "Top", quantity = "displacement", gain = "15 mm/V", {AT}, {VOLTS}}}',
    'table = {column = "Table", recorder = "daq2", quantity = "acceleration", gain = "2 m/s^2/V", on = "table", '
    f"{VOLTS}}}",
    before='[setups.frame]\ncatch = "0.28 rad"\nrecorders.daq2 = {}\n',
)
LATE = 0.3
SHAKEN = ramped_sine(2.0, 1.2 * PRISM.uplift_acceleration, start=0.5, cycles=2, ramp=1)
TRIALS = (
    Trial("free", "free-vibration", "frame", duration=2.0, theta0=0.1, release=0.5),
    Trial("sine", "sine", "frame", duration=3.0, table=SHAKEN, spikes=6),
    Trial("rest", "sine", "frame", duration=1.0),
)
PERFECT = Imperfections(noise=0.0, drift=0.0, zero=0.0)


def keeping(sheets):
    """Give a format that keeps the sheets it was to write."""

    def content(sheet):
        sheets.append(sheet)
        return b"kept"

    return FileFormat(".kept", content)


@pytest.fixture
def sheets():
    """Sheets of the main and of the second recorder."""
    return [], []


@pytest.fixture
def plan(sheets):
    main, second = map(keeping, sheets)
    recorders = {MAIN: Recorder(500.0, main), "daq2": Recorder(400.0, second, LATE)}
    return Plan(HEAD, {"prism": 0.97}, {"frame": recorders}, TRIALS, PERFECT)


def loaded(plan, folder):
    (folder / "campaign.toml").write_text(plan.campaign_text(), encoding="utf-8")
    return campaign.load(folder)


def run(plan, number, folder, seed=4):
    return run_test(plan, loaded(plan, folder), plan.trials[number], np.random.SeedSequence(seed))


def test_each_recorder_has_a_clock_that_begins_at_its_own_start(plan, sheets, tmp_path):
    starts = run(plan, 1, tmp_path)["recorder_starts"]
    assert starts[MAIN] == 0.0
    assert 0 < abs(starts["daq2"] - LATE) <= START_SCATTER
    for kept, rate, start in zip(sheets, (500.0, 400.0), starts.values(), strict=True):
        (sheet,) = kept
        assert sheet.time.size == int((3.0 - start) * rate)
        np.testing.assert_allclose(sheet.time, np.arange(sheet.time.size) / rate, atol=1e-12)


def test_each_recorder_sees_the_moment_of_its_own_clock(plan, sheets, tmp_path):
    plan = replace(plan, trials=(replace(plan.trials[1], spikes=0),))
    start = run(plan, 0, tmp_path)["recorder_starts"]["daq2"]
    (sheet,) = sheets[1]
    unit, volts = sheet.columns["Table"]
    assert unit == "V"
    np.testing.assert_allclose(volts, SHAKEN.acceleration(sheet.time + start) / 20.0 * 10.0, atol=10.0 / 2**15)
    # At the clock of a recorder that had not been late, this would be another value.
    assert np.abs(volts - SHAKEN.acceleration(sheet.time) / 2.0).max() > 0.1


def test_the_true_angle_is_that_of_the_simulation_at_the_main_clock(plan, tmp_path):
    record = run(plan, 0, tmp_path)
    path = tmp_path / "truth" / "free.csv"
    assert path.read_text("utf-8").startswith("time_s,angle_rad\n")
    time, angle = np.loadtxt(path, delimiter=",", skiprows=1, unpack=True)
    truth = simulate(PRISM, time, restitution=0.97, theta0=0.1, release=0.5, catch=0.28)
    np.testing.assert_allclose(angle, truth.angle, atol=1e-9)
    assert record["release_ratio"] == pytest.approx(0.1 / PRISM.critical_angle)
    assert record["specimen"] == "prism"


def test_a_block_at_rest_has_no_release_and_one_that_overturned_no_peak(plan, tmp_path):
    record = run(plan, 2, tmp_path)
    assert (record["outcome"], record["release_ratio"]) == ("no-rocking", None)
    fallen = replace(plan.trials[0], theta0=1.05 * PRISM.critical_angle)
    record = run(replace(plan, trials=(fallen,)), 0, tmp_path)
    assert (record["outcome"], record["peak_ratio"]) == ("overturned", None)


def test_the_truth_holds_specimens_and_tests_and_reads_back(plan, tmp_path):
    truth = write(plan, tmp_path, seed=11).truth
    assert json.loads((tmp_path / "truth" / "truth.json").read_text("utf-8")) == truth
    assert (truth["seed"], list(truth["tests"])) == (11, ["free", "sine", "rest"])
    assert truth["specimens"] == {"prism": {"restitution": 0.97}}


def plan_in_text():
    """The same in decimal commas, with noise."""
    recorders = {MAIN: Recorder(500.0, GERMAN), "daq2": Recorder(400.0, GERMAN, LATE)}
    return Plan(HEAD, {"prism": 0.97}, {"frame": recorders}, TRIALS)


def tree(folder):
    return {str(path.relative_to(folder)): path.read_bytes() for path in sorted(folder.rglob("*")) if path.is_file()}


def test_the_same_seed_gives_the_same_files_and_another_one_other_noise(tmp_path):
    for folder, seed in (("a", 1), ("b", 1), ("c", 2)):
        write(plan_in_text(), tmp_path / folder, seed=seed)
    first, again, other = (tree(tmp_path / folder) for folder in "abc")
    assert first == again
    assert first["campaign.toml"] == other["campaign.toml"]
    assert first["truth/free.csv"] == other["truth/free.csv"]
    assert first["raw/sine.csv"] != other["raw/sine.csv"]


def test_a_second_writing_leaves_the_files_alone(tmp_path):
    write(plan_in_text(), tmp_path, seed=1)
    paths = [path for path in tmp_path.rglob("*") if path.is_file()]
    times = [path.stat().st_mtime_ns for path in paths]
    write(plan_in_text(), tmp_path, seed=1)
    assert times == [path.stat().st_mtime_ns for path in paths]


@pytest.mark.parametrize(
    ("there", "error", "said"),
    [
        ("campaign.toml", CampaignError, "was not written by the virtual laboratory"),
        ("raw", StoreError, "cannot be"),
    ],
)
def test_a_folder_that_is_not_free_is_refused_and_left_alone(there, error, said, tmp_path):
    (tmp_path / there).write_text("schema = 1\n")
    with pytest.raises(error, match=said):
        write(plan_in_text(), tmp_path)
    assert (tmp_path / there).read_text() == "schema = 1\n"


def test_tests_follow_each_other_on_working_days_between_nine_and_four():
    moments = [begun(position) for position in range(10 * TESTS_A_DAY)]
    assert moments == sorted(set(moments))
    assert len({moment.date() for moment in moments}) == 10
    assert np.is_busday([moment.date() for moment in moments]).all()
    assert {moment.hour for moment in moments} == set(range(9, 16))


def test_several_processes_write_what_one_writes(tmp_path):
    for folder, workers in (("one", 1), ("two", 2)):
        write(plan_in_text(), tmp_path / folder, seed=1, workers=workers)
    assert tree(tmp_path / "one") == tree(tmp_path / "two")


def test_it_writes_after_a_run_has_left_its_processes_waiting(tmp_path):
    waiting = executors._processes(2)  # of another kind than those of joblib.Parallel
    assert list(waiting.pool.map(abs, [-1, -2])) == [1, 2]
    write(plan_in_text(), tmp_path, seed=1, workers=2)


def test_a_relative_folder_is_the_callers_whatever_processes_are_waiting(tmp_path, monkeypatch):
    write(plan_in_text(), tmp_path / "first", seed=1, workers=2)
    monkeypatch.chdir(tmp_path)
    write(plan_in_text(), "second", seed=1, workers=2)
    raw = [sorted(path.name for path in (tmp_path / name / "raw").iterdir()) for name in ("first", "second")]
    assert raw[0] == raw[1]


RUNGS = [(name, frequency) for name, steps in LADDERS.items() for frequency in steps]


@pytest.mark.parametrize(("name", "frequency"), RUNGS)
def test_the_outcome_is_the_same_at_the_ends_of_every_steps_neighbourhood(name, frequency):
    """By the nonlinear model: not the integrator that makes the truth."""
    block, steps = campaign.load(COLUMNS).block(name), LADDERS[name]
    cycles, ramp = CYCLES.get(frequency, LASTING), RAMPS.get(frequency, RAMP)
    table = sine(block, "sine", frequency, 1.0, cycles=cycles, ramp=ramp).table
    dt = 1 / (frequency * 300)
    unit = table.acceleration(np.arange(0.0, table.stop + 1.0, dt))

    def outcome(amplitude):
        motion = Motion(amplitude * unit, dt)
        return rock(block, motion, restitution=RESTITUTION[name], model="nonlinear").outcome

    found = [set(map(outcome, step * np.linspace(1 - MARGIN, 1 + MARGIN, 3))) for step in steps[frequency]]
    assert {len(around) for around in found} == {1}
    in_order = [next(iter(around)) for around in found]
    assert in_order[0] == "no-rocking"
    assert in_order[-1] == "overturned"
    assert ("rocking" in in_order) == (frequency >= 3.0)
