"""A campaign whose numbers are at their bounds ends in results or in a refusal, never in an internal error."""

import pytest

from colonnade.campaign.syntax.fields import BETWEEN, CONVERSION, SCALE
from colonnade.errors import CampaignError

FREQUENCIES = [f"{value:g} Hz" for value in BETWEEN["frequency"]]
TIMES = [f"{value:g} s" for value in BETWEEN["time"]]
PROCESSING = {
    **dict.fromkeys(("sampling_rate", "lowpass", "base_lowpass"), FREQUENCIES),
    **dict.fromkeys(("flat_duration", "rest_duration", "longest_offset"), TIMES),
    "spike_threshold": [1.0000001, 999.9],
    "gap": [1.0000001, 999.9],
    "jitter": [5e-324, 0.9999999999999999],
    "restitution.lowest_amplitude": [1.0000001e-6, 0.9999999999999999],
    "restitution.level": [0.5000000000000001, 0.9999989],
    "predict.rest_angle": [1.0000001e-10, 0.09999999],
}
ENSEMBLE = "[processing.predict.ensemble]\n"
"""A table that the campaign has."""
SPECIMEN = {
    "mass": [f"{value:g} kg" for value in BETWEEN["mass"]],
    "scale": list(SCALE),
    "restitution": [5e-324, 1.0],
}
CASES = [
    *(
        (f"[processing]\n{key} = {value!r}\n\n[setups.", "[setups.")
        for key, both in PROCESSING.items()
        for value in both
    ),
    *(
        (f"{ENSEMBLE}{key} = {value!r}\n", ENSEMBLE)
        for key in ("critical_angle", "p", "filter")
        for value in (5e-324, 0.5)
    ),
    *(
        (f'mass = "26.10 kg", {key} = {value!r}}}', 'mass = "26.10 kg"}')
        if key != "mass"
        else (f'mass = "{value}"}}', 'mass = "26.10 kg"}')
        for key, both in SPECIMEN.items()
        for value in both
    ),
    *((f'gravity = "{value:g} m/s^2"\n\n[specimens]', "[specimens]") for value in BETWEEN["acceleration"]),
    *((f'unit = "mm", gain = {value!r}, on', 'unit = "mm", on') for value in (1e3 * CONVERSION[0], CONVERSION[1])),
]


def named(case):
    return " ".join(case[0].split())[:60] if isinstance(case, tuple) else ""


@pytest.mark.slow
@pytest.mark.parametrize("case", CASES, ids=named)
def test_numbers_at_their_bounds_give_results_or_a_refusal(untouched, case):
    after, before = case
    untouched.edit(before, after.replace("'", '"'))
    try:
        stages = untouched.run(only=["free-01"], until="compare").stages
    except CampaignError as refused:
        assert "expected" in str(refused)  # noqa: PT017
        return
    assert not [stage.reason for stage in stages if "Internal error" in stage.reason]
