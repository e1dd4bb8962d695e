"""Channels of a drafted set-up: what each column is, why, and what is asked."""

from __future__ import annotations

import pytest

from colonnade.campaign.draft.channels import MOST_UNKNOWN, draft_channels
from colonnade.campaign.draft.lines import Line
from colonnade.campaign.draft.signal import Shape
from colonnade.campaign.draft.survey import Column


def column(number: int, name: str, unit: str | None) -> Column:
    return Column(number, name, name, unit, False, True, Shape(1.0, False, None, False))


def lines_of(*named: tuple[str, str | None]) -> list[dict[str, Line]]:
    drafted = draft_channels({"main": [column(n, *each) for n, each in enumerate(named, start=1)]})
    return [{line.key: line for line in channel.lines if isinstance(line, Line)} for channel in drafted.channels]


def test_a_displacement_on_the_specimen_is_asked_for_what_no_file_contains():
    (lines,) = lines_of(("LVDT 1", "V"))
    assert [key for key, line in lines.items() if "?" in line.value] == ["gain", "at", "relative_to"]
    assert lines["gain"].value == '"? mm/V"'
    assert lines["quantity"].reason == 'from "lvdt" in its name'


def test_an_acceleration_is_taken_to_be_the_tables():
    (lines,) = lines_of(("ACC_Y", "g"))
    assert (lines["on"].value, lines["on"].question) == ('"table"', 'or "specimen", "ground"')
    assert (lines["direction"].value, lines["direction"].reason) == ("[0, 1, 0]", 'from "y" in its name')
    assert lines["direction"].question == "of a positive reading; [0, -1, 0] if it is reversed"


@pytest.mark.parametrize(
    ("unit", "question"),
    [
        (None, 'the file gives no unit: write one such as "mm", or "V" with a line gain = "10 mm/V" below it'),
        ("furlong", 'the file says "furlong", which is not a known unit'),
    ],
)
def test_a_unit_that_is_missing_or_unknown_is_asked_for(unit, question):
    (lines,) = lines_of(("LVDT 1", unit))
    assert (lines["unit"].value, lines["unit"].question) == ('"?"', question)


@pytest.mark.parametrize(("name", "sensing"), [("Laser top", '"surface"'), ("Seilzug", '"wire"')])
def test_a_laser_and_a_wire_are_asked_for_what_they_need(name, sensing):
    (lines,) = lines_of((name, "mm"))
    assert lines["sensing"].value == sensing
    assert "?" in (lines["normal"] if sensing == '"surface"' else lines["anchor"]).value


def test_columns_called_the_same_are_named_by_their_number():
    first, second = lines_of(("LVDT", "mm"), ("LVDT", "mm"))
    assert (first["column"].value, second["column"].value) == ("1", "2")


def test_unknown_columns_are_left_out_beside_known_ones():
    drafted = draft_channels({"main": [column(1, "LVDT 1", "mm"), column(2, "strange", "V")]})
    assert [channel.id for channel in drafted.channels] == ["lvdt_1"]
    assert drafted.left_out == (("main", "strange", 'its unit is "V" and its name does not show what it measures'),)


def test_unknown_columns_alone_are_asked_about_up_to_a_number():
    columns = [column(n, f"strange {n}", None) for n in range(1, MOST_UNKNOWN + 3)]
    drafted = draft_channels({"main": columns})
    assert len(drafted.channels) == MOST_UNKNOWN
    assert len(drafted.left_out) == 2


def test_a_channel_of_another_recorder_says_so():
    drafted = draft_channels({"main": [column(1, "LVDT 1", "mm")], "daq2": [column(1, "ACC", "g")]})
    assert [line.text() for line in drafted.channels[1].lines if isinstance(line, Line)][1] == 'recorder = "daq2"'


@pytest.mark.parametrize("letter", ["V", "A"])
def test_a_letter_that_may_be_a_label_is_asked_about(letter):
    (lines,) = lines_of((f"Acc ({letter})", letter))
    assert lines["unit"].value == '"?"'
    assert lines["unit"].question.startswith(f'is "({letter})" a label?')
    assert "gain" not in lines


def test_several_columns_in_volts_are_not_asked_about():
    for lines in lines_of(("LVDT 1 (V)", "V"), ("Acc (V)", "V"), ("LVDT [V]", "V")):
        assert (lines["unit"].value, lines["unit"].reason) == ('"V"', "as in the file")
    assert lines_of(("LVDT 1 [V]", "V"))[0]["unit"].value == '"V"'
