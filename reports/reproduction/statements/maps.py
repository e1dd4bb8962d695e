"""Statements on the maps of outcomes over Ω and A: measured, analytical, numerical."""

from __future__ import annotations

from itertools import combinations

from reproduction.statement import BOUNDARIES, Answer, Numbers, Statements, judged, sine_tests

stated = Statements("maps")

NARROW = 0.1
"""In A: a band between onset and overturning that a minor increase of the amplitude crosses."""

ONSET = 0.1
"""In A: an onset this near to 1 is at about 1."""

NO_DIFFERENCE = 0.01
"""Of A: two limits whose distances from the measured boundary differ by less are equally near."""

STEEP = 2.0
"""From the lowest to the highest frequency a boundary that rises rapidly grows by this factor at least."""


NAMES = {"fine_map": "analytical", "contact": "numerical"}
SECTIONS = {"fine_map": "3.1, fig. 7", "contact": "4.1, fig. 12"}
"""The paper's name of a model, and where it shows its map."""

ASKED = {"fine_map": "fairly good", "contact": "very good"}
"""How well the paper says that it agrees with the tests."""


def _chart(numbers: Numbers, which: str) -> Numbers:
    chart: Numbers = numbers["fine_map"] if which == "fine_map" else numbers["maps"][which]
    return chart


def _two_limits(which: str) -> None:
    name = NAMES[which]

    @stated(
        SECTIONS[which],
        f"The {name} model does not give one boundary of overturning but two lines: a lower and an upper limit.",
        "limits of the computed map of the prism",
        "at more than half of the Ω that have overturning an upper limit is apart from the lower one, or beyond the "
        "map",
        name=f"two-limits-{name}",
    )
    def answer(numbers: Numbers) -> Answer:
        chart = _chart(numbers, which)
        pairs = [
            (lower, upper) for lower, upper in zip(chart["lower"], chart["upper"], strict=True) if lower is not None
        ]
        beyond = sum(upper is None for _, upper in pairs)
        apart = sum(upper is not None and upper - lower > 1.5 * chart["width"] for lower, upper in pairs)
        return judged(
            apart + beyond > len(pairs) / 2,
            f"of {len(chart['lower'])} Ω {len(pairs)} have overturning; at {apart} of them there is an upper limit "
            f"apart from the lower one, at {beyond} the upper one is beyond the largest A (sine of "
            f"{numbers['made']['map']['cycles']} cycles, ramps of {numbers['made']['map']['ramp']})",
        )


def _agreement(which: str, limit: str, of: str, says: str) -> None:
    """Hold a computed limit against the measured boundary."""
    largest = BOUNDARIES[ASKED[which]]

    @stated(
        SECTIONS[which],
        says,
        "computed limit over the middle of the bracket between measured tests, at each frequency that has both",
        f"RMS at most {100 * largest:g} % of the boundary's A",
        name=f"{NAMES[which]}-{of}",
    )
    def answer(numbers: Numbers) -> Answer:
        off = _chart(numbers, which)[f"{limit}_off"]
        return judged(
            off["rms"] is not None and off["rms"] <= largest,
            f"computed over measured: mean {100 * off['mean']:+.1f} %, RMS {100 * off['rms']:.1f} %, at "
            f"{off['frequencies']} frequencies",
        )


@stated(
    "2.2, fig. 5",
    "The boundary between stable rocking and overturning rises rapidly with Ω.",
    "brackets between the measured tests at each frequency",
    f"no bracket is below one at a lower frequency, and the boundary grows {STEEP:g}-fold at least",
)
def _boundary_rises(numbers: Numbers) -> Answer:
    """A bracket that lies wholly below one at a lower frequency shows a boundary that falls."""
    brackets = [each["overturning"] for each in numbers["boundaries"]]
    falls = any(above < below for (below, _), (_, above) in combinations(brackets, 2))
    (low, first), (last, high) = brackets[0], brackets[-1]
    words = ", ".join(f"{below:.2f}–{above:.2f}" for below, above in brackets)
    omegas = [each["frequency_ratio"] for each in numbers["boundaries"]]
    return judged(
        not falls and last / first >= STEEP,
        f"measured brackets from Ω = {omegas[0]:.2f} to {omegas[-1]:.2f}: A = {words}; it grows {last / first:.1f}- "
        f"to {high / low:.1f}-fold",
    )


