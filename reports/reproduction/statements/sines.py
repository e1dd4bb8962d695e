"""Statements on the histories of the sine tests."""

from __future__ import annotations

from collections.abc import Callable
from statistics import median

from reproduction.printed import SHOWN
from reproduction.statement import Answer, Numbers, Statements, judged, sine_tests

stated = Statements("sines")

AT_ONCE = 2
"""Impacts: fewer before an overturning are no build-up."""


def shown(numbers: Numbers, level: float) -> tuple[str, Numbers]:
    """Give the test of one of the histories that the paper shows."""
    return next(
        (name, test)
        for name, test in numbers["tests"].items()
        if name in numbers["sines"] and name.endswith(f"3Hz-{level:.2f}")
    )


def _history(level: float) -> None:
    letter = "abc"[SHOWN.index(level)]

    @stated(
        f"fig. 4{letter}",
        f"At Ω = 3.35 and A = {level:.2f} the prism rocks. (The plot is lost in our copy: whether it stands is not "
        "known.)",
        "the virtual test at 3 Hz and this A, 60 cycles, ramps of 3",
        "it rocks or overturns",
        name=f"figure-4{letter}",
    )
    def answer(numbers: Numbers) -> Answer:
        _, test = shown(numbers, level)
        peak = "" if test["peak_ratio"] is None else f", largest |θ|/α {test['peak_ratio']:.2f}"
        analytical = test["predicted"]["linear"]["outcome"]
        return judged(test["outcome"] != "no-rocking", f"measured: {test['outcome']}{peak}; linear model: {analytical}")


def _standing(numbers: Numbers) -> list[tuple[Numbers, Numbers]]:
    return [(test, each) for test, each in sine_tests(numbers) if test["outcome"] == "rocking"]


def _in_space(numbers: Numbers, name: str, least: float, written: Callable[[float], str]) -> Answer:
    """Ask whether all runs in space that overturn show something; those that stand are shown with them."""
    rows = numbers["in_space"]
    fell = [each[name] for each in rows if each["outcome"] == "overturned"]
    words = "; ".join(
        f"{each['test']}, friction {each['friction']:g}: {each['outcome']}, {written(each[name])}" for each in rows
    )
    return judged(bool(fell) and min(fell) > least, words)


for level in SHOWN:
    _history(level)


@stated(
    "2.2",
    "The histories shown have amplitudes A from 1.05 to 3.35.",
    "against the A of figures 4a to 4c",
    "the largest A shown is 3.35",
)
def _levels_to_335(numbers: Numbers) -> Answer:
    levels = [numbers["tests"][shown(numbers, level)[0]]["amplitude_ratio"] for level in SHOWN]
    return judged(
        max(SHOWN) >= 3.35,
        f"the largest A that it shows is {max(SHOWN):.2f}; 3.35 is the Ω of all three. Ours: "
        + ", ".join(f"{level:.2f}" for level in levels),
    )


@stated(
    "2.2",
    "At small amplitudes there is no rocking.",
    "measured outcomes of the prism's sine tests with A < 1",
    "none of them rocks",
)
def _small_amplitudes(numbers: Numbers) -> Answer:
    rows = [test for test, _ in sine_tests(numbers) if test["amplitude_ratio"] < 1]
    still = sum(test["outcome"] == "no-rocking" for test in rows)
    return judged(still == len(rows), f"{still} of {len(rows)} tests with A < 1 do not rock")


@stated(
    "2.2",
    "Without rocking the specimen moves with its base.",
    "slide in the contact model on the recorded motions of those tests",
    "less than 0.1 mm",
)
def _follows_the_base(numbers: Numbers) -> Answer:
    slides = [each["computed_slide"] for test, each in sine_tests(numbers) if test["outcome"] == "no-rocking"]
    return judged(
        max(slides) < 1e-4, f"contact model, friction 0.6 (ours): it slides by at most {1e6 * max(slides):.1f} µm"
    )


@stated(
    "2.2",
    "With rising amplitude rocking sets in.",
    "measured outcomes of the tests with A > 1.02",
    "all of them rock or overturn",
)
def _rocking_initiated(numbers: Numbers) -> Answer:
    rows = [test for test, _ in sine_tests(numbers) if test["amplitude_ratio"] > 1.02]
    moved = sum(test["outcome"] != "no-rocking" for test in rows)
    return judged(moved == len(rows), f"{moved} of {len(rows)} tests with A > 1.02 rock or overturn")


