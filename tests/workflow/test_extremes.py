"""A campaign whose numbers are at their bounds ends in results or in a refusal, never in an internal error."""

import pytest

from colonnade.campaign.syntax.fields import BETWEEN, CONVERSION
from colonnade.errors import CampaignError


def bounds(kind, unit):
    return [f'"{value:g} {unit}"' for value in BETWEEN[kind]]


MASS = 'mass = "26.10 kg"}'
SETTINGS = dict.fromkeys(("sampling_rate", "lowpass", "base_lowpass"), bounds("frequency", "Hz"))
SETTINGS |= dict.fromkeys(("flat_duration", "rest_duration", "longest_offset"), bounds("time", "s"))
SETTINGS |= dict.fromkeys(("spike_threshold", "gap"), (1.0000001, 999.9))
SETTINGS |= dict.fromkeys(("predict.ensemble.critical_angle", "predict.ensemble.p"), (5e-324, 0.5))
SETTINGS |= {
    "jitter": [5e-324, 0.9999999999999999],
    "restitution.lowest_amplitude": [1.0000001e-6, 0.9999999999999999],
    "restitution.level": [0.5000000000000001, 0.9999989],
    "predict.rest_angle": [1.0000001e-10, 0.09999999],
    "predict.ensemble.filter": [5e-324, 0.5],
}
PLACES = {
    **{f"processing.{key} = {{}}\n\n[specimens]": ("[specimens]", both) for key, both in SETTINGS.items()},
    "mass = {}}}": (MASS, bounds("mass", "kg")),
    MASS.replace("}", ", scale = {}}}"): (MASS, [1.0, 999.0]),
    MASS.replace("}", ", restitution = {}}}"): (MASS, [5e-324, 1.0]),
    "gravity = {}\n\n[specimens]": ("[specimens]", bounds("acceleration", "m/s^2")),
    'unit = "mm", gain = {}, on': ('unit = "mm", on', [1e3 * CONVERSION[0], CONVERSION[1]]),
}
CASES = [(before, after.format(value)) for after, (before, both) in PLACES.items() for value in both]


@pytest.mark.slow
@pytest.mark.parametrize(("before", "after"), CASES, ids=[" ".join(after.split())[:60] for _, after in CASES])
def test_numbers_at_their_bounds_give_results_or_a_refusal(untouched, before, after):
    untouched.edit("[processing.predict.ensemble]\nmembers = 20\n", "")
    untouched.edit(before, f"processing.predict.ensemble.members = 20\n{after}" if before == "[specimens]" else after)
    try:
        stages = untouched.run(only=["free-01"], until="compare").stages
    except CampaignError as refused:
        assert "expected" in str(refused)  # noqa: PT017
        return
    assert not [stage.reason for stage in stages if "Internal error" in stage.reason]
