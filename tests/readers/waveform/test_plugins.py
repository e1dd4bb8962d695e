"""ObsPy's readers are found for every kind that is recognised; one that can run code is never given."""

from __future__ import annotations

from colonnade.readers.waveform.kinds import RECOGNISED
from colonnade.readers.waveform.plugins import KINDS, reader_of
from every import every


@every("kind", sorted(RECOGNISED))
def test_every_kind_that_is_recognised_has_a_reader(kind: str) -> None:
    assert kind in KINDS
    assert callable(reader_of(kind))


def test_a_kind_that_can_run_code_is_not_among_those_that_may_be_read() -> None:
    assert "PICKLE" not in KINDS
