"""Headers of DIAdem data sets as text (.DAT): numbered lines, one block for each channel."""

from __future__ import annotations

from collections import Counter
from functools import partial
from pathlib import Path

from colonnade.readers.binary.stored_numbers import DescribedChannel, StoredNumbers
from colonnade.readers.text.lines.numbered import NumberedLines

SIGNATURE = "DIAEXTENDED"
BEGINNING = "#BEGINCHANNELHEADER"
FORMS = {
    **{"REAL64": "f8", "REAL32": "f4", "INT32": "i4", "INT16": "i2"},
    **{"WORD8": "u1", "WORD16": "u2", "WORD32": "u4"},
}
NAME, UNIT, KIND, FILE, ORDER, FORM, COUNT, POINTER, HEADER_BYTES = 200, 202, 210, 211, 213, 214, 220, 221, 222
BEGIN, STEP, HAS_MISSING = 240, 241, 252
MISSING_VALUE, BYTE_ORDER = 111, 112


def channels_in_dat(path: Path) -> tuple[list[DescribedChannel], list[str]]:
    """Find what a .DAT header describes, with a warning if it was cut off."""
    common, channels, whole = _entries(path)
    width = Counter(channel.get(FILE, "") for channel in channels if channel.get(ORDER) == "BLOCK")
    place: Counter[str] = Counter()
    described: list[DescribedChannel] = []
    for number, channel in enumerate(channels, 1):
        name = channel.get(NAME, "") or f"channel {number}"
        described.append((name, partial(_stored, name, channel, common, width, place)))
    return described, [] if whole else ["the header ends within a channel's block: it was cut off"]


def _entries(path: Path) -> tuple[dict[int, str], list[dict[int, str]], bool]:
    """Numbered lines of the whole and of each channel, and whether the last block is whole."""
    common: dict[int, str] = {}
    channels: list[dict[int, str]] = []
    current = common
    with NumberedLines(path) as lines:
        for _, line in lines.rest():
            number, comma, text = line.partition(",")
            if line.startswith(BEGINNING):
                current = {}
                channels.append(current)
            elif line.startswith("#ENDCHANNELHEADER"):
                current = common
            elif line.startswith("#") and BEGINNING.startswith(line.rstrip()):
                current = {}  # the file ends within this line
            elif comma and number.strip().isdecimal() and number.strip().isascii():
                current.setdefault(int(number.strip()), text.strip())
    return common, channels, current is common


def _stored(
    name: str, channel: dict[int, str], common: dict[int, str], width: Counter[str], place: Counter[str]
) -> StoredNumbers:
    """Say where a channel's numbers stand; ValueError or KeyError where that cannot be told."""
    unit = channel.get(UNIT, "").strip("[] ")
    count = int(channel[COUNT])
    offset, factor = float(channel.get(BEGIN) or 0), float(channel.get(STEP) or 1)
    if count < 0:
        raise ValueError(f"{count} values")
    if channel.get(KIND) == "IMPLICIT":
        return StoredNumbers(name, unit, "", "<f8", 0, count, 8, offset, factor)
    if channel.get(FORM) not in FORMS:
        raise ValueError(f'values of type "{channel.get(FORM, "")}", which is not read')
    form = (">" if common.get(BYTE_ORDER, "").startswith("Low") else "<") + FORMS[channel[FORM]]
    size = int(form[-1])
    file = channel[FILE]
    interleaved = channel.get(ORDER) == "BLOCK"
    if interleaved:
        first, stride = place[file] * size, width[file] * size
        place[file] += 1
    else:
        first, stride = (int(channel.get(POINTER) or 1) - 1) * size, size
    first += int(channel.get(HEADER_BYTES) or 0) if interleaved else 0
    if first < 0:
        raise ValueError(f"its first value would be at byte {first}")
    missing = float(common.get(MISSING_VALUE) or "nan") if channel.get(HAS_MISSING) == "Yes" else None
    return StoredNumbers(name, unit, file, form, first, count, stride, offset, factor, missing=missing)
