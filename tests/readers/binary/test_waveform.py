"""Seismic waveforms: own clocks, gaps, rounded steps, no date, and what is not opened."""

import pickle
import struct
import sys

import numpy as np
import obspy
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as some

from colonnade.errors import ReadError
from colonnade.readers.binary.waveform import READERS, kind_of_waveform
from colonnade.readers.head import head_of
from colonnade.readers.registry import read
from every import every

START = obspy.UTCDateTime(2013, 4, 26, 10, 15)


def trace(channel, values, rate, after=0.0, **header):
    told = {"station": "TABLE", "channel": channel, "delta": 1 / rate, "starttime": START + after, **header}
    return obspy.Trace(np.asarray(values, dtype=np.float32), told)


def stored(folder, kind, *traces):
    path = folder / f"r.{kind.lower()}"
    obspy.Stream(list(traces)).write(str(path), format=kind)
    return path


ONES = trace("ACC", np.ones(50), 100)


def test_every_channel_keeps_its_own_rate_and_start(tmp_path):
    recording = read(stored(tmp_path, "MSEED", ONES, trace("LVD", np.ones(10), 50, after=0.125)))
    acceleration, displacement = recording.channel("TABLE..ACC"), recording.channel("TABLE..LVD")
    np.testing.assert_allclose(acceleration.time, np.arange(50) / 100, atol=1e-9)
    np.testing.assert_allclose(displacement.time, 0.125 + np.arange(10) / 50, atol=1e-9)


@every(("rate", "after"), [(100, 0.5), (100, 0.6), (100, 1e8), (160, 0.5), (50, 0.503)])
def test_each_piece_of_a_channel_has_its_own_times(tmp_path, rate, after):
    recording = read(stored(tmp_path, "MSEED", ONES, trace("ACC", 2 * np.ones(40), rate, after=after)))
    (channel,) = recording.channels
    assert channel.values.tolist() == [1.0] * 50 + [2.0] * 40
    times = [np.arange(50) / 100, after + np.arange(40) / rate]
    np.testing.assert_allclose(channel.time, np.concatenate(times), rtol=1e-9, atol=1e-5)
    assert recording.warnings == ()


@every("rate", [2048, 100])  # in single precision, 10 ms are not 10 ms
def test_the_step_of_a_sac_file_is_not_rounded_to_microseconds_or_single_precision(tmp_path, rate):
    recording = read(stored(tmp_path, "SAC", trace("ACC", np.ones(4096), rate)))
    assert recording.channels[0].time[-1] == pytest.approx(4095 / rate, rel=1e-12)


def test_a_file_without_a_date_has_no_start(path):
    obspy.Trace(np.ones(10, dtype=np.float32), {"delta": 0.01}).write(str(path), format="SAC")
    recording = read(path)
    assert recording.start is None


def test_the_start_is_in_utc(tmp_path):
    start = read(stored(tmp_path, "MSEED", ONES)).start
    assert start.isoformat() == "2013-04-26T10:15:00+00:00"


def test_a_pickle_is_never_opened(path):
    path.write_bytes(pickle.dumps({"opened": True}))
    with pytest.raises(ReadError, match=r"not those of GSE1.*convert other seismic files.* Python pickle"):
        read(path, "waveform")


def test_the_kinds_that_are_read_are_known_to_obspy_under_these_names():
    from importlib.metadata import entry_points

    known = {kind: entry_points(group=f"obspy.plugin.waveform.{kind}", name="readFormat") for kind in READERS}
    assert {kind: [point.value for point in points] for kind, points in known.items()} == {
        kind: [reader] for kind, reader in READERS.items()
    }


def test_a_name_with_signs_of_a_pattern_is_just_a_name(tmp_path):
    path = stored(tmp_path, "MSEED", ONES)
    named = path.rename(tmp_path / "run[1]?.mseed") if sys.platform != "win32" else path
    assert read(named).channels[0].values.size == 50


def test_a_sac_file_that_was_cut_off_is_refused(tmp_path):
    path = stored(tmp_path, "SAC", trace("ACC", np.ones(1000), 100))
    path.write_bytes(path.read_bytes()[:2000])
    with pytest.raises(ReadError, match=r"r.sac: it cannot be read as SAC .* cut off"):
        read(path)


def test_counts_of_k_net_become_metres_per_second_squared(path):
    head = [
        *("Origin Time       2018/01/24 19:51:00", "Lat.              41.0", "Long.             142.5"),
        *("Depth. (km)       30", "Mag.              6.2", "Station Code      AOM001", "Station Lat.      41.5267"),
        *("Station Long.     140.9244", "Station Height(m) 39", "Record Time       2018/01/24 19:51:43"),
        *("Sampling Freq(Hz) 100Hz", "Duration Time(s)  1", "Dir.              E-W"),
        *("Scale Factor      3920(gal)/6182761", "Max. Acc. (gal)   4.078", "Last Correction   2018/01/24 19:51:43"),
        "Memo.             ",
    ]
    rows = ["".join(f"{count:9d}" for count in range(first, first + 8)) for first in range(0, 96, 8)]
    path.write_text("\n".join([*head, *rows, ""]), encoding="ascii")
    channel = read(path).channels[0]
    assert channel.unit == "m/s^2"
    np.testing.assert_allclose(channel.values, np.arange(96) * 39.20 / 6182761)


def mini_seed(year=2013, order=">", quality=b"D"):
    return b"000001" + quality + b" " + b"TABLE  ACC  " + struct.pack(order + "H", year) + bytes(40)


def sac(order="<", version=6, step=0.01, points=100):
    head = bytearray(632)
    struct.pack_into(order + "f", head, 0, step)
    struct.pack_into(order + "i", head, 304, version)
    struct.pack_into(order + "i", head, 316, points)
    return bytes(head)


def kinemetrics(length=2040):
    return b"K\x01\x00\x00" + struct.pack(">LH", 1, length) + bytes(20)


@every(
    ("head", "kind"),
    [
        (b"Origin Time       2011/01/24 19:51:00", "KNET"),
        (b"WID2 1996/10/13", "GSE2"),
        (b"\x55\x3a" + bytes(30), "SEG2"),
        (b"TIMESERIES XX_TEST, 50 samples, 1 sps, SLIST, FLOAT", "SLIST"),
        (b"TIMESERIES XX_TEST, 50 samples, 1 sps, TSPAIR, FLOAT", "TSPAIR"),
        (b"RIFF\x00\x00\x00\x00WAVEfmt ", "WAV"),
        (mini_seed(), "MSEED"),
        (mini_seed(order="<"), "MSEED"),
        (mini_seed(year=1), None),
        (mini_seed(quality=b"X"), None),
        (b"000001V 010" + bytes(60), "MSEED"),
        (kinemetrics(), "KINEMETRICS_EVT"),
        (kinemetrics(9), None),
        (sac(), "SAC"),
        (sac(">", 7), "SAC"),
        (sac(step=-1.0), None),
        (sac(points=0), None),
        (sac()[:600], None),
        (b"time;top\n0;1\n", None),
        (b"", None),
    ],
)
def test_a_kind_is_told_by_the_first_bytes(path, head, kind):
    path.write_bytes(head)
    assert kind_of_waveform(head_of(path)) == kind


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=80, deadline=None)
@given(some.binary(max_size=700))
def test_any_bytes_are_of_a_known_kind_or_of_none(path, content):
    path.write_bytes(content)
    assert kind_of_waveform(head_of(path)) in {*READERS, None}
