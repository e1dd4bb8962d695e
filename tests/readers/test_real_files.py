"""Every file of the collection of other laboratories' instruments: read with the figures known of it, or refused."""

from typing import NamedTuple

import numpy as np
import pytest

from colonnade.errors import ReadError
from colonnade.readers.registry import read


class Known(NamedTuple):
    """
    What is known of a file: its format, its channels, and of one samples, unit, mean step (or no clock) and largest.

    The largest values are those of headers, of SOURCES.md, or of another reader (apread, IMCtermite).
    """

    format: str
    channels: int
    column: str | int
    samples: int
    unit: str | None
    step: float | None
    largest: float | None


READ = {
    "catman/2byteJob1_2022_04_12_13_32_10.bin": Known("catman", 10, "Baumer encoder 2500", 100, "mm", 1 / 300, 222.768),
    "catman/8byteJob1_2022_04_12_13_31_23.bin": Known("catman", 10, "Baumer encoder 2500", 100, "mm", 1 / 300, 222.768),
    "diadem/testfile.TDM": Known("diadem", 8, "IncrementInt16_2", 100, None, None, 99),
    "imc/datasetA_1.raw": Known("famos", 1, "ACC_long", 6000, "G", 0.005, 0.082313),
    "lvm/multi_time_column.lvm": Known("lvm", 4, "Acceleration", 3, "g", 1.953125e-5, 0.532608),
    "lvm/short.lvm": Known("lvm", 2, "Response (Trigger)", 10, "m/s^2", 3.90625e-5, 1.222088),
    "lvm/with_comments.lvm": Known("lvm", 4, "Temperatura", 9, "°C", 9.723275 / 8, 5.619287),
    "matlab/labcontrol_ensaio1.mat": Known("matlab", 6, "forc", 3001, None, 0.01, None),
    "motion/elcentro_chopra_8f10.dat": Known("delimited", 1, 1, 1560, "g", 0.02, 0.31882),
    "motion/elcentro_chopra_xy.dat": Known("delimited", 2, "Y", 1560, None, None, 0.31882),
    "motion/elcentro_damaged_copy.txt": Known("delimited", 2, 2, 1560, None, 0.02, 0.31882),
    "motion/elcentro_s00e_reversed.dat": Known("delimited", 2, 2, 2688, None, 0.02, 0.348737),
    "mts/emodul_specimen.dat": Known("mts", 13, "Ch 1 Kraft", 572, "kN", 0.5, 147.16),
    "shaketable/earthquake-test1.csv": Known("delimited", 3, 1, 4092, None, None, None),
    "shaketable/grashorn_testingData.mat": Known("matlab", 3, "xMeas", 3600, None, 0.004001, None),
    "shaketable/sinewave-test1.csv": Known("delimited", 3, 2, 1400, None, None, None),
    "shaketable/thadhaines_01.csv": Known("delimited", 33, "Table accel XXXX", 9000, "g's", 0.001, None),
    "strongmotion/AOM0011801241951.EW": Known("waveform", 1, 1, 10200, "m/s^2", 0.01, 0.114352),
    "strongmotion/AOM0011801241951.NS": Known("waveform", 1, 1, 10200, "m/s^2", 0.01, 0.124129),
    "strongmotion/AOM0011801241951.UD": Known("waveform", 1, 1, 10200, "m/s^2", 0.01, 0.092846),
    "strongmotion/Cosmos12TimeSeriesTest.v1": Known("cosmos", 1, "acceleration", 7000, "cm/s^2", 0.01, 161.962),
    "strongmotion/us1000hyfh_akbmrp_AKBMR--n.1000hyfh.BNZ.--.acc.V2c": Known(
        "cosmos", 1, "acceleration", 42000, "cm/s^2", 0.005, 6.851512
    ),
    "tdms/raw1.tdms": Known("tdms", 7, "Sixth Chan", 2000, "Volts", 2e-5, None),
}
REFUSED = {
    "SOURCES.md": "delimited: no rows of numbers",
    "diadem/testfile.DAT": r"this is a DIAdem .DAT header, which is not read here. Save the data set",
    "diadem/testfile.tdx": "testfile.tdx: it holds the values of testfile.TDM; read that file instead",
    "strongmotion/5526-1.V1": r"in the format of BHRC \(Iran\), which is not read here. Download the record as COSMOS",
}


