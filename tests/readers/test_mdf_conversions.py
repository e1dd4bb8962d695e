"""Conversions of MDF files are computed here, as asammdf computes those that are numbers; formulas in text are not."""

from __future__ import annotations

import contextlib
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from colonnade.errors import ReadError
from colonnade.readers.registry import read, read_here

asammdf = pytest.importorskip("asammdf")

TIME = np.arange(200) / 100
COUNTS = np.arange(200, dtype="i2")
REALS = np.linspace(0.25, 19.9, 200)

RATIONAL = {f"P{n}": value for n, value in enumerate((0.5, 2.0, -3.0, 0.1, 1.0, 7.0), 1)}
SEVEN = {f"P{n}": 0.0 for n in range(1, 8)}
TABLE = {
    key: value for n in range(4) for key, value in ((f"raw_{n}", 50.0 * n), (f"phys_{n}", [3.0, -1.0, 4.0, 1.5][n]))
}
ROWS = {"val_param_nr": 8}

KINDS_OF_4: dict[str, tuple[np.ndarray, dict[str, Any]]] = {
    "linear": (COUNTS, {"a": 0.02, "b": -1.5}),
    "linear of reals": (REALS, {"a": -3.0, "b": 0.0}),
    "rational": (COUNTS, {"conversion_type": 2, **RATIONAL}),
    "rational, only a factor": (COUNTS, {"conversion_type": 2, **dict.fromkeys(RATIONAL, 0.0), "P2": 3.0, "P6": 4.0}),
    "rational, a factor by squares": (
        COUNTS,
        {"conversion_type": 2, **dict.fromkeys(RATIONAL, 0.0), "P1": 3.0, "P5": 4.0},
    ),
    "interpolated": (REALS, {"conversion_type": 4, **ROWS, **TABLE}),
    "nearest": (COUNTS, {"conversion_type": 5, **ROWS, **TABLE}),
    "nearest of reals": (REALS, {"conversion_type": 5, **ROWS, **TABLE}),
    "of a range of reals": (
        REALS,
        {
            "conversion_type": 6,
            "val_param_nr": 7,
            **{"lower_0": 0.0, "upper_0": 5.0, "phys_0": 1.0, "lower_1": 5.0, "upper_1": 12.0, "phys_1": 2.0},
            "default": -9.0,
        },
    ),
    "names for some, linear for the rest": (
        COUNTS,
        {"val_0": 3, "val_1": 199, "text_0": b"start", "text_1": b"end", "default_addr": {"a": 2.0, "b": 1.0}},
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
    ),
    "a conversion for each range": (
        COUNTS,
        {
            **{"lower_0": 0, "upper_0": 9, "text_0": {"a": 5.0, "b": 0.0}, "lower_1": 10, "upper_1": 99},
            **{"text_1": b"names", "default_addr": {"a": 1.0, "b": -4.0}},
        },
    ),
}

KINDS_OF_3: dict[str, tuple[np.ndarray, dict[str, Any]]] = {
    "linear": (COUNTS, {"a": 0.02, "b": -1.5, "conversion_type": 0}),
    "interpolated": (REALS, {"conversion_type": 1, "ref_param_nr": 4, **TABLE}),
    "nearest": (COUNTS, {"conversion_type": 2, "ref_param_nr": 4, **TABLE}),
    "polynomial": (COUNTS, {"conversion_type": 6, **RATIONAL}),
    "polynomial, only a factor": (COUNTS, {"conversion_type": 6, **dict.fromkeys(RATIONAL, 0.0), "P1": 3.0, "P4": 2.0}),
    "exponential": (REALS, {"conversion_type": 7, **SEVEN, "P1": 2.0, "P2": 3.0, "P3": 1.0, "P6": 0.1}),
    "exponential of the inverse": (REALS, {"conversion_type": 7, **SEVEN, "P3": 2.0, "P4": 3.0, "P5": 1.5, "P6": 1.0}),
    "logarithmic": (REALS, {"conversion_type": 8, **SEVEN, "P1": 2.0, "P2": 3.0, "P3": -1.0, "P6": 2.0, "P7": 0.1}),
    "logarithmic of the inverse": (REALS, {"conversion_type": 8, **SEVEN, "P3": 9.0, "P4": 3.0, "P5": 1.5}),
    "rational": (COUNTS, {"conversion_type": 9, **RATIONAL}),
}


@pytest.fixture
def evaluating(monkeypatch: pytest.MonkeyPatch) -> None:
    """asammdf as it is by itself; an earlier test that read in this process has taken its formulas away."""
    from asammdf.blocks import v2_v3_blocks, v4_blocks
    from numexpr import evaluate

    for module in (v2_v3_blocks, v4_blocks):
        monkeypatch.setattr(module, "evaluate", evaluate)


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
    ("version", "raw", "told"),
    [
        pytest.param(version, *kind, id=f"version {version}, {name}")
        for version, kinds in (("4.10", KINDS_OF_4), ("3.30", KINDS_OF_3), ("2.14", KINDS_OF_3))
        for name, kind in kinds.items()
    ],
)
def test_conversions_give_what_asammdf_gives(
    evaluating: None, tmp_path: Path, version: str, raw: np.ndarray, told: dict[str, Any]
) -> None:
    path = stored(tmp_path / ("r.mf4" if version >= "4" else "r.mdf"), version, raw, told)
    with asammdf.MDF(path) as file:
        (entry,) = (number for number, channel in enumerate(file.groups[0].channels) if channel.name == "converted")
        theirs = file.get(group=0, index=entry)
    expected = np.array([np.nan if isinstance(value, bytes) else value for value in theirs.samples], dtype=float)
    expected[~np.isfinite(expected)] = np.nan
    assert np.isfinite(expected).any()
    assert not np.array_equal(expected, raw)
    channel = read(path).channel("converted")
    assert channel.unit == "mm"
    np.testing.assert_allclose(channel.values, expected, rtol=1e-14, atol=0)
    np.testing.assert_allclose(channel.time, TIME, rtol=1e-12)


def test_a_range_of_whole_numbers_holds_both_its_ends(tmp_path: Path) -> None:
    # As the standard has it; asammdf gives the default for all but the upper end.
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
