"""ASAM MDF: groups with their own clocks, and conversions by the standard (MDF 4.2 and 3.3, CCBLOCK)."""

from __future__ import annotations

import contextlib
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import asammdf
import numpy as np
import pytest
from asammdf.blocks import mdf_v3, mdf_v4, v2_v3_blocks, v4_blocks

from colonnade.cli import invoke
from colonnade.errors import ReadError
from colonnade.readers.registry import read, read_here

TIME = np.arange(200) / 100
COUNTS = np.arange(200, dtype="i2")
REALS = np.linspace(0.25, 19.9, 200)
X = COUNTS.astype(float)
NEAREST = np.select([X <= 25, X <= 75, X <= 125], [3.0, -1.0, 4.0], 1.5)
"""Of the rows of `TABLE`; of two keys as near, the lower one's."""

RATIONAL = {f"P{n}": value for n, value in enumerate((0.5, 2.0, -3.0, 0.1, 1.0, 7.0), 1)}
SEVEN = {f"P{n}": 0.0 for n in range(1, 8)}
TABLE = {
    key: value for n in range(4) for key, value in ((f"raw_{n}", 50.0 * n), (f"phys_{n}", [3.0, -1.0, 4.0, 1.5][n]))
}
ROWS = {"val_param_nr": 8}

ANY = np.full(200, np.nan)

KINDS_OF_4: dict[str, tuple[np.ndarray, dict[str, Any], np.ndarray]] = {
    "linear": (COUNTS, {"a": 0.02, "b": -1.5}, 0.02 * X - 1.5),
    "linear of reals": (REALS, {"a": -3.0, "b": 0.0}, -3 * REALS),
    "rational": (COUNTS, {"conversion_type": 2, **RATIONAL}, (0.5 * X**2 + 2 * X - 3) / (0.1 * X**2 + X + 7)),
    "rational, only a factor": (
        COUNTS,
        {"conversion_type": 2, **dict.fromkeys(RATIONAL, 0.0), "P2": 3.0, "P6": 4.0},
        0.75 * X,
    ),
    "rational, a factor by squares": (
        COUNTS,
        {"conversion_type": 2, **dict.fromkeys(RATIONAL, 0.0), "P1": 3.0, "P5": 4.0},
        0.75 * X,
    ),
    "interpolated": (REALS, {"conversion_type": 4, **ROWS, **TABLE}, 3 - 4 * REALS / 50),
    "nearest": (COUNTS, {"conversion_type": 5, **ROWS, **TABLE}, NEAREST),
    "of a range of reals": (
        REALS,
        {
            "conversion_type": 6,
            "val_param_nr": 7,
            **{"lower_0": 0.0, "upper_0": 5.0, "phys_0": 1.0, "lower_1": 5.0, "upper_1": 12.0, "phys_1": 2.0},
            "default": -9.0,
        },
        np.select([REALS < 5, REALS < 12], [1.0, 2.0], -9.0),
    ),
    "names for some, linear for the rest": (
        COUNTS,
        {"val_0": 3, "val_1": 199, "text_0": b"start", "text_1": b"end", "default_addr": {"a": 2.0, "b": 1.0}},
        np.where(np.isin(X, (3, 199)), np.nan, 2 * X + 1),
    ),
    "a conversion for each key": (
        COUNTS,
        {
            "val_0": 3,
            "val_1": 9,
            "text_0": {"a": 5.0, "b": 0.0},
            "text_1": {"a": 0.0, "b": 7.0},
            "default_addr": b"none",
        },
        np.select([X == 3, X == 9], [15.0, 7.0], np.nan),
    ),
    "a conversion for each range": (
        COUNTS,
        {
            **{"lower_0": 0, "upper_0": 9, "text_0": {"a": 5.0, "b": 0.0}, "lower_1": 10, "upper_1": 99},
            **{"text_1": b"names", "default_addr": {"a": 1.0, "b": -4.0}},
        },
        np.select([X <= 9, X <= 99], [5 * X, ANY], X - 4),
    ),
}

