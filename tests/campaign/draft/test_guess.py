"""What a column and a file are taken for: by units and names, with the reason, and what is asked."""

import numpy as np
import pytest

from colonnade.campaign.draft.guess import channel_lines, draft_channels, meaning
from colonnade.campaign.draft.survey import Column, RawFile, arrange
from colonnade.campaign.draft.write import DraftSetup

TIME = 0.01 * np.arange(2000)
SINE = np.sin(2 * np.pi * 3.0 * TIME)
DECAY = np.exp(-TIME) * np.cos(6 * TIME)
NOISE = np.random.default_rng(1).standard_normal(TIME.size)
STILL = 1e-3 * NOISE


def column(name, unit=None, spread=1.0, *, is_clock=False):
    return Column(1, name, f"{name} [{unit}]", unit, is_clock, True, spread)


@pytest.mark.parametrize(
    ("name", "unit", "quantity", "because"),
    [
        ("LVDT 1", None, "displacement", 'from "lvdt" in its name'),
        ("Channel 3", "mm", "displacement", 'from its unit "mm"'),
        ("top", "g", "acceleration", 'from its unit "g"'),
        ("top", "V", None, ""),
    ],
)
def test_the_quantity_has_its_reason(name, unit, quantity, because):
    found = meaning(column(name, unit))
    assert (found.quantity, found.because) == (quantity, because)


def test_a_unit_counts_more_than_a_name():
    assert meaning(column("LVDT 1", "g")).quantity == "acceleration"


@pytest.mark.parametrize(
    ("each", "reason"),
    [
        (column("t", "s", is_clock=True), "the clock"),
        (column("LVDT 1", "mm", 0.0), "it never changes in any of these files"),
        (column("LVDT 1", "mm", -1.0), "it holds no number in any of these files"),
        (column("Trigger"), 'a synchronisation signal, from "trigger" in its name'),
    ],
    ids=["clock", "constant", "empty", "trigger"],
)
def test_what_measures_nothing_is_left_out_with_the_reason(each, reason):
    assert meaning(each) == reason


def test_the_place_and_the_axis_are_read_from_the_name():
    found = meaning(column("Tischweg X", "mm"))
    assert (found.place, found.place_word, found.axis) == ("table", 'from "tischweg" in its name', "x")


def named_column(number, name, unit=None):
    return Column(number, name, name, unit, False, True, 1.0)


def lines_of(*named):
    columns = [named_column(n, *each) for n, each in enumerate(named, start=1)]
    channels, _ = draft_channels({"main": columns})
    found = [[line.partition(" = ") for line in channel_lines(each, columns)] for each in channels.values()]
    return [{key: written for key, _, written in lines} for lines in found]


def test_a_displacement_on_the_specimen_is_asked_for_what_no_file_contains():
    (lines,) = lines_of(("LVDT 1", "V"))
    assert [key for key, line in lines.items() if '"?' in line] == ["gain", "at", "relative_to"]
    assert lines["gain"].startswith('"? mm/V"')
    assert lines["quantity"].endswith('# from "lvdt" in its name')


def test_an_acceleration_is_taken_to_be_the_tables():
    (lines,) = lines_of(("ACC_Y", "g"))
    assert lines["on"].startswith('"table"    # ? what it is fixed to or looks at: "specimen", "table", "ground"')
    question = "? of a positive reading; [0, -1, 0] if it is reversed (from its name)"
    assert lines["direction"] == f"[0, 1, 0]    # {question}"


@pytest.mark.parametrize(
    ("unit", "question"),
    [
        (None, "the file gives no unit: "),
        ("furlong", 'the file gives "furlong", which is not a known unit: '),
    ],
)
def test_a_unit_that_is_missing_or_unknown_is_asked_for(unit, question):
    (lines,) = lines_of(("LVDT 1", unit))
    assert lines["unit"] == f'"?"    # ? {question}write one such as "mm", or "V" with a line gain = "10 mm/V"'


