"""A folder of raw files becomes a campaign file: what is guessed, what is asked, what is left out."""

import tomllib

import numpy as np
import pytest

from colonnade.campaign import load
from colonnade.campaign.draft.write import draft
from colonnade.errors import CampaignError
from filling_in import filled_in

TIME = np.arange(0.0, 10.0, 0.01)
SINE = np.sin(2 * np.pi * 3.0 * TIME)
DECAY = np.where(TIME < 7, np.exp(-TIME) * np.cos(2 * np.pi * TIME), 0.0)


def noise(seed=0):
    return 1e-3 * np.random.default_rng(seed).normal(size=TIME.size)


def channels(document, setup="setup"):
    return document["setups"][setup]["channels"]


def open_keys(drafted):
    return [drafted.text.split("\n")[number - 1].partition(" = ")[0] for number in drafted.open]


def test_names_and_units_become_channels_and_what_no_file_tells_is_asked(folder):
    folder.write("free-01.csv", {"LVDT 1 [mm]": DECAY, "Tischweg [mm]": noise(), "ACC_Y [g]": noise(1)})
    document, drafted = folder.draft()
    moved = {"quantity": "displacement", "unit": "mm", "direction": [1, 0, 0]}
    top = {"column": "LVDT 1", "on": "specimen", "at": ["? mm", "0 mm", "? mm"], "relative_to": "?"}
    table = {"quantity": "acceleration", "unit": "g", "on": "table", "direction": [0, 1, 0]}
    assert channels(document) == {
        "lvdt_1": moved | top,
        "tischweg": moved | {"column": "Tischweg", "on": "table"},
        "acc_y": table | {"column": "ACC_Y"},
    }
    assert open_keys(drafted) == ["width", "depth", "height", "mass", "at", "relative_to"]


def test_every_open_question_is_refused_by_its_line(folder):
    folder.write("free-01.csv", {"LVDT 1 [V]": DECAY, "strange [mm]": noise()}, clock=None)
    _, drafted = folder.draft()
    drafted.path.write_text(drafted.text, encoding="utf-8")
    with pytest.raises(CampaignError) as told:
        load(drafted.path)
    assert all(f"line {number}: " in str(told.value) for number in drafted.open)


def test_a_voltage_asks_for_its_gain_and_a_file_without_clock_for_its_rate(folder):
    folder.write("free-01.csv", {"LVDT 1 [V]": DECAY, "acc [mV/g]": SINE}, clock=None)
    document, _ = folder.draft()
    assert document["setups"]["setup"]["sampling_rate"] == "? Hz"
    assert channels(document)["lvdt_1"]["gain"] == "? mm/V"
    assert channels(document)["acc"]["gain"].startswith("? g/")


def test_what_is_no_measurement_is_left_out_with_the_reason(folder):
    folder.write("free-01.csv", {"LVDT 1 [mm]": DECAY, "LED Light": SINE})
    document, drafted = folder.draft()
    assert list(channels(document)) == ["lvdt_1"]
    (told,) = (line for line in drafted.text.splitlines() if '"LED Light"' in line)
    assert told.startswith("#")
    assert "a synchronisation signal" in told


def test_a_channel_that_moves_in_one_file_is_not_dead_in_another(folder):
    folder.write("a.csv", {"LVDT 1 [mm]": np.zeros(TIME.size)})
    folder.write("b.csv", {"LVDT 1 [mm]": DECAY})
    assert list(channels(folder.draft()[0])) == ["lvdt_1"]


def test_files_of_two_recorders_become_one_test_each(folder):
    for span in ("span-2.0", "span-10.0"):
        folder.write(f"raw/{span}.csv", {"LVDT 1 [mm]": noise(), "Table disp [mm]": SINE})
        folder.write(f"raw/{span}-daq2.csv", {"Table acc [g]": SINE})
    document, _ = folder.draft()
    assert document["setups"]["setup"]["recorders"]["daq2"]["clock"] == "?"
    assert channels(document)["table_acc"]["recorder"] == "daq2"
    assert [(test["id"], test["file"]["daq2"]) for test in document["tests"]] == [
        ("span-2.0", "raw/span-2.0-daq2.csv"),
        ("span-10.0", "raw/span-10.0-daq2.csv"),
    ]


def test_the_same_recording_in_two_formats_is_taken_once(folder):
    folder.write("free.csv", {"LVDT 1 [mm]": DECAY})
    folder.write("free.txt", {"lvdt 1 [mm]": DECAY}, delimiter="\t")
    document, drafted = folder.draft()
    assert [test["file"] for test in document["tests"]] == ["free.csv"]
    assert "# free.txt: the same columns as free.csv" in drafted.text