KINDS_OF_3: dict[str, tuple[np.ndarray, dict[str, Any], np.ndarray]] = {
    "linear": (COUNTS, {"a": 0.02, "b": -1.5, "conversion_type": 0}, 0.02 * X - 1.5),
    "interpolated": (REALS, {"conversion_type": 1, "ref_param_nr": 4, **TABLE}, 3 - 4 * REALS / 50),
    "nearest": (COUNTS, {"conversion_type": 2, "ref_param_nr": 4, **TABLE}, NEAREST),
    "polynomial": (
        COUNTS,
        {"conversion_type": 6, **RATIONAL},
        (2 - 0.1 * (X - 8)) / (-3 * (X - 8) - 0.5),
    ),
    "polynomial, only a factor": (
        COUNTS,
        {"conversion_type": 6, **dict.fromkeys(RATIONAL, 0.0), "P1": 3.0, "P4": 2.0},
        2 * X / 3,
    ),
    "exponential": (
        REALS,
        {"conversion_type": 7, **SEVEN, "P1": 2.0, "P2": 3.0, "P3": 1.0, "P6": 0.1},
        np.exp((0.1 * REALS - 1) / 2) / 3,
    ),
    "exponential of the inverse": (
        REALS,
        {"conversion_type": 7, **SEVEN, "P3": 2.0, "P4": 3.0, "P5": 1.5, "P6": 1.0},
        np.exp((2 / REALS - 1) / 3) / 1.5,
    ),
    "logarithmic": (
        REALS,
        {"conversion_type": 8, **SEVEN, "P1": 2.0, "P2": 3.0, "P3": -1.0, "P6": 2.0, "P7": 0.1},
        np.log((2 * (REALS - 0.1) + 1) / 2) / 3,
    ),
    "logarithmic of the inverse": (
        REALS,
        {"conversion_type": 8, **SEVEN, "P3": 9.0, "P4": 3.0, "P5": 1.5},
        np.log(9 / REALS / 3) / 1.5,
    ),
    "rational": (COUNTS, {"conversion_type": 9, **RATIONAL}, (0.5 * X**2 + 2 * X - 3) / (0.1 * X**2 + X + 7)),
}


@pytest.fixture(autouse=True)
def _asammdf_as_it_is(monkeypatch: pytest.MonkeyPatch) -> None:
    """What a reading in this process takes away from asammdf is put back after each test."""
    for module in (mdf_v3, mdf_v4, v2_v3_blocks, v4_blocks):
        for name in {"evaluate", "lambdify", "NamedTemporaryFile"} & vars(module).keys():
            monkeypatch.setattr(module, name, getattr(module, name))


def stored(path: Path, version: str, raw: np.ndarray, told: dict[str, Any] | None, *, clock: Any = None) -> Path:
    """Write a file with a channel of raw values and its conversion, and one without any."""
    if version < "4":
        from asammdf.blocks.v2_v3_blocks import ChannelConversion
    else:
        from asammdf.blocks.v4_blocks import ChannelConversion
    from asammdf.blocks.conversion_utils import from_dict

    conversion = None
    if told is not None and version < "4":
        conversion = ChannelConversion(**told)
    elif told is not None:
        conversion = ChannelConversion(**told) if "conversion_type" in told else from_dict(told)
    with asammdf.MDF(version=version) as file:
        signals = [
            asammdf.Signal(raw, TIME, name="converted", unit="mm", conversion=conversion),
            asammdf.Signal(REALS, TIME, name="plain", unit="g"),
        ]
        file.append(signals)
        if clock is not None:
            file.groups[0].channels[0].conversion = clock
        return Path(file.save(path, overwrite=True))


