"""Statements on the earthquake tests."""

from __future__ import annotations

from math import log

from reproduction.printed import SPANS
from reproduction.statement import HISTORIES, Answer, Numbers, Statements, judged

stated = Statements("earthquakes")

FIGURES = {"linear": ("8", "3.2", "analytical"), "contact": ("14", "4.2", "numerical")}

SAME_PEAK = 1.5
"""Factor within which two largest angles are similar."""


def _test(numbers: Numbers, span: float) -> Numbers:
    found: Numbers = numbers["tests"][numbers["earthquakes"][f"{span:.1f}"]["test"]]
    return found


def _good(model: str, span: float) -> None:
    figure, section, name = FIGURES[model]
    letter = "abc"[SPANS.index(span)]

    @stated(
        f"{section}, fig. {figure}{letter}",
        f"At Span {span:.1f} measured and {name} response agree well.",
        f"{model} model on the recorded base motion, against the measured angle",
        f"RMS misfit at most {HISTORIES['good']:g} of α",
        name=f"span-{span:g}-{name}",
    )
    def answer(numbers: Numbers) -> Answer:
        test = _test(numbers, span)
        predicted = test["predicted"][model]
        return judged(
            predicted["nrmse"] <= HISTORIES["good"],
            f"RMS misfit {predicted['nrmse']:.3f} of α; largest |θ|/α measured {_peak(test)}, computed "
            f"{_peak(predicted)}",
        )


def _peak(found: Numbers) -> str:
    return found["outcome"] if found["peak_ratio"] is None else f"{found['peak_ratio']:.2f}"


def _misfit(model: str) -> None:
    figure, section, name = FIGURES[model]

    @stated(
        f"{section}, fig. {figure}b",
        f"At Span 2.5 the {name} response grows large at about 6 s, when the measured one has died down.",
        f"{model} model on the recorded base motion: a search for such a time",
        "measured below 0.1 α for 1 s, computed above 0.4 α within 2 s after",
        name=f"span-2.5-{name}",
    )
    def answer(numbers: Numbers) -> Answer:
        test = _test(numbers, 2.5)
        predicted = test["predicted"][model]
        found = numbers["earthquakes"]["2.5"]["pattern"][model]
        return judged(
            found["is_there"],
            f"after 1 s of |measured| < 0.1 α the computed |θ|/α reaches {found['largest_after_calm']:.2f} within 2 "
            f"s, 0.4 would count; RMS misfit {predicted['nrmse']:.3f} of α",
        )


stated.undecided(
    "record",
    "3.2",
    "The earthquake tests use the El Centro record of 1940 at rising intensity.",
    "time compression, component and source of the record are not stated; the demo divides time by √20",
    "ours: El Centro 1940 NS, time ÷ √20, 31 s become 7 s",
)


@stated(
    "3.2", "A larger Span is a stronger motion.", "what a Span is in m/s² is not stated; the demo takes 1.5 m/s² each"
)
def _span_is_intensity(numbers: Numbers) -> str:
    rows = {span: _test(numbers, span)["pga"] for span in SPANS}
    words = ", ".join(f"Span {span:.1f} {value:.2f}" for span, value in rows.items())
    return f"recorded peaks of the table: {words} m/s², as the virtual table was told"


@stated(
    "3.2",
    "The tests are to show stable and unstable behaviour again.",
    "an aim; measured outcomes of the virtual tests, whose intensities are the demo's",
)
def _stable_and_unstable(numbers: Numbers) -> str:
    words = ", ".join(f"Span {span:.1f} {_test(numbers, span)['outcome']}" for span in SPANS)
    return f"ours: {words}; the paper does not say which of its tests overturned"


_good("linear", 2.0)
_misfit("linear")
_good("linear", 3.0)
_good("contact", 2.0)
_misfit("contact")
_good("contact", 3.0)


@stated(
    "4.2, fig. 15",
    "Numerical and analytical responses to the three Spans agree reasonably well.",
    "contact against linear model on the recorded base motions",
    f"RMS difference at most {HISTORIES['reasonably good']:g} of α in all three",
)
def _numerical_and_analytical_spans(numbers: Numbers) -> Answer:
    found = {span: each["numerical_to_analytical"] for span, each in numbers["earthquakes"].items()}
    words = ", ".join(f"Span {span} {value:.3f}" for span, value in found.items())
    return judged(max(found.values()) <= HISTORIES["reasonably good"], f"RMS difference over α: {words}")


@stated(
    "5",
    "Both computations show, on the whole, the measured stability and largest angle in the earthquake tests.",
    "outcome and largest angle of both models in the three Spans",
    f"in at least five of six the outcome is the same and the largest angle within a factor of {SAME_PEAK:g}",
)
def _earthquake_trends(numbers: Numbers) -> Answer:
    words, similar = [], []
    for span in SPANS:
        test = _test(numbers, span)
        for model in ("linear", "contact"):
            predicted = test["predicted"][model]
            words.append(f"{span:.1f} {model} {_peak(predicted)} ({_peak(test)} measured)")
            same = predicted["outcome"] == test["outcome"]
            if same and test["peak_ratio"] is not None:
                same = abs(log(predicted["peak_ratio"] / test["peak_ratio"])) <= log(SAME_PEAK)
            similar.append(same)
    return judged(sum(similar) >= 5, f"largest |θ|/α: {'; '.join(words)}; {sum(similar)} of 6 similar")
