"""Rows of numbers are a table of channels or one series that runs on; the file shows which, or a person says it."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from scipy.signal import butter, sosfiltfilt

from colonnade.errors import ReadError
from colonnade.readers.motion import read_motion
from colonnade.readers.registry import read
from colonnade.readers.text.header_claims import HeaderClaims
from colonnade.readers.text.row_layout import judge
from every import every

STANDARD_GRAVITY = 9.80665


def shaking(count: int, *, cutoff: float = 0.3, seed: int = 1) -> np.ndarray:
    """Noise below a cut-off, as a share of the Nyquist frequency, that grows and dies away as an earthquake does."""
    noise = np.random.default_rng(seed).standard_normal(count)
    filtered = sosfiltfilt(butter(4, cutoff, output="sos"), noise) * np.exp(
        -(((np.arange(count) / count - 0.3) / 0.2) ** 2)
    )
    return np.round(0.3 * filtered / np.abs(filtered).max(), 5)


def written(
    folder: Path, table: np.ndarray, *, head: str = "", form: str = "%10.5f", last: np.ndarray | None = None
) -> Path:
    path = folder / "motion.txt"
    rows = ["".join(form % number for number in row) for row in table]
    rows += ["".join(form % number for number in last)] if last is not None else []
    path.write_text(head + "\n".join(rows) + "\n")
    return path


def components(rows: int = 400) -> np.ndarray:
    return np.column_stack([shaking(rows, seed=seed) for seed in (1, 2, 3)])


HEAD = "# North-south\n# 1600 points at equal spacing of 0.02 sec, in the format of 8F10.5\n# The units are (g)\n"


def test_numbers_that_run_on_are_one_channel_with_the_headers_clock_and_unit(tmp_path: Path) -> None:
    series = shaking(1600)
    recording = read(written(tmp_path, series.reshape(-1, 8), head=HEAD))
    assert len(recording.channels) == 1
    channel = recording.channel(1)
    assert (channel.values.size, channel.unit) == (1600, "g")
    np.testing.assert_array_equal(channel.values, series)
    np.testing.assert_allclose(channel.time, 0.02 * np.arange(1600))


def test_a_column_of_numbers_that_run_on_is_refused_with_the_cause(tmp_path: Path) -> None:
    recording = read(written(tmp_path, shaking(1600).reshape(-1, 8), head=HEAD))
    for column in (8, "column 8"):
        with pytest.raises(ReadError, match=r"Its numbers, 8 in a row, run on.*1600 points.*layout = \"columns\""):
            recording.channel(column)


@pytest.mark.parametrize(
    ("head", "last"),
    [
        pytest.param("", None, id="each row continues the one above"),
        pytest.param("El Centro 1940 NS component acceleration in g\n", None, id="a sentence of as many words above"),
        pytest.param("", shaking(1603)[1600:], id="the last row is shorter"),
        pytest.param("NPTS = 1600\n", None, id="the header announces as many"),
        pytest.param("10 values per line, 8 values per line\n", None, id="the header tells a row's numbers"),
    ],
)
def test_each_sign_of_numbers_that_run_on(tmp_path: Path, head: str, last: np.ndarray | None) -> None:
    series = shaking(1603)[: 1600 if last is None else None]
    path = written(tmp_path, series[:1600].reshape(-1, 8), head=head, last=last)
    np.testing.assert_array_equal(read(path).channel(1).values, series)
    assert read_motion(path, unit="g", dt=0.02).peak == pytest.approx(np.abs(series).max() * STANDARD_GRAVITY)


@pytest.mark.parametrize(
    ("head", "sign"),
    [("NPTS = 400\n", "400 rows"), ("", "shorter"), ("        NS        EW        UD\n", "names")],
    ids=["the header announces as many as rows", "each column goes on by itself", "names above"],
)
def test_each_sign_of_columns(tmp_path: Path, head: str, sign: str) -> None:
    recording = read(written(tmp_path, components(), head=head, form="%10.4f"))
    assert len(recording.channels) == 3
    np.testing.assert_allclose(recording.channel(2).values, components()[:, 1], atol=5e-5)


@pytest.mark.parametrize(
    "head", ["3F10.4 units are g, dt = 0.01 sec\n        NS        EW        UD\n", "3F10.4\nNS EW UD\n"]
)
def test_three_components_with_names_are_not_interleaved(tmp_path: Path, head: str) -> None:
    path = written(tmp_path, components(), head=head, form="%10.4f")
    with pytest.raises(ReadError, match='3 columns may be the acceleration: "NS", "EW", "UD"'):
        read_motion(path, unit="g", dt=0.01)
    assert read_motion(path, unit="g", dt=0.01, column="EW").acceleration.size == 400


def test_three_components_after_the_time_are_not_interleaved(tmp_path: Path) -> None:
    table = np.column_stack([0.01 * np.arange(400), components()])
    path = written(tmp_path, table, head="4F10.3, units are g\n", form="%10.3f")
    with pytest.raises(ReadError, match="3 columns may be the acceleration"):
        read_motion(path)
    motion = read_motion(path, column=2)
    assert (motion.acceleration.size, motion.dt) == (400, pytest.approx(0.01))


def test_pairs_of_time_and_value_run_on(tmp_path: Path) -> None:
    series = shaking(400)
    pairs = np.column_stack([0.02 * np.arange(400), series]).reshape(-1, 8)
    motion = read_motion(written(tmp_path, pairs, head="4(F8.2,F10.5), units are g\n"))
    np.testing.assert_allclose(motion.acceleration, series * STANDARD_GRAVITY)
    assert motion.dt == pytest.approx(0.02)


@pytest.mark.parametrize(
    ("table", "head"),
    [
        pytest.param(np.random.default_rng(3).standard_normal((60, 4)), "", id="white noise shows nothing"),
        pytest.param(components(), "NPTS = 1200\n", id="components, and the header's count contradicts"),
        pytest.param(
            np.sin(np.pi * np.arange(2000) / 5 + 0.3).reshape(-1, 10),
            "in the format of 10F10.5\n",
            id="whole periods a row",
        ),
    ],
)
def test_what_the_file_does_not_show_has_to_be_said(tmp_path: Path, table: np.ndarray, head: str) -> None:
    path = written(tmp_path, table, head=head)
    with pytest.raises(ReadError, match=r'does not show whether.*layout = "columns" or layout = "running"'):
        read(path)
    with pytest.raises(ReadError, match="does not show whether"):
        read_motion(path, unit="g", dt=0.02)
    assert len(read(path, "delimited", {"layout": "columns"}).channels) == table.shape[1]
    assert read(path, "delimited", {"layout": "running"}).channel(1).values.size == table.size
    assert read_motion(path, unit="g", dt=0.02, layout="running").acceleration.size == table.size


def test_three_phones_that_feel_the_same_are_three_channels(shared_data: Path) -> None:
    assert len(read(shared_data / "shaketable" / "earthquake-test1.csv").channels) == 3


@every("width", [2, 3, 5, 8, 10])
@every("cutoff", [0.02, 0.1, 0.3])
def test_a_series_is_never_taken_for_columns_nor_columns_for_a_series(width: int, cutoff: float) -> None:
    rows = 150
    series = shaking(rows * width, cutoff=cutoff).reshape(rows, width)
    channels = np.column_stack([shaking(rows, cutoff=cutoff, seed=seed) for seed in range(width)])
    drift = np.linspace(-0.2, 0.3, width) * np.random.default_rng(width).permutation(width)
    for table, layout in ((series, "running"), (channels, "columns"), (channels + np.round(drift, 5), "columns")):
        verdict = judge(list(table.T), HeaderClaims(), named="", is_free=True, is_whole=True)
        assert verdict.layout == layout, verdict


def test_a_column_that_ends_earlier_is_no_series_that_runs_on(tmp_path: Path) -> None:
    table = components()
    text = "".join(
        " ".join(f"{number:.4f}" for number in row[: 3 if line < 390 else 2]) + "\n" for line, row in enumerate(table)
    )
    (tmp_path / "record.txt").write_text(text)
    assert len(read(tmp_path / "record.txt").channels) == 3


def test_a_single_series_takes_unit_and_interval_from_the_lines_above(tmp_path: Path) -> None:
    series = shaking(300)
    path = written(tmp_path, series[:, None], head="Acceleration, units: cm/s^2\ntime step 0.005 s\n")
    (channel,) = read(path).channels
    assert channel.unit == "cm/s^2"
    np.testing.assert_allclose(channel.time, 0.005 * np.arange(300))
    motion = read_motion(path)
    assert (motion.dt, motion.peak) == (pytest.approx(0.005), pytest.approx(np.abs(series).max() / 100))


def test_a_title_that_fills_the_first_of_eight_cells_names_no_columns(tmp_path: Path) -> None:
    series = shaking(800)
    rows = "\n".join(",".join(f"{number:.5f}" for number in row) for row in series.reshape(-1, 8))
    (tmp_path / "motion.csv").write_text(f"El Centro 1940 NS,,,,,,,\n{rows}\n")
    np.testing.assert_array_equal(read(tmp_path / "motion.csv").channel(1).values, series)