@pytest.mark.parametrize(
    ("version", "raw", "told", "expected"),
    [
        pytest.param(version, *kind, id=f"version {version}, {name}")
        for version, kinds in (("4.10", KINDS_OF_4), ("3.30", KINDS_OF_3), ("2.14", KINDS_OF_3))
        for name, kind in kinds.items()
    ],
)
def test_conversions_give_what_the_standard_says(
    tmp_path: Path, version: str, raw: np.ndarray, told: dict[str, Any], expected: np.ndarray
) -> None:
    path = stored(tmp_path / ("r.mf4" if version >= "4" else "r.mdf"), version, raw, told)
    channel = read(path).channel("converted")
    assert channel.unit == "mm"
    np.testing.assert_allclose(channel.values, expected, rtol=1e-12, atol=1e-12)
    np.testing.assert_allclose(channel.time, TIME, rtol=1e-12)


def test_a_range_of_whole_numbers_holds_both_its_ends(tmp_path: Path) -> None:
    # asammdf itself gives the default for all but the upper end.
    told = {"conversion_type": 6, "val_param_nr": 4, "lower_0": 5.0, "upper_0": 9.0, "phys_0": 1.0, "default": 0.0}
    values = read(stored(tmp_path / "r.mf4", "4.10", COUNTS, told)).channel("converted").values
    assert np.flatnonzero(values).tolist() == [5, 6, 7, 8, 9]


def test_values_that_are_names_are_no_channel(tmp_path: Path) -> None:
    told = {"val_0": 0, "text_0": b"off", "default_addr": b"on"}
    recording = read(stored(tmp_path / "r.mf4", "4.10", COUNTS, told))
    assert [channel.name for channel in recording.channels] == ["plain"]
    assert any('no numbers in "converted"' in note for note in recording.notes)


def test_a_clock_in_counts_is_converted(tmp_path: Path) -> None:
    from asammdf.blocks.v4_blocks import ChannelConversion

    path = stored(tmp_path / "r.mf4", "4.10", COUNTS, None, clock=ChannelConversion(a=2.0, b=5.0, conversion_type=1))
    time = read(path).channel("plain").time
    np.testing.assert_allclose(time, 5 + 2 * TIME, rtol=1e-12)


def formula_for(victim: Path) -> str:
    """A formula that makes a file: in front of what numexpr forbids stand quotes, within which it does not look."""
    classes = "().__class__.__base__.__subclasses__()"
    system = f'[c for c in {classes} if c.__name__ == "_wrap_close"][0].__init__.__globals__["system"]'
    return f"""("'" and {system}("touch {victim}") + 1 and "'" and X1)"""


def conversion_with(formula: str, version: str) -> dict[str, Any]:
    return {"conversion_type": 3 if version >= "4" else 10, "formula": formula}


@pytest.mark.parametrize("version", ["4.10", "3.30"])
@pytest.mark.parametrize("formula", [None, "X1+9**9**9**9", "X1*2"], ids=["a program", "without an end", "harmless"])
def test_a_formula_in_text_leaves_its_channel_out(tmp_path: Path, version: str, formula: str | None) -> None:
    victim = tmp_path / "made"
    formula = formula or formula_for(victim)
    path = stored(tmp_path / "r.mf4", version, COUNTS, conversion_with(formula, version))
    for recording in (read(path), read_here(path, "mdf", {}, None)):
        assert [channel.name for channel in recording.channels] == ["plain"]
        assert any('"converted" is left out: its conversion is a formula' in warning for warning in recording.warnings)
        with pytest.raises(
            ReadError, match=r'r.m[fd][4f]: channel "converted" is not read: its conversion is a formula'
        ):
            recording.channel("converted")
    assert not victim.exists()


def test_the_program_in_the_formula_is_one(tmp_path: Path) -> None:
    import numexpr

    victim = tmp_path / "made"
    with contextlib.suppress(Exception):
        numexpr.evaluate(formula_for(victim).replace("X1", "X"), local_dict={"X": REALS})
    assert victim.exists()