def test_repetitions_are_tests_of_their_own_in_one_setup(folder):
    for name in ("free.csv", "free-2.csv", "free-repeated.csv"):
        folder.write(name, {"LVDT 1 [mm]": DECAY})
    document, drafted = folder.draft()
    assert [test["id"] for test in document["tests"]] == ["free", "free-2", "free-repeated"]
    assert drafted.setups == 1


def test_what_is_no_recording_is_named_with_the_reason(folder):
    folder.write("free.csv", {"LVDT 1 [mm]": DECAY})
    (folder.path / "notes.csv").write_text("nothing but words\n", encoding="utf-8")
    (folder.path / "photo.png").write_bytes(b"\x89PNG")
    _, drafted = folder.draft()
    assert [name for name, _ in drafted.refused] == ["notes.csv"]


def test_the_real_shake_table_recordings_of_others(shared_data, tmp_path):
    import shutil

    shutil.copytree(shared_data / "shaketable", tmp_path / "table", copy_function=shutil.copyfile)
    drafted = draft(tmp_path / "table")
    document = tomllib.loads(drafted.text)
    tests = {test["id"]: test for test in document["tests"]}
    assert tests["earthquake-test1"]["kind"] == "earthquake"
    assert tests["sinewave-test1"]["kind"] == "sine"
    assert tests["thadhaines_01"]["kind"] == "other"
    found = channels(document, tests["thadhaines_01"]["setup"])
    assert {name: (each["quantity"], each["unit"], each["on"]) for name, each in found.items()} == {
        "table_accel_xxxx": ("acceleration", "g's", "table"),
        "block_accel_26430": ("acceleration", "g's", "specimen"),
    }
    assert document["setups"][tests["sinewave-test1"]["setup"]]["sampling_rate"] == "? Hz"


def test_columns_in_threes_are_markers_of_an_optical_system(folder):
    moved = {f"d{drum}{axis} [mm]": DECAY + noise(drum) for drum in (1, 2) for axis in "XYZ"}
    folder.write("free-01.csv", moved | {"Table_X [mm]": noise(7), "Table_Y [mm]": noise(8), "Table_Z [mm]": noise(9)})
    document, drafted = folder.draft()
    setup = document["setups"]["setup"]
    unknown = {"unit": "mm", "on": "?", "at": ["? mm", "? mm", "? mm"]}
    assert setup["markers"] == {
        name: {"columns": [f"{name}{axis}" for axis in "XYZ"]} | unknown for name in ("d1", "d2")
    }
    assert setup["tracking"] == {"axes": [[1, 0, 0], [0, 1, 0], [0, 0, 1]], "relative_to": "?"}
    assert list(setup["channels"]) == ["table_x", "table_y", "table_z"]
    answers = {"relative_to": '"table"', "on": '"specimen"', "at": '["50 mm", "0 mm", "100 mm"]', "mass": '"10 kg"'}
    filled_in(drafted, lambda table, key: answers.get(key, '"0.1 m"'))
    assert {"d1_x", "d2_z", "table_y"} <= load(drafted.path).setups["setup"].channels.keys()


def test_a_file_in_which_nothing_moves_is_left_out(folder):
    folder.write("free-01.csv", {"LVDT 1 [mm]": SINE})
    folder.write("dead.csv", {"top [mm]": np.zeros(TIME.size), "sync": SINE})
    document, drafted = folder.draft()
    assert [test["id"] for test in document["tests"]] == ["free-01"]
    ((name, reason),) = drafted.refused
    assert name == "dead.csv"
    assert "no column measures anything" in reason
    assert "it never changes" in reason
    (folder.path / "free-01.csv").unlink()
    with pytest.raises(CampaignError, match="no readable recording found"):
        draft(folder.path)


def test_a_name_that_looks_like_a_question_is_none(folder):
    for name in ("a    # ? c.csv", "b    # ? c.csv"):
        folder.write(name, {"LVDT 1 [mm]": SINE})
    document, drafted = folder.draft()
    assert [test["file"] for test in document["tests"]] == ["a    # ? c.csv", "b    # ? c.csv"]
    assert "file" not in open_keys(drafted)


def test_line_numbers_hold_behind_signs_that_look_like_line_ends(folder):
    folder.write("a\x85b\u2028c.csv", {"LVDT 1 [mm]": SINE})
    drafted = folder.draft()[1]
    drafted.path.write_text(drafted.text, encoding="utf-8")
    with pytest.raises(CampaignError) as told:
        load(drafted.path)
    assert all(f"line {number}: " in str(told.value) for number in drafted.open)
    assert tomllib.loads(drafted.text)["tests"][0]["file"] == "a\x85b\u2028c.csv"
