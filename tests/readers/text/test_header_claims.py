"""What the lines above numbers say of them."""

from __future__ import annotations

import pytest

from colonnade.readers.text.header_claims import header_claims


@pytest.mark.parametrize(
    ("text", "claim", "value"),
    [
        ("4096 points, dt = 0.01 s", "step", 0.01),
        ("NPTS=2999", "counts", (2999,)),
        ("5 points per line", "per_row", 5),
        ("(8F10.5)", "width", 10),
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
def test_a_claim_is_found_in_its_words(text: str, claim: str, value: object) -> None:
    assert getattr(header_claims(text), claim) == value


def test_a_claimed_interval_gives_times() -> None:
    claims = header_claims("equal spacing of 0.02 sec")
    times = claims.times(3)
    assert times is not None
    assert times.tolist() == [0, 0.02, 0.04]
    assert claims.clock_note == "clock: 0.02 s, as the header says"
    assert header_claims("").times(3) is None
    assert header_claims("").clock_note == "no clock"