@stated(
    "2.2",
    "Rocking is sub-harmonic in its initial stages and harmonic in the later ones, read as stages of one test.",
    "order of the measured response in the first ten periods of the steady sine, and of the settled one",
    "more than half of the tests that stand are not harmonic at first and harmonic at last",
)
def _sub_harmonic_then_harmonic_in_time(numbers: Numbers) -> Answer:
    rows = [
        (each["first_order"], test["order"]) for test, each in _standing(numbers) if each["first_order"] is not None
    ]
    settling = sum(first != 1 and last == 1 for first, last in rows)
    never = sum(last != 1 for _, last in rows)
    return judged(
        settling > len(rows) / 2,
        f"{settling} of {len(rows)} tests are sub-harmonic or irregular in the first ten periods and harmonic in the "
        f"last ones; {never} do not become harmonic",
    )


@stated(
    "2.2",
    "The same, read as stages of rising amplitude: sub-harmonic just above the onset, harmonic at larger A.",
    "order of the settled response that colonnade finds in each test",
    "at each frequency the smallest A that rocks gives a sub-harmonic response",
)
def _sub_harmonic_then_harmonic_in_amplitude(numbers: Numbers) -> Answer:
    """Going up in A at one frequency: the first test that rocks sub-harmonic, the last one harmonic."""
    groups: dict[float, list[tuple[float, object]]] = {}
    for test, _ in _standing(numbers):
        groups.setdefault(round(test["frequency"]), []).append((test["amplitude_ratio"], test["order"]))
    first = [min(group)[1] for group in groups.values()]
    orders = [order for group in groups.values() for _, order in sorted(group)]
    higher = sum(order not in (1, None) for order in orders)
    low = sum(order not in (1, None) for order in first)
    return judged(
        low == len(first),
        f"settled response to the smallest A that rocks: sub-harmonic at {low} of {len(first)} frequencies; of all "
        f"{len(orders)} tests that stand {higher} are sub-harmonic or irregular, at larger A",
    )


@stated(
    "2.2",
    "At larger amplitudes rocking becomes excessive, and after some build-up the specimen overturns.",
    "impacts before the measured overturning",
    f"at least {AT_ONCE} in every test that overturns",
)
def _builds_up_to_overturning(numbers: Numbers) -> Answer:
    rows = [each["impacts_before_overturning"] for test, each in sine_tests(numbers) if test["outcome"] == "overturned"]
    slow = sum(each >= AT_ONCE for each in rows)
    return judged(
        slow == len(rows),
        f"impacts before overturning: {min(rows)} to {max(rows)}, median {median(rows):g}; {AT_ONCE} and more in "
        f"{slow} of {len(rows)} tests",
    )


@stated(
    "2.2",
    "At that stage there is also significant sliding at the base.",
    "contact model in space on recorded motions of tests that stand and that overturn, at two frictions, up to "
    "the catch of the frame at 0.28 rad",
    "more than 1 mm in every run that overturns",
)
def _sliding_at_overturning(numbers: Numbers) -> Answer:
    return _in_space(numbers, "slide", 1e-3, lambda value: f"{1e3 * value:.2g} mm")


@stated(
    "2.2",
    "At that stage there is also rotation and rocking out of the plane of excitation.",
    "the same runs, which begin with a rotation about x of 1 mrad",
    "more than 5 % of α in every run that overturns",
)
def _out_of_plane_at_overturning(numbers: Numbers) -> Answer:
    return _in_space(numbers, "out_of_plane", 0.05, lambda value: f"{100 * value:.1f} % of α")


@stated(
    "2.2",
    "Every test shows no rocking, stable rocking, or unstable rocking that ends in overturning.",
    "measured outcomes of the prism's sine tests",
    "each has one of the three",
)
def _one_of_three(numbers: Numbers) -> Answer:
    outcomes = [test["outcome"] for test, _ in sine_tests(numbers)]
    words = ", ".join(f"{outcomes.count(each)} {each}" for each in ("no-rocking", "rocking", "overturned"))
    return judged(None not in outcomes, f"{len(outcomes)} tests: {words}")
