"""Statements on the experiment's setting: scale, apparatus, programme, and what the computations are fed with."""

from __future__ import annotations

from math import pi, sqrt

from colonnade.stages.parts.beginning import RECORDED
from reproduction.printed import FREQUENCIES, SHOWN_FREQUENCY, SHOWN_RATIO, TABLE_1
from reproduction.statement import Answer, Numbers, Statements, judged, sine_tests

stated = Statements("setting")


@stated(
    "1",
    "The specimens are models of structures 20 times larger.",
    "nothing in a test depends on it; the campaign file gives it",
)
def _scale(numbers: Numbers) -> str:
    p = numbers["specimens"]["prism"]["p"]
    return (
        f"the campaign is told 1:20; the prism's prototype would have p = {p / sqrt(20):.3f} rad/s and be 9.12 m high"
    )


stated.undecided(
    "others-not-reported",
    "1",
    "Cylinder and cone, also sliced ones, were tested as well and are not reported.",
    "no results of theirs are printed",
    "the demo has a virtual cylinder and cone; the paper prints only their Table 1",
)


stated.undecided(
    "frame",
    "2",
    "A stiff, light frame holds the transducers that measure the rocking angle, and catches the specimen.",
    "the virtual set-up has both; no recording of the real frame is public",
    "assumed: rigid, catch at 0.28 rad",
)


@stated(
    "2",
    "Rocking governs the dynamic behaviour of each specimen.",
    "slide of the base in the contact model on the recorded motions of the sine tests",
    "the base slides less than 5 % of the way of the top, in tests that stand",
)
def _rocking_governs(numbers: Numbers) -> Answer:
    rows = [each for test, each in sine_tests(numbers) if test["predicted"]["contact"]["outcome"] == "rocking"]
    slide = max(each["computed_slide"] for each in rows)
    top = max(each["computed_top"] for each in rows)
    friction = numbers["made"]["contact"]["friction"]
    return judged(
        slide < 0.05 * top,
        f"contact model, friction {friction:g} (ours): largest slide {1e3 * slide:.2g} mm while the top moves up to "
        f"{1e3 * top:.0f} mm, over {len(rows)} sine tests that stand",
    )


@stated(
    "2.2",
    "Sine tests go from 1 to 7 Hz in steps of 1 Hz, each group at one frequency and rising amplitude.",
    "frequencies that colonnade finds in the recorded table motions",
    "seven frequencies, each within 0.2 %",
)
def _frequencies(numbers: Numbers) -> Answer:
    found = sorted({round(test["frequency"], 2) for test, _ in sine_tests(numbers)})
    same = len(found) == len(FREQUENCIES) and all(
        abs(one / other - 1) < 2e-3 for one, other in zip(found, FREQUENCIES, strict=True)
    )
    p = numbers["specimens"]["prism"]["p"]
    first, last = (2 * pi * each / p for each in (FREQUENCIES[0], FREQUENCIES[-1]))
    words = ", ".join(f"{each:g}" for each in found)
    return judged(same, f"recorded on the table: {words} Hz; Ω from {first:.3f} to {last:.3f}")


@stated("2.2", "The histories that are shown have Ω = 3.35.", "Ω = ω / p of 3 Hz", "within 0.01")
def _omega_335(numbers: Numbers) -> Answer:
    ours = 2 * pi * SHOWN_FREQUENCY / numbers["specimens"]["prism"]["p"]
    return judged(abs(ours - SHOWN_RATIO) <= 0.01, f"2π · {SHOWN_FREQUENCY:g} Hz / p = {ours:.3f}")


@stated(
    "eq. 1",
    "A is the peak acceleration over critical angle times g, and rocking starts near A = 1.",
    "rigid-body uplift, a = g tan α, divided by the printed critical angle times g",
    "uplift is at A = 1 to 0.1 %",
)
def _amplitude_ratio(numbers: Numbers) -> Answer:
    """The A of eq. 1 with the printed "angle": uplift of a rigid body then is at 1."""
    ours, printed = numbers["specimens"]["prism"], TABLE_1["prism"].printed["critical_angle"]
    onset = ours["tangent"] / printed
    with_angle = ours["tangent"] / ours["critical_angle"]
    return judged(
        abs(onset - 1) < 1e-3,
        f"with the printed 0.1886 uplift begins at A = {onset:.4f}; with the angle it would be {with_angle:.4f}",
    )


@stated(
    "2, 3.2",
    "The computations use the base motion that was recorded in the test, and e from the free vibrations.",
    "what colonnade's predictions say that they were driven by",
    "recorded base motion and identified e, in all three earthquake tests",
)
def _recorded_base(numbers: Numbers) -> Answer:
    found = {each["driven_by"] for each in numbers["earthquakes"].values()}
    sources = {each["restitution_source"] for each in numbers["earthquakes"].values()}
    words = f"driven by: {', '.join(sorted(found))}; e: {', '.join(sorted(sources))}"
    return judged(found == {RECORDED} and sources == {"identified"}, words)


@stated(
    "4.1, fig. 11",
    "The sine that the table reproduced is also the input of the computations.",
    "what the contact model's predictions of the prism's sine tests say that they were driven by",
    "the recorded base motion, in all tests",
)
def _recorded_sine(numbers: Numbers) -> Answer:
    found = {each["driven_by"] for each in numbers["sines"].values()}
    return judged(found == {RECORDED}, f"{len(numbers['sines'])} tests, driven by: {', '.join(sorted(found))}")


@stated(
    "3.2",
    "Acceleration and displacement of the base are recorded together with the rocking angle.",
    "what the results of the virtual earthquake tests hold",
    "all three, in every Span",
)
def _channels(numbers: Numbers) -> Answer:
    needed = {"rocking_angle", "base_acceleration", "base_displacement"}
    found = [set(each["recorded"]) for each in numbers["earthquakes"].values()]
    names = ", ".join(sorted(each.replace("_", " ") for each in set.intersection(*found)))
    return judged(all(needed <= each for each in found), f"in all Spans: {names}")


@stated("2.2", "Both boundaries come from a large number of tests.", "the paper gives no number")
def _many_tests(numbers: Numbers) -> str:
    sines = sum(test["kind"] == "sine" for test in numbers["tests"].values())
    return f"ours: {sines} sine tests, {len(numbers['sines'])} of the prism"
