"""Headers of DIAdem as text: where each channel's numbers are."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as some

from colonnade.readers.binary.stored_numbers import StoredNumbers
from colonnade.readers.diadem.dat import channels_in_dat

PLAIN = {200: "top", 202: "[mm]", 210: "EXPLICIT", 211: "a.R64", 213: "CHANNEL", 214: "REAL64", 220: "10", 221: "1"}


def described(path: Path, *channels: dict[int, str], common: str = "112,High -> Low", end: str = "") -> list[object]:
    """What a header says of its channels: where the numbers are, or the error of one that says no such thing."""
    lines = ["DIAEXTENDED  {@:ENGLISH", "#BEGINGLOBALHEADER", common, "#ENDGLOBALHEADER"]
    for channel in channels:
        entries = [f"{key},{text}" for key, text in channel.items()]
        lines += ["#BEGINCHANNELHEADER", *entries, "#ENDCHANNELHEADER"]
    path.write_text("\n".join([*lines, end]), encoding="utf-8")
    found: list[object] = []
    for _, place in channels_in_dat(path)[0]:
        try:
            found.append(place())
        except (ValueError, KeyError) as error:
            found.append(error)
    return found


def test_channels_are_one_behind_the_other_from_their_pointers_on(tmp_path: Path) -> None:
    first, second = described(tmp_path / "a.dat", PLAIN, {**PLAIN, 200: "bottom", 221: "11", 240: "1", 241: "0.5"})
    assert first == StoredNumbers("top", "mm", "a.R64", "<f8", 0, 10, 8)
    assert second == StoredNumbers("bottom", "mm", "a.R64", "<f8", 80, 10, 8, offset=1.0, factor=0.5)


def test_channels_in_blocks_take_turns(tmp_path: Path) -> None:
    block = {**PLAIN, 213: "BLOCK", 214: "INT16", 222: "100"}
    found = described(tmp_path / "a.dat", block, block, block)
    assert [(each.first, each.stride) for each in found if isinstance(each, StoredNumbers)] == [
        (100, 6),
        (102, 6),
        (104, 6),
    ]


def test_an_implicit_channel_is_in_no_file(tmp_path: Path) -> None:
    (found,) = described(tmp_path / "a.dat", {200: "t", 210: "IMPLICIT", 220: "5", 240: "2", 241: "0.1"})
    assert found == StoredNumbers("t", "", "", "<f8", 0, 5, 8, 2.0, 0.1)


@pytest.mark.parametrize(
    ("common", "form"), [("112,Low -> High", ">f8"), ("112,High -> Low", "<f8"), ("", "<f8")], ids=str
)
def test_the_whole_file_has_one_byte_order(tmp_path: Path, common: str, form: str) -> None:
    (found,) = described(tmp_path / "a.dat", PLAIN, common=common)
    assert isinstance(found, StoredNumbers)
    assert found.form == form


@pytest.mark.parametrize(
    ("change", "told"),
    [({220: "-3"}, "-3 values"), ({214: "ASCII"}, 'type "ASCII"'), ({221: "-4"}, "would be at byte -40")],
    ids=["count", "kind", "pointer"],
)
def test_what_cannot_be_is_said(tmp_path: Path, change: dict[int, str], told: str) -> None:
    (found,) = described(tmp_path / "a.dat", {**PLAIN, **change})
    assert isinstance(found, ValueError)
    assert told in str(found)


@pytest.mark.parametrize("end", ["#BEGINCHANNELHEADER\n200,x", "#BEGINCHAN"])
def test_a_header_that_ends_within_a_channel_says_so(tmp_path: Path, end: str) -> None:
    described(tmp_path / "a.dat", PLAIN, end=end)
    assert channels_in_dat(tmp_path / "a.dat")[1] == ["the header ends within a channel's block: it was cut off"]


TEXT = some.text(some.characters(codec="utf-8", exclude_characters="\r\n"), max_size=12)


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=60, deadline=None)
@given(some.lists(some.dictionaries(some.sampled_from(sorted(PLAIN)), TEXT), max_size=3))
def test_any_entries_describe_a_channel_or_say_why_not(tmp_path: Path, changes: list[dict[int, str]]) -> None:
    found = described(tmp_path / "a.dat", *({**PLAIN, **change} for change in changes))
    assert len(found) == len(changes)
    for each in found:
        assert isinstance(each, (ValueError, KeyError)) or (each.count >= 0 and each.first >= 0 and each.stride > 0)
