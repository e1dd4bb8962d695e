"""Rows of numbers are a table of channels or one series that runs on; the file declares which, or a person says it."""

import numpy as np
import pytest
from scipy.signal import butter, sosfiltfilt

from colonnade.errors import ReadError
from colonnade.readers.motion import read_motion
from colonnade.readers.registry import read
from colonnade.readers.text.dialect import WHITESPACE, Dialect
from colonnade.readers.text.encoding import Text
from colonnade.readers.text.running import header_claims, read_running, read_series
from every import every

STANDARD_GRAVITY = 9.80665


def shaking(count, *, cutoff=0.3, seed=1):
    """Noise below a cut-off, as a share of the Nyquist frequency, that grows and dies away as an earthquake does."""
    noise = np.random.default_rng(seed).standard_normal(count)
    filtered = sosfiltfilt(butter(4, cutoff, output="sos"), noise) * np.exp(
        -(((np.arange(count) / count - 0.3) / 0.2) ** 2)
    )
    return np.round(0.3 * filtered / np.abs(filtered).max(), 5)


def written(folder, table, *, head="", form="%10.5f", last=None):
    path = folder / "motion.txt"
    rows = ["".join(form % number for number in row) for row in table]
    rows += ["".join(form % number for number in last)] if last is not None else []
    path.write_text(head + "\n".join(rows) + "\n")
    return path


def components(rows=400):
    return np.column_stack([shaking(rows, seed=seed) for seed in (1, 2, 3)])


HEAD = "# North-south\n# 1600 points at equal spacing of 0.02 sec, in the format of 8F10.5\n# The units are (g)\n"


def test_numbers_that_run_on_are_one_channel_with_the_headers_clock_and_unit(tmp_path):
    series = shaking(1600)
    recording = read(written(tmp_path, series.reshape(-1, 8), head=HEAD))
    assert len(recording.channels) == 1
    channel = recording.channel(1)
    assert (channel.values.size, channel.unit) == (1600, "g")
    np.testing.assert_array_equal(channel.values, series)
    np.testing.assert_allclose(channel.time, 0.02 * np.arange(1600))


@every(("head", "size"), [("NPTS = 1600\n", 1600), ("NPTS = 1603\n", 1603), ("8 values per line\n", 1603)])
def test_numbers_run_on_where_the_header_counts_them_or_those_of_a_row(tmp_path, head, size):
    series = shaking(1603)[:size]
    path = written(tmp_path, series[:1600].reshape(-1, 8), head=head, last=series[1600:])
    np.testing.assert_array_equal(read(path).channel(1).values, series)
    assert read_motion(path, unit="g", dt=0.02).peak == pytest.approx(np.abs(series).max() * STANDARD_GRAVITY)


@every("head", ["NPTS = 400\n", "        NS        EW        UD\n"])
def test_columns_are_channels_where_the_header_counts_rows_or_names_stand_above(tmp_path, head):
    recording = read(written(tmp_path, components(), head=head, form="%10.4f"))
    assert len(recording.channels) == 3
    np.testing.assert_allclose(recording.channel(2).values, components()[:, 1], atol=5e-5)


def test_three_components_after_the_time_are_not_interleaved(tmp_path):
    table = np.column_stack([0.01 * np.arange(400), components()])
    path = written(tmp_path, table, head="4F10.3, units are g\n", form="%10.3f")
    with pytest.raises(ReadError, match="3 columns may be the acceleration"):
        read_motion(path)
    motion = read_motion(path, column=2)
    assert (motion.acceleration.size, motion.dt) == (400, pytest.approx(0.01))


@every("head", ["", "El Centro 1940 NS component acceleration in g\n", "in the format of 8F10.5\n", "NPTS = 1500\n"])
def test_what_the_file_does_not_declare_has_to_be_said(tmp_path, head):
    table = shaking(1600).reshape(-1, 8)
    path = written(tmp_path, table, head=head)
    with pytest.raises(ReadError, match=r'does not show whether.*layout = "columns" or layout = "running"'):
        read(path)
    with pytest.raises(ReadError, match="does not show whether"):
        read_motion(path, unit="g", dt=0.02)
    assert len(read(path, "delimited", {"layout": "columns"}).channels) == table.shape[1]
    assert read(path, "delimited", {"layout": "running"}).channel(1).values.size == table.size
    assert read_motion(path, unit="g", dt=0.02, layout="running").acceleration.size == table.size


