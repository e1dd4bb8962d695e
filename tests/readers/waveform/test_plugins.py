"""ObsPy's readers are found for every kind that is recognised; one that can run code is never given."""

from __future__ import annotations

from pathlib import Path

import pytest

from colonnade.errors import ReadError
from colonnade.readers.registry import companions, read
from colonnade.readers.waveform.kinds import RECOGNISED
from colonnade.readers.waveform.plugins import KINDS, reader_of
from every import every


@every("kind", sorted(RECOGNISED))
def test_every_kind_that_is_recognised_has_a_reader(kind: str) -> None:
    assert kind in KINDS
    assert callable(reader_of(kind))


def test_a_kind_that_can_run_code_is_not_among_those_that_may_be_read() -> None:
    assert "PICKLE" not in KINDS


@pytest.mark.parametrize("kind", ["CSS", "NNSA_KB_CORE", "Q"])
def test_a_kind_with_its_samples_elsewhere_is_refused_with_the_export_to_make(tmp_path: Path, kind: str) -> None:
    path = tmp_path / "r.wfdisc"
    path.write_text("TABLE  ACC\n")
    assert companions(path, "waveform", {"kind": kind}) == ()
    with pytest.raises(ReadError, match=rf"r.wfdisc: {kind} has its samples in other files .* Convert it to miniSEED"):
        read(path, "waveform", {"kind": kind})
