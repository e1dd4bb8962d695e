"""The page of the study, and its figure."""

from __future__ import annotations

from typing import Any

import numpy as np

from colonnade.figures.style import blank_figure, styled
from forecasts.campaign import MODEL, WRONG
from forecasts.design import HEIGHTS, RESTITUTION, SCATTER
from forecasts.judging import BASE_RATE, MAIN

TEXT = """# Study of forecasts whose truth is known

Made by `make study NAME=forecast` (`python reports/forecast_study.py --campaigns {campaigns} --seed {seed}`).

{campaigns} virtual campaigns with {each} tests each: prisms of {heights} m with a true e of {lowest} to {highest}.
In each test e differs from it by {scatter} (standard deviation). Each campaign identifies e from three free vibrations
of its own, with an interval. Its tests are synthetic earthquakes, El Centro 1940 and sines, at levels that its own
forecasts leave undecided if there are any (some of {pilots} pilot runs overturn, some stand); one test in five is about
the level of uplift. α, p, gain of the accelerometer, clock and noise are wrong by errors of the default settings.
The truth is the {model} model with all of it. A forecast has {members} members.

{count} tests: {standing} do not rock, {rocking} rock, {overturned} overturn; of {undecided} the forecast is undecided.

## Scores

The main score, chosen before any result, is the CRPS of min(max |θ|, α)/α. The smaller a score, the better.

{scores}

**Main score, e wrong by {wrong:g}: {high_found} if too high, {low_found} if too low**, with 95 % intervals by
resampling of whole campaigns; above zero, the wrong e is found.

Difference from the forecasts with the identified e, per test, with 95 % intervals:

{differences}

Skill of the forecasts with the identified e (1 is perfect, 0 as good as the reference):

{skill}

## Reliability of the probability of overturning

With the identified e. Consistency bars: where the frequency is in 95 % of the cases if the forecasts are right.

{reliability}

![Reliability and PIT]({figure})

## Coverage of the amplitude's central bands

Share of the tests in each band; in brackets where 95 % of such shares are if the forecasts are right.

{coverage}
"""

SCORES = {
    "crps": "CRPS (of α)",
    "ranked_probability": "ranked probability",
    "brier": "Brier",
    "logarithmic": "logarithmic (nats)",
}

NAMES = {
    "identified": "identified e",
    "too high": f"e too high by {WRONG:g}",
    "too low": f"e too low by {WRONG:g}",
    "rigid": "rigid-body e",
    BASE_RATE: "base rate of the campaign",
}


def page(found: dict[str, Any], figure: str) -> str:
    """Write the page."""
    tests, judged = found["tests"], found["judged"]
    standing, rocking, overturned = judged["tests"]["outcomes"]
    return TEXT.format(
        **{name: found[name] for name in ("campaigns", "seed", "members", "pilots")},
        each=tests,
        heights=", ".join(f"{height:g}" for height in HEIGHTS),
        lowest=f"{RESTITUTION[0]:.2f}",
        highest=f"{RESTITUTION[1]:.2f}",
        scatter=SCATTER,
        model=MODEL,
        count=judged["tests"]["count"],
        undecided=judged["tests"]["undecided"],
        standing=standing,
        rocking=rocking,
        overturned=overturned,
        wrong=WRONG,
        high_found=_interval(judged["difference"]["too high"][MAIN]),
        low_found=_interval(judged["difference"]["too low"][MAIN]),
        scores=_table("forecast", {name: _cells(row, "{:.4f}") for name, row in judged["scores"].items()}),
        differences=_table(
            "forecast",
            {name: {key: _interval(each) for key, each in row.items()} for name, row in judged["difference"].items()},
        ),
        skill=_table("over", {name: _cells(row, "{:.2f}") for name, row in judged["skill"].items()}),
        reliability=_reliability(judged["reliability"]["identified"]),
        coverage=_coverage(judged["coverage"]),
        figure=figure,
    )


def _cells(row: dict[str, float], form: str) -> dict[str, str]:
    return {name: form.format(value) for name, value in row.items()}


def _interval(found: dict[str, float]) -> str:
    return f"{found['value']:+.4f} ({found['low']:+.4f} to {found['high']:+.4f})"


def _table(first: str, rows: dict[str, dict[str, str]]) -> str:
    lines = ["| " + " | ".join((first, *SCORES.values())) + " |", "|---" * (1 + len(SCORES)) + "|"]
    lines += ["| " + " | ".join((NAMES[name], *(row[key] for key in SCORES))) + " |" for name, row in rows.items()]
    return "\n".join(lines)


def _reliability(found: dict[str, list[float]]) -> str:
    lines = ["| tests | mean probability | overturned | consistency bar |", "|---|---|---|---|"]
    columns = (found[name] for name in ("tests", "probability", "frequency", "low", "high"))
    lines += [
        f"| {tests} | {mean:.3f} | {frequency:.3f} | {low:.3f} to {high:.3f} |"
        for tests, mean, frequency, low, high in zip(*columns, strict=True)
    ]
    return "\n".join(lines)


def _coverage(found: dict[str, dict[str, list[float]]]) -> str:
    bands = found["identified"]["band"]
    lines = ["| forecast | " + " | ".join(f"{band:.0%}" for band in bands) + " |", "|---" * (1 + len(bands)) + "|"]
    for name, row in found.items():
        columns = zip(row["share"], row["low"], row["high"], strict=True)
        lines.append(f"| {NAMES[name]} | " + " | ".join(f"{s:.1%} ({a:.1%} to {b:.1%})" for s, a, b in columns) + " |")
    return "\n".join(lines)


COLOURS = {"identified": "#0b6bb0", "too high": "#d1490f", "too low": "#7a5195"}


def draw(found: dict[str, Any]) -> Any:
    """Draw the reliability of the probability of overturning, and the distribution of PIT values."""
    judged = found["judged"]
    with styled():
        figure = blank_figure(3.2)
        left, right = figure.subplots(1, 2)
        shown = judged["reliability"]["identified"]
        mean, low, high = (np.array(shown[name]) for name in ("probability", "low", "high"))
        left.vlines(mean, low, high, color="0.75", linewidth=5, label="consistency bar, 95 %")
        for name, colour in COLOURS.items():
            each = judged["reliability"][name]
            left.plot(
                each["probability"],
                each["frequency"],
                "o-",
                color=colour,
                markersize=3,
                linewidth=0.8,
                label=NAMES[name],
            )
            values = np.sort(judged["pit"][name])
            right.step(values, np.arange(1, values.size + 1) / values.size, where="post", color=colour, linewidth=1.0)
        for axes in (left, right):
            axes.plot([0, 1], [0, 1], color="0.6", linewidth=0.8, linestyle="--")
            axes.set_xlim(0, 1)
            axes.set_ylim(0, 1)
        left.set_xlabel("forecast probability of overturning")
        left.set_ylabel("share that overturned")
        left.legend(fontsize=6, loc="upper left", frameon=False)
        right.set_xlabel("PIT of the amplitude")
        right.set_ylabel("share of the tests")
    return figure