def test_a_single_series_takes_unit_and_interval_from_the_lines_above(tmp_path):
    series = shaking(300)
    path = written(tmp_path, series[:, None], head="Acceleration, units: cm/s^2\ntime step 0.005 s\n")
    (channel,) = read(path).channels
    assert channel.unit == "cm/s^2"
    np.testing.assert_allclose(channel.time, 0.005 * np.arange(300))
    motion = read_motion(path)
    assert (motion.dt, motion.peak) == (pytest.approx(0.005), pytest.approx(np.abs(series).max() / 100))


def test_an_interval_above_a_table_is_the_clock_of_columns_without_one(tmp_path):
    path = written(tmp_path, components(), head="time step 0.005 s, units: g\n  NS  EW  UD\n", form="%10.4f")
    recording = read(path)
    assert [(channel.name, channel.unit) for channel in recording.channels] == [("NS", "g"), ("EW", "g"), ("UD", "g")]
    np.testing.assert_allclose(recording.channel("UD").time, 0.005 * np.arange(400))


BLANKS = Dialect(WHITESPACE, ".")


def test_a_series_may_be_written_in_any_dialect_with_text_below_it(path):
    path.write_text("title\n 1.0 2.0 3.0\n 4.0 5.0\n\nend of record\n")
    assert read_series(Text.of(path), BLANKS, 1).tolist() == [1, 2, 3, 4, 5]
    path.write_text("1,5;2,5;\n3,5;4,5;\n")
    assert read_series(Text.of(path), Dialect(";", ","), 0).tolist() == [1.5, 2.5, 3.5, 4.5]


@every("text", ["1 2\n3 x\n5 6\n", "1 2\nend\n5 6\n"])
def test_what_is_no_number_within_a_series_is_refused(tmp_path, text):
    (tmp_path / "a.txt").write_text(text)
    with pytest.raises(ReadError, match=r"a\.txt: the numbers run on .*line 2 .* One block of numbers"):
        read_series(Text.of(tmp_path / "a.txt"), BLANKS, 0)


@every(
    ("text", "claim", "value"),
    [
        ("4096 points, dt = 0.01 s", "step", 0.01),
        ("NPTS=2999", "counts", (2999,)),
        ("5 points per line", "per_row", 5),
        ("Units: cm/s/s", "unit", "cm/s/s"),
        ("dt = 0 s", "step", None),
        ("time step 0.02", "step", 0.02),
        ("Sampling interval: 0.005,", "step", 0.005),
        ("at increments of 0.02 seconds", "step", 0.02),
        ("0.02 sec intervals", "step", 0.02),
        ("Load step 2", "step", None),
        ("load step: 2, cycle 3", "step", None),
        ("steps 100,", "step", None),
        ("10 increments, 2 stages", "step", None),
        ("North component", "unit", None),
    ],
)
def test_a_claim_is_found_in_its_words(text, claim, value):
    assert getattr(header_claims(text), claim) == value


@every(
    ("line", "width"),
    [
        (" 1.5 -0.25  3.0E+01", None),
        ("1.5-0.25+3.0E+01", None),
        ("1.5 -.25 3.0D+01", None),
        (" 1.50-0.25 30.0", 5),
        ("  1.5-0.25   30", 5),
    ],
)
def test_numbers_are_told_apart(line, width):
    values, warnings = read_running([(1, line)], width=width)
    assert values.tolist() == [1.5, -0.25, 30.0]
    assert warnings == []


@every("odd", ["####", "1.2.3", "nan", "1e999", "--", "0x1F"])
def test_what_is_no_number_is_missing_and_told(odd):
    values, warnings = read_running([(7, "1.0 2.0"), (8, f"3.0 {odd}"), (9, "")])
    np.testing.assert_array_equal(values, [1, 2, 3, np.nan])
    assert warnings == [f'line 8 ("3.0 {odd}"): something that is not a number; missing']
