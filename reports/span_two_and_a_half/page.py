"""The page of the study, made from its numbers."""

from __future__ import annotations

from math import log2
from typing import Any

from span_two_and_a_half import wording
from span_two_and_a_half.criterion import Criterion
from span_two_and_a_half.design import (
    ABOUT,
    BOTH,
    DECISIVE,
    EVERY,
    MODELS,
    ONLY,
    PLAUSIBLE,
    STEPS,
    TIME_SCALE,
)
from span_two_and_a_half.telling import DIRECT, REPEATABILITY, instrument_information

TEXT = """*Everything here is virtual: no recording of the experiment is public. Measured means a virtual prism.*

# Span 2.5: why did the computed response grow?

Made by `make reproduce` (`python reports/span_study.py`), seed {seed}, {seconds} s of processor time. All numbers are
in [span-2.5.json](span-2.5.json).

**What was asked.** At Spans 2.0 and 3.0 the paper's measured and computed response agree. At Span 2.5 the computed
one grows large at about 6 s, when the measured one has died down. Which single cause, or all together, makes a
prediction misbehave in that way, and how often?

**Criterion**, fixed [before the first run](span-2.5-design.md): at Span 2.5 the measured |θ| has been below {quiet:g}
α for {before:g} s and stays below {half:g} α, and the predicted one grows above {loud:g} α within {after:g} s; at
Spans 2.0 and 3.0 the misfit is below {nrmse:g} α.

**What was run.** {members} virtual tests in the plane, {causes} causes at up to four sizes, and {in_space} in space.
Each is the three Spans at one of {steps} overall intensities, as the intensity of a Span is not known. Time is
divided by √20.

## Answer

{answer}

![How often each cause makes the pattern](span-2.5-likelihood.svg)

*Dots: share of all tests. Lines: 95 % intervals. Short bars: never seen, the upper limit. Circles: the reverse.*

{example}

## How often

Share of the tests, with 95 % intervals, %. The pattern: Span 2.5 misbehaves, and Spans 2.0 and 3.0 agree.

{main}

The lines below "all" are from the contact model in space: so few tests that they exclude nothing. Each size is in the
figure and in span-2.5.json. The upper limits of what was never seen come from the number of tests.

## Does the criterion matter?

Tests that show the pattern, of all {members} in the plane, by variant of the criterion:

{variants}

## Place and direction

{place}

{direction}

## Sensitivity

{sensitivity}

## What would decide

First the laboratory's own record of Span 2.5: in these tests measured and predicted part {parted:.1f} s after the start
(median), long before 6 s. What differs there is the cause, or its trace.

Each cause has a measurement that shows it directly. "From": the size from which a likelihood ratio of 20 is expected.
Bits: what the measurement tells between the {direct} causes, each as likely and at its usual size; all of it is
{all_bits:.2f} bits. How well each measures is assumed.

{instruments}

Repeating Span 2.5, simulated for tests of all sizes whose nonlinear prediction misbehaves there, %:

{telling}

{information}

## Checks

{engines}

The paper's schemes are compared with the exact linear solution, the others with the nonlinear one. A rest rule of
1e-4 α instead of 1e-6 α changes when a prism that has died down is lifted again, and with it some verdicts.

Another seed, series and time scale (nonlinear prediction, %):

{repeats}

In space, at Span 2.5, medians at the largest size:

{slides}

## What this does not show

- What happened in Thessaloniki: no measured history is used, only the sentence about it.
- How likely a cause is in a laboratory. That needs a prior, and none is given.
- The paper's finite elements. Its second prediction is represented by the nonlinear plane model.
- Other resolutions of the contact in space: all members use one (3 × 3 nodes, steps of 40 µs).
- Vertical motion, an elastic prism, a table that rocks or answers to the prism.
- Shares hold for intensities between the limits, all ratios alike. In a small part of that range the pattern is common,
  in the rest it is absent (`by_intensity`).
"""


def page(found: dict[str, Any]) -> str:
    """Write the page."""
    rows, space, fixed = found["rows"], found["space"], Criterion()
    return TEXT.format(
        seed=found["seed"],
        seconds=found["processor_s"],
        quiet=fixed.quiet,
        before=fixed.before,
        half=fixed.loud / 2,
        loud=fixed.loud,
        after=fixed.after,
        nrmse=fixed.nrmse,
        members=f"{found['members']:,}".replace(",", " "),
        causes=len(wording.causes_of(rows)),
        in_space=f"{sum(row['members'] for row in space):,}".replace(",", " "),
        steps=STEPS,
        answer=answer(found),
        example=example(found["example"]),
        main=wording.main_table(rows, space),
        variants=wording.variant_table(rows),
        place=place(found),
        direction=direction(found),
        sensitivity=sensitivity(found),
        direct=len(DIRECT),
        parted=found["parted"][1],
        all_bits=log2(len(DIRECT)),
        instruments=wording.instrument_table(),
        telling=wording.telling_table(found["telling"]),
        information=information(found["telling"]),
        engines=wording.engine_table(found["engines"]),
        repeats=wording.repeat_table(rows, found["repeats"]),
        slides=wording.slide_text(space),
    )