def test_every_file_of_the_collection_is_accounted_for(shared_data):
    there = {path.relative_to(shared_data).as_posix() for path in shared_data.rglob("*") if path.is_file()}
    assert there == READ.keys() | REFUSED.keys()
    assert len(READ) == 23


@pytest.mark.parametrize("name", READ)
def test_a_real_file_is_read_with_the_figures_known_of_it(shared_data, name):
    known = READ[name]
    recording = read(shared_data / name)
    assert (recording.format, len(recording.channels)) == (known.format, known.channels)
    channel = recording.channel(known.column)
    assert (channel.values.size, channel.unit) == (known.samples, known.unit)
    if known.step is not None:
        steps = np.diff(channel.time)
        assert (channel.time[-1] - channel.time[0]) / steps.size == pytest.approx(known.step, rel=5e-5)
        assert (steps > 0).all()
    else:
        assert channel.time is None
    if known.largest is not None:
        assert np.nanmax(np.abs(channel.values)) == pytest.approx(known.largest, rel=1e-5)


@pytest.mark.parametrize("name", REFUSED)
def test_a_file_that_cannot_be_read_is_refused_with_the_reason(shared_data, name):
    with pytest.raises(ReadError, match=REFUSED[name]):
        read(shared_data / name)


@pytest.mark.parametrize("name", sorted(path for path in READ if path.startswith("catman/")))
def test_overflow_of_an_amplifier_is_missing_and_told(shared_data, name):
    recording = read(shared_data / name)
    overflowed = recording.channel("Thermocouple Type K")
    assert np.isnan(overflowed.values).all()  # −1e6 throughout
    assert any("overflow" in told and "Thermocouple" in told for told in recording.warnings)
    hardware_clock = recording.channel("MX840A hardware time default sample rate")
    assert not hardware_clock.is_clock  # seconds since 1970
    assert abs(recording.start.timestamp() - hardware_clock.values[0]) < 86400  # the file's date is local time


def test_an_unfinished_lvm_says_how_many_samples_are_lacking(shared_data):
    recording = read(shared_data / "lvm" / "multi_time_column.lvm")
    assert recording.warnings == ('the samples below line 23 end too early: the header says 51200, "Voltage" has 3',)
    assert [channel.is_clock for channel in recording.channels] == [True, False, True, False]


def test_an_mts_file_keeps_its_last_block_apart(shared_data):
    recording = read(shared_data / "mts" / "emodul_specimen.dat")
    transducers = [channel for channel in recording.channels[:8] if channel.unit == "mm"]
    assert [channel.name for channel in transducers] == ["Ch 1 Weg", "1944 B", "1281068", "2157"]
    last = recording.channel("block 2: Ch 1 Kraft")
    assert last.values.tolist() == [0.80352277, -147.20456]  # the largest force: 147.2 kN


def test_an_imc_file_begins_when_its_trigger_and_offset_say(shared_data):
    recording = read(shared_data / "imc" / "datasetA_1.raw")
    assert recording.start.isoformat(timespec="milliseconds") == "2019-05-08T18:00:00.010"


def test_a_k_net_record_has_the_peak_that_its_header_gives(shared_data):
    recording = read(shared_data / "strongmotion" / "AOM0011801241951.EW")
    values = recording.channels[0].values
    assert np.abs(values - values.mean()).max() == pytest.approx(0.04078, abs=5e-6)  # 4.078 gal
    assert recording.start.isoformat() == "2018-01-24T10:51:28+00:00"  # 19:51:43 in Japan, less 15 s of pre-trigger
