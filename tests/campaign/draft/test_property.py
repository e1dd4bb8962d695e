"""Whatever lies in a folder: of a draft, `check` refuses nothing but what the draft itself asks."""

import contextlib
import re
import tempfile
from pathlib import Path

import numpy as np
import pytest
from hypothesis import Phase, example, given, settings
from hypothesis import strategies as st

from colonnade.campaign import load
from colonnade.campaign.draft.write import draft
from colonnade.errors import CampaignError

TIME = np.arange(0.0, 0.4, 0.01)
SIGNALS = {
    "sine": np.sin(2 * np.pi * 12 * TIME),
    "decay": np.exp(-20 * TIME) * np.cos(90 * TIME),
    "dead": np.full(TIME.size, 2.5),
    "count": np.arange(TIME.size, dtype=float),
}
WORDS = [
    *("free", "sine", "span", "span0", "span 2.5", "usp000hzq8", "0hz", "3hz", "2p5 Hz", "main", "daq2"),
    *("prism", "con", "El Centro", "Kippversuch", "noise_0", "span999999999999999999", "cone", "0.0Hz"),
    *("eq", "a=b", "x'y", "é"),
]
HEADS = [
    *("LVDT 1", "Tischweg", "ACC_Y", "laser top", "Seilzug", "gyro", "force", "Time", "t", "", " ", "Nr"),
    *("sync", "acc", "acc"),
]
UNITS = [
    *("", "mm", "V", "g", "m/s^2", "deg", "rad/s", "kN", "mV/g", "bananas", "kg", "s", "°C", "-", "%"),
    *("counts", "mm/V"),
]

odd = st.text(st.characters(codec="utf-8", exclude_characters="/\0\r\n"), min_size=1, max_size=12)
names = st.lists(st.one_of(st.sampled_from(WORDS), odd), min_size=1, max_size=3).map("-".join)
heads = st.tuples(st.one_of(st.sampled_from(HEADS), odd), st.sampled_from(UNITS))
tables = st.tuples(
    names,
    st.sampled_from([".csv", ".txt", ".dat", ""]),
    st.lists(st.tuples(heads, st.sampled_from(list(SIGNALS))), min_size=1, max_size=4),
    st.booleans(),
    st.sampled_from([";", "\t"]),
)


def write(folder, name, ending, columns, has_clock, delimiter):
    cells = [[f"{head} [{unit}]" if unit else head for (head, unit), _ in columns]]
    cells += [[f"{SIGNALS[kind][row]:.5f}" for _, kind in columns] for row in range(TIME.size)]
    if has_clock:
        cells = [
            [clock, *row] for clock, row in zip(["Time [s]", *(f"{time:.3f}" for time in TIME)], cells, strict=True)
        ]
    with contextlib.suppress(OSError, UnicodeError):
        (folder / f"{name}{ending}").write_text(
            "\n".join(delimiter.join(row) for row in cells) + "\n", encoding="utf-8"
        )


@pytest.mark.whole
@settings(max_examples=40, deadline=None, phases=(Phase.explicit, Phase.reuse, Phase.generate))
@given(st.lists(tables, min_size=1, max_size=9))
@example([("usp000hzq8", ".csv", [(("LVDT 1", "mm"), "sine")], True, ";")])
@example([("span0", ".csv", [(("LVDT 1", "mm"), "decay")], True, ";")])
@example(
    [("all dead", ".csv", [(("LVDT 1", "mm"), "dead")], True, ";"), ("b", ".csv", [(("top", "mm"), "sine")], True, ";")]
)
def test_check_refuses_nothing_that_the_draft_does_not_ask(files):
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for file in files:
            write(folder, *file)
        try:
            drafted = draft(folder)
        except CampaignError as error:
            assert "no readable recording" in str(error)  # noqa: PT017
            return
        drafted.path.write_text(drafted.text, encoding="utf-8")
        asked = set(drafted.open)
        try:
            load(drafted.path)
        except CampaignError as error:
            told = str(error).split("\n")
            lines = [re.match(r"campaign\.toml, line (\d+): ", line) for line in told]
            assert all(line and int(line[1]) in asked for line in lines), (told, drafted.text)