@pytest.mark.parametrize("referenced", ["text_0", "default_addr"])
def test_a_formula_that_is_referred_to_is_not_evaluated(tmp_path: Path, referenced: str) -> None:
    victim = tmp_path / "made"
    told = {
        "val_0": 3,
        "text_0": b"start",
        "default_addr": {"a": 1.0, "b": 0.0},
        referenced: {"formula": formula_for(victim)},
    }
    path = stored(tmp_path / "r.mf4", "4.10", COUNTS, told)
    assert [channel.name for channel in read(path).channels] == ["plain"]
    assert not victim.exists()


def test_a_clock_with_a_formula_is_no_clock(tmp_path: Path) -> None:
    from asammdf.blocks.v4_blocks import ChannelConversion

    victim = tmp_path / "made"
    clock = ChannelConversion(**conversion_with(formula_for(victim), "4.10"))
    recording = read(stored(tmp_path / "r.mf4", "4.10", COUNTS, None, clock=clock))
    assert recording.channel("plain").time is None
    assert any("the clock of group 1 is left out: its conversion is a formula" in each for each in recording.warnings)
    assert not victim.exists()


def test_every_group_keeps_its_own_clock_and_text_is_left_out(tmp_path: Path) -> None:
    time = np.arange(50) / 200
    slow = 0.1 + np.arange(10) / 50
    with asammdf.MDF(version="4.10") as file:
        file.append([asammdf.Signal((100 * time).astype("i2"), time, name="top", unit="mm")])
        file.append(
            [
                asammdf.Signal(np.cos(slow), slow, name="table", unit="g"),
                asammdf.Signal(np.array([b"on"] * 10), slow, name="state", encoding="utf-8"),
            ]
        )
        path = Path(file.save(tmp_path / "record.mf4"))
    recording = read(path)
    top, table = recording.channels
    assert (top.name, top.unit, table.name, table.unit) == ("top", "mm", "table", "g")
    np.testing.assert_allclose(top.time, time)
    np.testing.assert_allclose(table.time, slow)
    assert any('no numbers in "state"' in note for note in recording.notes)
    assert recording.start is not None


def test_a_file_that_was_not_closed_says_so(written: Callable[..., Path]) -> None:
    path = written("mdf")
    path.write_bytes(b"UnFinMF " + path.read_bytes()[8:])
    try:
        told = " ".join(read(path).warnings)
    except ReadError as error:
        told = str(error)
    assert "did not close" in told or "cannot be read" in told


def test_a_damaged_file_is_told_with_what_to_do(
    written: Callable[..., Path], capfd: pytest.CaptureFixture[str]
) -> None:
    path = written("mdf")
    path.write_bytes(path.read_bytes()[:150])
    with pytest.raises(ReadError, match=r'record.mf4: it cannot be read as "mdf" .* Copy it from the recorder again'):
        read(path)
    assert capfd.readouterr().err == ""  # asammdf's own words stay in the process that reads


def test_two_workers_read_mdf_at_once_and_a_damaged_file_fails_its_own_test_alone(tmp_path: Path) -> None:
    example = Path(__file__).parents[3] / "raw_schema" / "examples" / "mdf"
    (tmp_path / "raw").mkdir()
    content = (example / "raw" / "free-01.mf4").read_bytes()
    text = (example / "campaign.toml").read_text(encoding="utf-8")
    head, test, body = text.partition("[[tests]]")
    for number in (1, 2, 3):
        (tmp_path / "raw" / f"free-0{number}.mf4").write_bytes(content if number < 3 else content[:9000])
        head += test + body.replace("free-01", f"free-0{number}") + "\n"
    (tmp_path / "campaign.toml").write_text(head, encoding="utf-8")
    assert invoke(["ingest", "--workers", "2", str(tmp_path)]) == 1
    summary = json.loads((tmp_path / "processed" / "summary.json").read_text(encoding="utf-8"))
    assert {name: record["status"] for name, record in summary["tests"].items()} == {
        "free-01": "pending",
        "free-02": "pending",
        "free-03": "failed",
    }
    assert "free-03.mf4: it cannot be read" in summary["tests"]["free-03"]["reason"]
    for number in (1, 2):
        assert (tmp_path / "processed" / "tests" / f"free-0{number}" / "recorded.nc").is_file()