def test_columns_called_the_same_are_named_by_their_number():
    first, second = lines_of(("LVDT", "mm"), ("LVDT", "mm"))
    assert (first["column"], second["column"]) == ("1", "2")


def test_unknown_columns_are_left_out_beside_known_ones():
    channels, left_out = draft_channels({"main": [named_column(1, "LVDT 1", "mm"), named_column(2, "strange", "V")]})
    assert list(channels) == ["lvdt_1"]
    assert left_out == {"neither its unit nor its name shows what it measures": ["strange"]}


def test_unknown_columns_alone_are_asked_about():
    channels, left_out = draft_channels({"main": [named_column(n, f"strange {n}") for n in range(1, 15)]})
    assert len(channels) == 14
    assert left_out == {}


def drafted_tests(folder, files):
    for name, (specimen, table) in files.items():
        folder.write(f"{name}.csv", {"LVDT 1 [mm]": specimen, "Table disp [mm]": table})
    written, drafted = folder.draft()
    return {test["id"]: test for test in written["tests"]}, drafted


def test_a_name_says_the_kind_and_the_numbers_that_belong_to_it(folder):
    files = {"sine_3Hz": (NOISE, SINE), "El Centro span 2.5": (NOISE, NOISE), "free 1": (DECAY, STILL)}
    tests, _ = drafted_tests(folder, files)
    assert (tests["sine_3Hz"]["kind"], tests["sine_3Hz"]["frequency"]) == ("sine", "3 Hz")
    assert tests["El-Centro-span-2.5"]["kind"] == "earthquake"
    assert tests["free-1"]["kind"] == "free-vibration"


def test_a_name_that_says_nothing_leaves_the_kind_to_people(folder):
    tests, drafted = drafted_tests(folder, {"a": (DECAY, STILL)})
    assert tests["a"]["kind"] == "other"
    assert 'kind = "other"    # ? its name does not show what was done' in drafted.text


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("usp000hzq8", {}),
        ("run-0hz", {}),
        ("sine-3hz", {"frequency": "3 Hz"}),
        ("sine_2p5 Hz", {"frequency": "2.5 Hz"}),
    ],
)
def test_only_a_number_that_can_be_one_is_taken_from_a_name(folder, name, said):
    folder.write(f"{name}.csv", {"LVDT 1 [mm]": np.random.default_rng(2).standard_normal(TIME.size)})
    (test,) = folder.draft()[0]["tests"]
    assert {key: test[key] for key in ("frequency",) if key in test} == said


def raw(relative, *names, spread=1.0):
    columns = tuple(Column(n, name, name, "mm", False, True, spread) for n, name in enumerate(names, start=1))
    return RawFile(relative, "delimited", columns)


def test_files_with_the_same_columns_are_of_one_setup():
    setups, copies = arrange([raw("a.csv", "top"), raw("b.csv", "bottom"), raw("c.csv", "top")])
    assert [[test["main"].relative for test in tests] for tests in setups] == [["a.csv", "c.csv"], ["b.csv"]]
    assert copies == []


@pytest.mark.parametrize(
    ("first", "second", "recorder"),
    [
        ("span-2.csv", "span-2-daq2.csv", "daq2"),
        ("x_box1.csv", "x_box2.csv", "box2"),
        ("x/daq1.csv", "x/daq2.csv", "daq2"),
        ("x.csv", "x.tdms", "tdms"),
    ],
)
def test_files_of_two_recorders_are_one_test(first, second, recorder):
    ((test,),), _ = arrange([raw(first, "LVDT 1"), raw(second, "ACC")])
    assert {name: file.relative for name, file in test.items()} == {"main": first, recorder: second}


def test_a_column_is_shown_as_in_the_file_where_it_moves_most():
    (tests,), _ = arrange([raw("a.csv", "top", spread=0.1), raw("b.csv", "top", spread=3.0)])
    setup = DraftSetup(tests)
    assert [column.spread for column in setup.columns["main"]] == [3.0]
    assert list(setup.channels) == ["top"]
