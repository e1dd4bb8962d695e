"""A folder in which most files are no recordings: which ones are is asked first, and little else."""

import re
import tomllib

import numpy as np
import pytest

from colonnade.campaign import load
from colonnade.campaign.draft.write import MOST_SETUPS, draft
from colonnade.errors import CampaignError

pytestmark = pytest.mark.whole

TIME = np.arange(0.0, 1.0, 0.01)
SINE = np.sin(2 * np.pi * 8 * TIME)
TABLES = {
    "calibration": ("load", "indicated", "deviation"),
    "climate": ("temperature", "humidity", "pressure", "wind"),
    "survey": ("easting", "northing", "height"),
    "phone": ("ax", "ay", "az", "gx", "gy", "gz"),
    "spectra": ("period", "Sa 2 %", "Sa 5 %"),
    "damper": ("stroke [mm]", "force [kN]"),
    "modal": ("mode", "f1", "f2", "f3", "f4"),
    "gps": ("lat", "lon", "alt", "fix"),
    "crane": ("rope [m]", "angle [deg]"),
    "oil": ("p1", "p2", "p3", "p4", "level"),
}


def nameless(path, columns, rate):
    rows = (np.round(SINE * (number + 1), 5) for number in range(columns))
    lines = zip(np.arange(TIME.size) / rate, *rows, strict=True)
    path.write_text("".join(" ".join(f"{value:.5f}" for value in line) + "\n" for line in lines))


@pytest.fixture
def messy(folder):
    """66 files, of which six are recordings of tests."""
    for number in range(1, 7):
        folder.write(f"tests/free-{number:02d}.csv", {"LVDT 1 [mm]": SINE * np.exp(-5 * TIME), "ACC [g]": 0.01 * SINE})
    for number, (name, heads) in enumerate(TABLES.items()):
        for copy in range(4):
            columns = {head: SINE * (place + 1) + copy for place, head in enumerate(heads)}
            folder.write(f"{name}/{name}_{copy}.csv", columns, clock=None if number % 2 else "Time [s]")
    for copy in range(10):
        points = "".join(f"{value:15.7E}" + "\n" * (place % 5 == 4) for place, value in enumerate(SINE))
        head = "PEER NGA\nSomewhere\nACCELERATION TIME SERIES IN UNITS OF G\nNPTS=  100, DT= .01000 SEC\n"
        (folder.path / f"RSN{copy}.AT2").write_text(head + points)
    for copy in range(10):
        nameless(folder.path / f"run{copy}.dat", 2, 100 if copy < 5 else 200)
    assert sum(path.is_file() for path in folder.path.rglob("*")) == 66
    return folder


def test_a_messy_folder_asks_first_which_files_are_recordings(messy):
    document, drafted = messy.draft()
    assert drafted.asks_first
    assert drafted.setups == 14
    assert {"setups", "tests"} & document.keys() == set()  # each group is a comment until it is wanted
    assert [question.key.rpartition(".")[2] for question in drafted.open] == ["width", "depth", "height", "mass"]
    assert "66 files of 14 kinds were found." in drafted.text
    assert [line.partition(":")[0] for line in drafted.text.splitlines() if line.startswith("# ====")] == [
        f"# ==== Group {number} of 14" for number in range(1, 15)
    ]


def test_a_group_without_its_comment_signs_is_the_draft_of_its_files_alone(messy, tmp_path_factory):
    """What a person does with an editor: keep one group and the head, and answer what is asked."""
    _, drafted = messy.draft()
    head, *groups = drafted.text.split("\n# ==== ")
    (kept,) = (group for group in groups if "tests/free-01.csv" in group.splitlines()[0])
    text = "\n".join([head, *(line.removeprefix("# ") for line in kept.splitlines()[1:]), ""])
    answers = {"width": "86 mm", "depth": "86 mm", "height": "456 mm", "mass": "26.1 kg", "relative_to": "table"}
    for key, answer in answers.items():
        text = re.sub(rf'^{key} = "\?.*?"', f'{key} = "{answer}"', text, flags=re.MULTILINE)
    drafted.path.write_text(text.replace('["? mm", "0 mm", "? mm"]', '["43 mm", "0 mm", "440 mm"]'), encoding="utf-8")
    campaign = load(drafted.path)
    assert list(campaign.tests) == [f"free-{number:02d}" for number in range(1, 7)]
    (setup,) = campaign.setups.values()
    assert {channel.quantity for channel in setup.channels.values()} == {"displacement", "acceleration"}


def test_files_without_names_are_grouped_by_what_they_are(folder):
    for number, rate in enumerate((100, 100, 200)):
        nameless(folder.path / f"run{number}.dat", 2, rate)
    nameless(folder.path / "other.txt", 2, 100)
    document, _ = folder.draft()
    of_setup = {}
    for test in document["tests"]:
        of_setup.setdefault(test["setup"], []).append(test["file"])
    assert sorted(of_setup.values()) == [["other.txt"], ["run0.dat", "run1.dat"], ["run2.dat"]]


def test_a_campaign_of_a_few_setups_is_drafted_in_full(folder):
    for number in range(MOST_SETUPS):
        folder.write(f"free-{number}.csv", {f"LVDT {number} [mm]": SINE})
    _, drafted = folder.draft()
    assert not drafted.asks_first
    assert drafted.setups == MOST_SETUPS


def test_a_file_in_which_nothing_moves_is_left_out(folder):
    folder.write("free-01.csv", {"LVDT 1 [mm]": SINE})
    folder.write("dead.csv", {"top [mm]": np.zeros(TIME.size), "sync": SINE})
    document, drafted = folder.draft()
    assert [test["id"] for test in document["tests"]] == ["free-01"]
    ((name, reason),) = drafted.refused
    assert name == "dead.csv"
    assert "none of its columns measures anything" in reason
    assert '"top [mm]": it never changes' in reason
    (folder.path / "free-01.csv").unlink()
    with pytest.raises(CampaignError, match="no file has a column that measures anything"):
        draft(folder.path)


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("usp000hzq8", {}),
        ("run-0hz", {}),
        ("sine-3hz", {"frequency": "3 Hz"}),
        ("sine_2p5 Hz", {"frequency": "2.5 Hz"}),
        ("span0", {}),
        ("span-2,5", {"span": 2.5}),
        ("lifespan3", {}),
    ],
)
def test_only_a_number_that_can_be_one_is_taken_from_a_name(folder, name, said):
    folder.write(f"{name}.csv", {"LVDT 1 [mm]": np.random.default_rng(2).standard_normal(TIME.size)})
    (test,) = folder.draft()[0]["tests"]
    assert {key: test[key] for key in ("frequency", "span") if key in test} == said


def test_line_numbers_hold_behind_signs_that_look_like_line_ends(folder):
    folder.write("a\x85b\u2028c.csv", {"LVDT 1 [mm]": SINE})
    drafted = folder.draft()[1]
    drafted.path.write_text(drafted.text, encoding="utf-8")
    with pytest.raises(CampaignError) as told:
        load(drafted.path)
    assert [f"line {question.line}: " in str(told.value) for question in drafted.open] == [True] * len(drafted.open)
    assert tomllib.loads(drafted.text)["tests"][0]["file"] == "a\x85b\u2028c.csv"
