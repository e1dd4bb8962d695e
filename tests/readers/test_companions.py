"""Raw files that are in several files: these are found beside the first, and nowhere else."""

from __future__ import annotations

import gzip
from collections.abc import Callable
from pathlib import Path

import numpy as np
import obspy
import pytest

from colonnade.errors import ReadError
from colonnade.readers.registry import companions, read

SECRET = np.arange(1000, 1100, dtype="<i4")


def seismic_header(path: Path, kind: str, folder: str, name: str) -> Path:
    """Write a header of one line, of 100 samples in another file."""
    shift = int(kind == "NNSA_KB_CORE")
    line = bytearray(b" " * (283 + 4 * shift))

    def put(place: int, text: str) -> None:
        line[place : place + len(text)] = text.encode()

    put(0, "TABLE")
    put(7, "ACC")
    put(16, f"{1366970100.0:17.5f}")
    put(61 + shift, f"{1366970101.0:17.5f}")
    put(79 + shift, f"{100:8d}")
    put(88 + shift, f"{100.0:11.4f}")
    put(100 + shift, f"{1.0:16.6f}")
    put(117 + shift, f"{1.0:16.6f}")
    put(143 + shift, "i4")
    put(148 + shift, folder)
    put(213 + shift, name)
    put(246 + shift, f"{0:10d}")
    path.write_bytes(bytes(line) + b"\n")
    return path


@pytest.fixture
def secret(tmp_path: Path) -> Path:
    path = tmp_path / "secret"
    path.write_bytes(SECRET.tobytes())
    return path


KINDS = pytest.mark.parametrize("kind", ["CSS", "NNSA_KB_CORE"])


@KINDS
@pytest.mark.parametrize("folder", ["", "."])
def test_samples_beside_their_header_are_read(tmp_path: Path, secret: Path, kind: str, folder: str) -> None:
    path = seismic_header(tmp_path / "r.wfdisc", kind, folder, "secret")
    assert read(path, "waveform", {"kind": kind}).channels[0].values.tolist() == SECRET.tolist()
    assert companions(path, "waveform", {"kind": kind}) == (secret,)


@KINDS
@pytest.mark.parametrize("place", ["absolute folder", "absolute name", "above", "above by name", "below"])
def test_samples_elsewhere_are_never_opened(tmp_path: Path, secret: Path, kind: str, place: str) -> None:
    (tmp_path / "raw" / "below").mkdir(parents=True)
    (tmp_path / "raw" / "below" / "secret").write_bytes(SECRET.tobytes())
    folder, name = {
        "absolute folder": (str(tmp_path), "secret"),
        "absolute name": ("", str(secret)[-32:] if len(str(secret)) > 32 else str(secret)),
        "above": ("..", "secret"),
        "above by name": ("", "../secret"),
        "below": ("below", "secret"),
    }[place]
    path = seismic_header(tmp_path / "raw" / "r.wfdisc", kind, folder, name)
    for within in (None, tmp_path):
        with pytest.raises(ReadError, match=r"r.wfdisc, line 1: its samples are in .* Only a file in the folder of"):
            read(path, "waveform", {"kind": kind}, within=within)
    with pytest.raises(ReadError, match="Only a file in the folder"):
        companions(path, "waveform", {"kind": kind})


def test_packed_samples_are_the_companion_where_they_are_taken(tmp_path: Path) -> None:
    path = seismic_header(tmp_path / "r.wfdisc", "CSS", "", "r.w")
    (tmp_path / "r.w.gz").write_bytes(gzip.compress(SECRET.tobytes()))
    assert read(path, "waveform", {"kind": "CSS"}).channels[0].values.tolist() == SECRET.tolist()
    assert companions(path, "waveform", {"kind": "CSS"}) == (tmp_path / "r.w.gz",)


def test_a_header_of_seismic_handler_has_its_samples_in_a_qbn(tmp_path: Path) -> None:
    trace = obspy.Trace(np.arange(50, dtype=np.float32), {"station": "TABLE", "channel": "BHZ", "delta": 0.01})
    trace.write(str(tmp_path / "r.QHD"), format="Q")
    path = tmp_path / "r.QHD"
    assert read(path, "waveform", {"kind": "Q"}).channels[0].values.size == 50
    assert companions(path, "waveform", {"kind": "Q"}) == (tmp_path / "r.QBN",)


def test_the_values_of_a_diadem_header_are_found_and_named_where_they_are_missing(
    written: Callable[..., Path],
) -> None:
    path = written("diadem")
    assert companions(path) == (path.with_suffix(".R32"),)
    path.with_suffix(".R32").unlink()
    assert companions(path) == (path.with_suffix(".R32"),)
    with pytest.raises(ReadError, match=r"its values are in the file \"record.R32\", which is not in its folder"):
        read(path)


def test_values_that_are_a_link_out_of_the_campaign_are_refused(written: Callable[..., Path], tmp_path: Path) -> None:
    path = written("diadem")
    values = path.with_suffix(".R32")
    outside = tmp_path.parent / f"{tmp_path.name}-outside"
    values.rename(outside)
    values.symlink_to(outside)
    with pytest.raises(ReadError, match=r"its values are in record.R32, which is a link to .*outside, outside "):
        read(path)
    assert companions(path) == (values,)  # to be hashed once it is a file
    inside = tmp_path / "elsewhere"
    inside.mkdir()
    outside.rename(inside / "record.R32")
    values.unlink()
    values.symlink_to(inside / "record.R32")
    assert read(path, within=tmp_path).channels


@pytest.mark.parametrize("format", ["tdms", "mdf", "famos", "catman", "delimited"])
def test_a_file_that_is_whole_has_no_companions(written: Callable[..., Path], format: str, tmp_path: Path) -> None:
    path = tmp_path / "r.csv"
    path.write_text("a,b\n1,2\n3,4\n")
    assert companions(path, format) == ()
    assert companions(path) == ()