def answer(found: dict[str, Any]) -> str:
    """Answer in three sentences, by the rule that was fixed."""
    rows = found["rows"]
    pairs, limits = wording.verdict(rows, BOTH)
    alone, _ = wording.verdict(rows, "nonlinear")
    makes = {view: wording.seen(rows, view) for view in (BOTH, *MODELS)}
    alone_able = [name for name in limits if name != "all" and any(name in each for each in makes.values())]
    first = (
        f"**{_decision(pairs, alone)}** Each of these can make a prediction misbehave in that way by itself: "
        f"{wording.listed(alone_able)}"
    )
    shown = {scope: wording.strongest(rows, BOTH, scope) for scope in (EVERY, ONLY)}
    told = [f"{wording.listed(each)} with the cause {_where(scope)}" for scope, each in shown.items() if each]
    second = (
        f"Both predictions at once, as in the paper, are rare: of the tests with a cause, at most {'; '.join(told)}"
        if told
        else "Both predictions at once, as in the paper, were never seen"
    )
    inside, of = wording.places(rows, "nonlinear")
    third = (
        f"Of the {of} tests whose nonlinear prediction shows it, {inside} do so at {ABOUT[0]:g} to {ABOUT[1]:g} s, "
        "when the last burst of the compressed record finds the one prism still rocking and the other not"
    )
    return f"{first}. {second}. {third}."


def _where(scope: str) -> str:
    return f"{'in' if scope == EVERY else 'at'} {scope}"


def _decision(pairs: list[tuple[str, str]], alone: list[tuple[str, str]]) -> str:
    rule = f"at {' and '.join(PLAUSIBLE)} sizes, by a factor of {DECISIVE:g}"
    if not pairs and not alone:
        return f"Not decidable: no cause is preferred to another ({rule})."
    told = [f"{one} is preferred to {other}" for one, other in dict.fromkeys([*pairs, *alone])]
    return f"Only in part decidable ({rule}): {wording.listed(told)}."


def example(shown: dict[str, Any] | None) -> str:
    """Say what the second figure is."""
    if shown is None:
        return "No test showed the whole pattern."
    where = _where(shown["scope"])
    which = "both predictions show" if shown["view"] == BOTH else f"the {shown['view']} prediction shows"
    return (
        "![A virtual test in which the prediction misbehaves](span-2.5-example.svg)\n\n"
        f"*One of these tests, in which {which} it. The cause: {shown['cause']}, {where}; "
        f"{shown['intensity']:.3f} m/s² for each unit of Span.*"
    )


def place(found: dict[str, Any]) -> str:
    """Say where the pattern happens."""
    rows, (first, middle, last) = found["rows"], found["parted"]
    parts = []
    for scope in (EVERY, ONLY):
        counted = [f"{'{} of {}'.format(*wording.places(rows, view, scope))} ({view})" for view in (BOTH, *MODELS)]
        parts.append(f"With the cause {_where(scope)}: {wording.listed(counted)}")
    return (
        f"Tests whose pattern is at {ABOUT[0]:g} to {ABOUT[1]:g} s, of all that show it. {'. '.join(parts)}. The last "
        f"burst of the record is at {24 * TIME_SCALE:.1f} to {27 * TIME_SCALE:.1f} s on this clock. "
        "Measured and predicted part long before: they first differ by 0.05 α at "
        f"{middle:.1f} s (median of the tests whose nonlinear prediction misbehaves at Span 2.5; 5 to 95 %: "
        f"{first:.1f} to {last:.1f} s)."
    )


def direction(found: dict[str, Any]) -> str:
    """Say how often the reverse happens, and with which sign."""
    rows, (larger, all_e) = found["rows"], found["signs"]["e"]
    told = [
        f"{wording.pooled(rows, view, 'pattern')} against {wording.pooled(rows, view, 'reverse')} ({view})"
        for view in (BOTH, *MODELS)
    ]
    return (
        "Predicted large after measured has died down, against the reverse, tests of all causes in every test: "
        f"{wording.listed(told)}. {_direction(rows)} Where e is the cause, the true e is the smaller one in "
        f"{all_e - larger} of {all_e} tests whose nonlinear prediction misbehaves at Span 2.5."
    )


def _direction(rows: wording.Rows) -> str:
    ratios = [
        wording.pooled(rows, view, "pattern") / max(wording.pooled(rows, view, "reverse"), 1)
        for view in (BOTH, *MODELS)
    ]
    if min(ratios) > 1.0:
        return f"The paper's direction is the more frequent one, {min(ratios):.1f} to {max(ratios):.1f} times."
    if max(ratios) < 1.0:
        return "The reverse is the more frequent one."
    return "Neither direction is the more frequent one throughout."


def sensitivity(found: dict[str, Any]) -> str:
    """Say how far neighbours run apart, and the horizon."""
    lines = [
        f"{float(change):g}: {wording.percent(each['apart'])} %"
        + (f", from {each['parted']:.1f} s on (median)" if each["parted"] is not None else "")
        for change, each in found["neighbours"].items()
    ]
    return (
        "Share of the pairs of neighbours at Span 2.5 that differ by more than 0.2 α at some time, by the relative "
        f"change of the intensity. {'; '.join(lines)}. With the settings of the program (e ± 0.005; α, p and gain "
        f"± 0.5 %) the response can be predicted up to {wording.horizon_text(found['horizons'])} at Spans 2.0, 2.5 and "
        "3.0 (medians). "
        "About 6 s is far beyond that: that a prediction is wrong so late asks for no special cause."
    )


def information(told: wording.Rows) -> str:
    """Say what a repeat tells between causes."""
    sentences = []
    for deviation in REPEATABILITY:
        bits, causes = wording.repeat_information(told, f"repeats {deviation:g}")
        sentences.append(
            f"Whether the measured response repeats on a table that repeats to {100 * deviation:g} % tells "
            f"{bits:.2f} bit between {causes} causes with equal weights"
        )
    names = {direct.instrument for each in DIRECT.values() for direct in each}
    best = max(names, key=lambda name: (instrument_information(name), name))
    sentences.append(
        f"So the {best} tells most ({instrument_information(best):.2f} bits). "
        "No one measurement decides between all causes"
    )
    return ". ".join(sentences) + "."