@stated(
    "2.2, fig. 5",
    "At small Ω a minor increase of A leads from no rocking to overturning.",
    "onset and lower limit of the finely scanned map; the tests at the lowest frequency",
    f"the band is narrower than {NARROW:g} in A at the lowest Ω",
)
def _narrow_band(numbers: Numbers) -> Answer:
    chart = numbers["fine_map"]
    bands = [
        None if lower is None else lower - onset
        for lower, onset in zip(chart["lower"], chart["no_rocking"], strict=True)
    ]
    first, last = bands[0], next(each for each in reversed(bands) if each is not None)
    test = numbers["boundaries"][0]
    return judged(
        first is not None and first < NARROW,
        f"analytical model, from onset to lower limit: {first:.3f} in A at the lowest Ω, {last:.2f} at the highest; "
        f"measured at the lowest: still at A = {test['rocking'][0]:.2f}, overturned at {test['overturning'][1]:.2f}",
    )


@stated(
    "2.2, fig. 5",
    "The boundary between no rocking and rocking is at about A = 1 for every Ω.",
    "brackets between the measured tests",
    "each bracket holds A = 1",
)
def _onset_at_one(numbers: Numbers) -> Answer:
    brackets = [each["rocking"] for each in numbers["boundaries"]]
    words = ", ".join(f"{below:.2f}–{above:.2f}" for below, above in brackets)
    return judged(all(below <= 1 <= above for below, above in brackets), f"measured brackets: {words}")


_two_limits("fine_map")


@stated(
    "3.1, fig. 7",
    "The experiment gives a single line between stable rocking and overturning.",
    "the measured tests at each frequency, in the order of A",
    "no measured test stands above one that overturned",
)
def _one_line_measured(numbers: Numbers) -> Answer:
    words = "; ".join(
        f"Ω = {each['frequency_ratio']:.2f}: stands again at A = "
        + ", ".join(f"{level:.2f}" for level in each["stood_above"])
        for each in numbers["boundaries"]
        if each["stood_above"]
    )
    return judged(not words, words or "no test stands above one that overturned")


_agreement(
    "fine_map",
    "lower",
    "overturning",
    "The analytical boundary of overturning agrees fairly well with the measured one.",
)


_agreement(
    "fine_map",
    "no_rocking",
    "onset",
    "The analytical boundary of the onset of rocking agrees fairly well with the measured one.",
)


_two_limits("contact")


@stated(
    "4.1, fig. 12",
    "The numerical onset of rocking is at about A = 1 whatever Ω.",
    "outcomes of the contact model's map",
    "within 0.1 of A = 1 at every frequency",
)
def _numerical_onset_flat(numbers: Numbers) -> Answer:
    found = [each for each in numbers["maps"]["contact"]["no_rocking"] if each is not None]
    words = ", ".join(f"{each:.2f}" for each in found)
    return judged(
        all(abs(each - 1) <= ONSET for each in found),
        f"A at which it begins to rock, searched between the levels, at the seven frequencies: {words}",
    )


_agreement(
    "contact",
    "lower",
    "overturning",
    "The numerical lower limit agrees very well with the measured boundary of overturning.",
)


_agreement("contact", "no_rocking", "onset", "The numerical onset of rocking agrees very well with the measured one.")


@stated(
    "4.1, fig. 13",
    "The numerical lower limit is nearer to the measured boundary than the analytical one.",
    "limits of all models by one rule, from the same levels at the tests' frequencies",
    f"its RMS distance is smaller by {100 * NO_DIFFERENCE:g} % of A; if the two differ by less: cannot be decided",
)
def _numerical_is_better(numbers: Numbers) -> Answer:
    rows = {model: numbers["maps"][model]["lower_off"] for model in ("linear", "contact", "nonlinear")}
    words = ", ".join(
        f"{model} {100 * each['rms']:.1f} % ({each['frequencies']} frequencies)" for model, each in rows.items()
    )
    ours = f"RMS of the lower limit against the measured boundary: {words}"
    gain = rows["linear"]["rms"] - rows["contact"]["rms"]
    if abs(gain) < NO_DIFFERENCE:
        return Answer("undecided", f"{ours}; no difference at the spacing of these maps")
    return judged(gain > 0, ours)


@stated(
    "5",
    "Both models show the measured trends of stability over frequency and amplitude.",
    "outcomes that they predict on the recorded motions of the prism's sine tests",
    "each predicts 90 % of the measured outcomes at least",
)
def _same_trends(numbers: Numbers) -> Answer:
    tests = [test for test, _ in sine_tests(numbers)]
    shares = {
        model: sum(test["predicted"][model]["outcome"] == test["outcome"] for test in tests) / len(tests)
        for model in ("linear", "contact")
    }
    words = ", ".join(f"{model} {100 * share:.0f} %" for model, share in shares.items())
    return judged(
        min(shares.values()) >= 0.9,
        f"predicted outcome on the recorded motion is the measured one in: {words} of tests",
    )
