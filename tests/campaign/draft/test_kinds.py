"""The kind of a test, by the name of its file and by how table and specimen move."""

from __future__ import annotations

import numpy as np
import pytest

TIME = 0.01 * np.arange(2000)
SINE = np.sin(2 * np.pi * 3.0 * TIME)
DECAY = np.exp(-TIME) * np.cos(6 * TIME)
NOISE = np.random.default_rng(1).standard_normal(TIME.size)
STILL = 1e-3 * NOISE


def drafted_tests(folder, files):
    for name, (specimen, table) in files.items():
        folder.write(f"{name}.csv", {"LVDT 1 [mm]": specimen, "Table disp [mm]": table})
    written, drafted = folder.draft()
    return {test["id"]: test for test in written["tests"]}, drafted


def test_a_name_says_the_kind_and_the_numbers_that_belong_to_it(folder):
    files = {"sine_3Hz": (NOISE, SINE), "El Centro span 2.5": (NOISE, NOISE), "free 1": (DECAY, STILL)}
    tests, _ = drafted_tests(folder, files)
    assert (tests["sine_3Hz"]["kind"], tests["sine_3Hz"]["frequency"]) == ("sine", "3 Hz")
    centro = tests["El-Centro-span-2.5"]
    assert (centro["kind"], centro["motion"], centro["span"]) == ("earthquake", "El Centro", 2.5)
    assert tests["free-1"]["kind"] == "free-vibration"


def test_without_a_name_the_signals_say_it(folder):
    tests, drafted = drafted_tests(folder, {"a": (NOISE, SINE), "b": (DECAY, STILL), "c": (NOISE, NOISE)})
    assert [tests[name]["kind"] for name in "abc"] == ["sine", "free-vibration", "other"]
    assert tests["a"]["frequency"] == "3 Hz"
    asked = {(each.key, each.asked) for each in drafted.doubts}
    assert ("tests[a].kind", "guessed from its signal") in asked
    assert any(key == "tests[c].kind" and "neither name nor signal shows it" in said for key, said in asked)


@pytest.mark.parametrize(
    ("name", "table", "doubt"),
    [
        ("free", SINE, "the table moves as a steady sine of 3 Hz"),
        ("kobe", SINE, "the table moves as a steady sine of 3 Hz"),
        ("noise", STILL, "the table hardly moves in this test"),
    ],
)
def test_a_signal_that_contradicts_the_name_is_asked_about(folder, name, table, doubt):
    _, drafted = drafted_tests(folder, {name: (NOISE, table), "other": (NOISE, NOISE)})
    assert doubt in [each.asked for each in drafted.doubts if each.key == f"tests[{name}].kind"]


def test_a_frequency_in_the_name_is_held_against_the_recorded_one(folder):
    _, drafted = drafted_tests(folder, {"sine_4Hz": (NOISE, SINE)})
    assert "the table moves at 3 Hz" in [each.asked for each in drafted.doubts]
