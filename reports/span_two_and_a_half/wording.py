"""Tables and sentences of the page, made from the numbers."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np

from span_two_and_a_half.counting import VIEWS, best_and_worst, causes_of, decided
from span_two_and_a_half.criterion import AS_FIXED
from span_two_and_a_half.design import BOTH, CAUSES, EVERY, GRADES, MODELS, ONLY, SPACE, SPANS
from span_two_and_a_half.fixed import size_text
from span_two_and_a_half.members import VARIANTS
from span_two_and_a_half.telling import (
    DIRECT,
    REFITTED,
    REPEATABILITY,
    Direct,
    decided_from,
    information,
    instrument_information,
    resolved,
)

Rows = list[dict[str, Any]]


def percent(share: float) -> str:
    """Write a share in percent, with as many digits as it takes to be seen."""
    if share == 0.0:
        return "0"
    return f"{100 * share:.{1 if share >= 0.1 else 2 if share >= 0.001 else 3}f}"


def with_limits(values: Sequence[float]) -> str:
    """Write a share with its limits, %."""
    share, low, high = values
    return f"{percent(share)} ({percent(low)} to {percent(high)})"


def table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """Write a table."""
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return "\n".join([*lines, *("| " + " | ".join(row) + " |" for row in rows)])


def chosen(rows: Rows, scope: str) -> Rows:
    """Give the rows of a scope."""
    return [row for row in rows if row["scope"] == scope]


def main_table(rows: Rows, space: Rows) -> str:
    """Write how often each cause makes the pattern, %."""
    lines = []
    for cause in causes_of([*rows, *space]):
        each = {row["grade"]: row for row in [*chosen(rows, EVERY), *space] if row["cause"] == cause}
        usual, gross = each.get(GRADES[1], each.get("")), each.get(GRADES[-1])
        assert usual is not None
        only = [row for row in chosen(rows, ONLY) if row["cause"] == cause and row["grade"] == GRADES[1]]
        lines.append(
            [
                cause,
                *(
                    with_limits(row[view]["likelihood"]) if row else ""
                    for view in (BOTH, MODELS[-1])
                    for row in (usual, gross)
                ),
                percent(only[0][MODELS[-1]]["likelihood"][0]) if only else "",
                percent(usual[MODELS[-1]]["reverse_likelihood"][0]),
                percent(usual[MODELS[-1]]["span_2.5_alone"][0]),
            ]
        )
    heads = ["cause", "both predictions, usual size", "both, gross", "nonlinear, usual", "nonlinear, gross"]
    return table(
        [*heads, "nonlinear, usual, at Span 2.5 only", "reverse, nonlinear, usual", "Span 2.5 alone, nonlinear, usual"],
        lines,
    )


def pooled(rows: Rows, view: str, way: str, variant: str = AS_FIXED) -> int:
    """Count the members of all cells that show the pattern ("pattern") or its "reverse", in every test."""
    return sum(row[view][way][variant][0] + row[view][way][variant][2] for row in chosen(rows, EVERY))


def variant_table(rows: Rows) -> str:
    """Write how many members show pattern and reverse by each variant of the criterion."""
    lines = [
        [variant, *(str(pooled(rows, view, way, variant)) for way in ("pattern", "reverse") for view in VIEWS)]
        for variant in VARIANTS
    ]
    return table(["criterion", *(f"{way}: {view}" for way in ("pattern", "reverse") for view in VIEWS)], lines)


def engine_table(engines: dict[str, Any]) -> str:
    """Write how many members keep their verdict with other engines."""
    return table(
        ["Span 2.5 run again with", "members", "same verdict"],
        [[name, str(each["members"]), str(each["same"])] for name, each in engines.items()],
    )


def repeat_table(rows: Rows, repeats: Rows) -> str:
    """Write likelihoods of other seeds, series and time scales with those of the study, nonlinear prediction, %."""
    cells = list(dict.fromkeys((row["cause"], row["grade"]) for row in repeats))
    lines = []
    for run in dict.fromkeys(["as in the study", *(row["run"] for row in repeats)]):
        line = [run]
        for cell in cells:
            source = chosen(rows, EVERY) if run == "as in the study" else [row for row in repeats if row["run"] == run]
            (row,) = (each for each in source if (each["cause"], each["grade"]) == cell)
            line += [with_limits(row["nonlinear"]["likelihood"]), percent(row["nonlinear"]["span_2.5_alone"][0])]
        lines.append(line)
    heads = [f"{cause}, {grade}: {what}" for cause, grade in cells for what in ("pattern", "Span 2.5 alone")]
    return table(["run", *heads], lines)


def sum_of(told: Rows, cause: str) -> dict[str, int]:
    """Add up what further measurements told of all sizes of a cause."""
    found: dict[str, int] = {"members": 0}
    for row in told:
        if row["cause"] == cause:
            for name, value in row.items():
                if name not in ("cause", "grade"):
                    found[name] = found.get(name, 0) + value
    return found


def instrument_table() -> str:
    """Write what each instrument decides at the usual size of a cause, and from which size on."""
    lines = []
    names = dict.fromkeys(direct.instrument for each in DIRECT.values() for direct in each)
    for name in sorted(names, key=lambda each: -instrument_information(each)):
        shown = [
            f"{cause} ({direct.what}): {_from(cause, direct)}"
            for cause, each in DIRECT.items()
            for direct in each
            if direct.instrument == name
        ]
        lines.append([name, "; ".join(shown), listed(resolved(name)), f"{instrument_information(name):.2f}"])
    return table(["measurement", "what it shows, and from which size on", "decides at the usual size", "bits"], lines)


def _from(cause: str, direct: Direct) -> str:
    if direct.deviation == 0.0:
        return "any size"
    return "from " + size_text(CAUSES[cause]._replace(sizes=(decided_from(direct),) * 2), 0)


def telling_table(told: Rows) -> str:
    """Write what a repeat of Span 2.5 shows by cause, and whether another e would make the prediction fit."""
    lines = []
    for cause in causes_of(told):
        found = sum_of(told, cause)
        if found["members"] == 0:
            continue
        shares = [
            percent(found[f"{name} {each:g}"] / found["members"])
            for name, sizes in (("repeats", REPEATABILITY), ("again", REPEATABILITY), ("refitted", REFITTED))
            for each in sizes
        ]
        lines.append([cause, str(found["members"]), *shares])
    heads = [f"measured repeats, table ± {100 * each:g} %" for each in REPEATABILITY]
    heads += [f"pattern again, table ± {100 * each:g} %" for each in REPEATABILITY]
    heads += [f"an e within ± {each:g} fits" for each in REFITTED]
    return table(["cause", "tests", *heads], lines)


def repeat_information(told: Rows, outcome: str, fewest: int = 12) -> tuple[float, int]:
    """Give what an outcome of a repeat tells between causes, bits, and between how many; equal weights."""
    sums = [sum_of(told, cause) for cause in causes_of(told) if cause != "all"]
    shares = np.array([each[outcome] / each["members"] for each in sums if each["members"] >= fewest])
    if shares.size < 2:
        return 0.0, int(shares.size)
    return information(np.column_stack((shares, 1.0 - shares))), int(shares.size)


def verdict(rows: Rows, view: str) -> tuple[list[tuple[str, str]], dict[str, dict[str, float]]]:
    """Give the pairs that the rule decides, and the limits of all causes."""
    limits = best_and_worst(rows, view, EVERY)
    return decided(limits), limits


def seen(rows: Rows, view: str, scope: str = EVERY) -> list[str]:
    """Name the causes that make the pattern at some size."""
    return [
        cause
        for cause in causes_of(rows)
        if any(row[view]["likelihood"][0] > 0.0 for row in chosen(rows, scope) if row["cause"] == cause)
    ]


def listed(names: Sequence[str]) -> str:
    """Write names in a line."""
    if len(names) <= 1:
        return "".join(names) or "none"
    return ", ".join(names[:-1]) + " and " + names[-1]


def strongest(rows: Rows, view: str, scope: str, most: int = 2) -> list[str]:
    """Name the causes and sizes whose likelihood is largest, with it; none that was never seen."""
    ranked = sorted(chosen(rows, scope), key=lambda row: -row[view]["likelihood"][0])[:most]
    return [
        f"{percent(row[view]['likelihood'][0])} % ({row['cause']}{', ' if row['grade'] else ''}{row['grade']})"
        for row in ranked
        if row[view]["likelihood"][0] > 0.0
    ]


def places(rows: Rows, view: str, scope: str = EVERY) -> tuple[int, int]:
    """Count the members whose pattern is at "about 6 s", and all that show it."""
    part = chosen(rows, scope)
    count = sum(row[view]["pattern"][AS_FIXED][0] + row[view]["pattern"][AS_FIXED][2] for row in part)
    return sum(row[view]["about_6_s"] for row in part), count


def horizon_text(horizons: dict[str, Any]) -> str:
    """Write the horizons of the three Spans."""
    each = (f"{horizons[f'{span:g}']['horizon'][1]:.1f} s" for span in SPANS)
    return listed([*each])


def slide_text(space: Rows) -> str:
    """Write how far the prism slides and turns, by cause in space at its largest size."""
    lines = []
    for cause in SPACE:
        row = [each for each in space if each["cause"] == cause][-1]
        lines.append(
            [cause, row["grade"] or "–", f"{row['slide_mm']:g}", f"{row['out_of_plane']:g}", f"{row['yaw_degrees']:g}"]
        )
    return table(["cause", "size", "slide, mm", "rotation out of plane, α", "turn, °"], lines)
