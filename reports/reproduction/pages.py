"""The pages of the reproduction, written from the numbers of results.json alone."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

from reproduction.drawings import FIGURES
from reproduction.markdown import VIRTUAL, figure, figure_of, fixed, of_figure, shown, statement_table
from reproduction.printed import FREQUENCIES, LAST_DIGIT, SHOWN, SLIPS, SPANS, TABLE_1
from reproduction.statement import HISTORIES, WORDS, Numbers
from reproduction.statements import STATEMENTS, answers
from reproduction.statements.computation import modulus_for
from reproduction.statements.sines import shown as test_shown
from reproduction.statements.specimens import QUANTITIES, UNITS, percent_off
from study import Cells, columns, table


def _tables(numbers: Numbers) -> list[str]:
    """Write both tables, printed and computed, and the arithmetic of the time steps."""
    return [*_table_1(numbers), *_table_2(numbers)]


def _table_1(numbers: Numbers) -> list[str]:
    rows = [
        [
            specimen,
            f"{QUANTITIES[quantity]}, {UNITS[quantity]}",
            f"{printed:g}",
            f"{numbers['specimens'][specimen][quantity]:.4f}",
            percent_off(printed, numbers["specimens"][specimen][quantity]),
        ]
        for specimen, row in TABLE_1.items()
        for quantity, printed in row.printed.items()
    ]
    restitution = [
        [specimen, "e of a rigid body without bounce", "–", f"{each['rigid_restitution']:.4f}", "–"]
        for specimen, each in numbers["specimens"].items()
    ]
    return [
        "## Table 1",
        "Computed from dimensions and mass, g = 9.81 m/s².",
        table(("specimen", "quantity", "printed", "computed", "printed over computed"), rows + restitution),
    ]


def _table_2(numbers: Numbers) -> list[str]:
    cells: Cells = {
        "mesh": "{mesh}",
        "step, µs": lambda row: f"{1e6 * row['step']:g}",
        "CDF, paper": "{printed_fraction:.2f}",
        "CDF, ours": lambda row: fixed(row["fraction"]),
        "stiffness": lambda row: "–" if row["multiple"] is None else f"{row['multiple']:g}",
        "e with the paper's CDF": lambda row: fixed(row["restitution_with_printed"], 4),
        "cost, paper": "{printed_cost}",
        "cost, ours": lambda row: shown(row["cost"], 2),
    }
    steps: Cells = {
        "mesh": "{mesh}",
        "DOF, paper": "{printed_degrees_of_freedom}",
        "ours": "{description}",
        "edge, mm": lambda row: f"{1e3 * row['edge']:.1f}",
        "longest step, µs": lambda row: f"{1e6 * row['step']:.2f}",
        "GPa for 10 µs": lambda row: shown(modulus_for(1e-5, row["step"]) / 1e9, 2),
        "GPa for 100 µs": lambda row: shown(modulus_for(1e-4, row["step"]) / 1e9, 2),
    }
    speed = numbers["stable_steps"][0]["speed"]
    stable = next(run for run in numbers["unreduced"] if run["mesh"] == "coarse" and run["modulus"] > 1e11)
    return [
        "## Table 2",
        "The critical damping fraction that gives free rocking the analytical e, and what a free vibration costs, in "
        "seconds. Ours are of reduced elastic elements, from [the study of the contact model](../contact-study.md), "
        "which says how they were found; the stiffness of the contact is a multiple of its default. The paper does "
        "not say on which computer it ran, how long its free vibration was, or which stiffness its contact had, so "
        "the columns compare in their trends only.",
        columns(cells, numbers["table_2"]),
        "An explicit scheme is stable up to about the shortest edge over the speed of pressure waves, here "
        f"{speed:.0f} m/s in steel of 200 GPa. The modulus that a longer step would allow falls with its square.",
        columns(steps, numbers["stable_steps"]),
        f"Measured with the contact (the same study), the coarse mesh of steel is stable up to "
        f"{1e6 * stable['stable']:.2f} µs.",
    ]


PAPER = (
    "Manos, G. C., Petalas, A. and Demosthenous, M. Experimental and numerical study of the rocking of "
    "free-standing steel models, 1:20, of ancient columns on the Earthquake Simulator Facility of Aristotle "
    "University of Thessaloniki."
)

MODELS = ("linear", "nonlinear", "contact")


class Page(NamedTuple):
    """A page: its title, the numbers of the paper's tables and figures on it, and what it holds of the numbers."""

    title: str
    of: str
    contents: Callable[[Numbers], list[str]]


def _figures(numbers: Numbers, *chosen: str) -> list[str]:
    """Show figures of the paper, each with what the paper says of it."""
    return [
        part
        for entry in FIGURES
        if entry.number in chosen
        for part in (figure(entry.number, entry.title), statement_table(of_figure(entry.number), numbers))
    ]


def _setting(numbers: Numbers) -> list[str]:
    made = numbers["made"]
    contact = made["contact"]
    return [
        f"The virtual campaign is the demo's programme (seed {made['seed']}, {made['tests']} tests) with the two "
        "levels at 3 Hz that the paper shows and the demo leaves out. Its true motions are the nonlinear model's; "
        "its instruments are imperfect. colonnade reads its raw files like those of any laboratory.",
        "The paper's *analytical* results are those of the linearised equation: our model `linear`, exact between "
        "impacts. Its *numerical* results are those of elastic finite elements on a contact: the nearest that we "
        f"have is our model `contact`, here a {contact['body']}, with friction {contact['friction']:g}, a step of "
        f"{1e6 * contact['step']:g} µs and the damping fraction {contact['damping_fraction']:.3f} that gives free "
        "rocking the identified e. Our elastic meshes are in [Table 2](tables.md).",
        "That a computed response agrees with a virtual test shows that both follow from one plane equation. It does "
        "not show that the real prism did.",
    ]


def _outcome(found: Numbers, digits: int) -> str:
    """Say how a test ended, and its largest |θ|/α if it has one."""
    peak = found["peak_ratio"]
    return str(found["outcome"]) if peak is None else f"{found['outcome']}, {peak:.{digits}f}"


def _free(numbers: Numbers) -> list[str]:
    spans = [(model, when) for model in MODELS for when in ("early", "late")]
    rows = [
        [test, *(fixed(each[model][when], 3) for model, when in spans)]
        for test, each in numbers["free_vibrations"].items()
    ]
    values: Cells = {
        "specimen": "{specimen}",
        "true e": "{true:g}",
        "identified": "{value:.5f}",
        "95 % interval": lambda each: f"± {(each['high'] - each['low']) / 2:.0e}",
        "by the whole history, each record": lambda each: ", ".join(
            fixed(value, 4) for value in each["by_whole_histories"]
        ),
    }
    return [
        *_figures(numbers, "3", "10"),
        "## Coefficient of restitution",
        "Pooled over the free vibrations, and of each record: the e with which the nonlinear model follows its whole "
        "history best.",
        columns(values, [{"specimen": name, **each} for name, each in numbers["restitution"].items()]),
        "## Misfit, large and small amplitudes",
        "RMS of predicted less measured θ over α, in the first four predicted arcs (early) and in the twelve after "
        "them (late). The virtual prism cannot leave its plane: what the linear model misses here is the equation's "
        "own.",
        table(("test", *(f"{model}, {when}" for model, when in spans)), rows),
        "What turns a real release three-dimensional is answered by [the study of the contact "
        "model](../contact-study.md#what-turns-rocking-three-dimensional).",
    ]


def _sines(numbers: Numbers) -> list[str]:
    rows = []
    for level in SHOWN:
        name, test = test_shown(numbers, level)
        rows.append(
            [
                name,
                f"{test['frequency_ratio']:.2f}",
                f"{test['amplitude_ratio']:.3f}",
                *(_outcome(each, 2) for each in (test, *(test["predicted"][model] for model in MODELS))),
                numbers["sines"][name]["first_order"] or "–",
                test["order"] or "–",
            ]
        )
    return [
        *_figures(numbers, "4"),
        "## In numbers",
        "Outcome and largest |θ|/α; order of the measured response (1: harmonic, n: sub-harmonic 1/n) in the first "
        "ten periods of the steady sine, and settled.",
        table(("test", "Ω", "A", "measured", *MODELS, "order at first", "settled"), rows),
        "## In space",
        "The contact model on recorded motions of four tests, from a rotation about x of 1 mrad: largest slide of the "
        "base and rotations about x and about the vertical, up to the angle of 0.28 rad at which the frame catches "
        "the prism. The last column is what the balance of energy misses. These runs are chaotic: a start that differs "
        "by a billionth can give another largest rotation, and even another outcome.",
        columns(IN_SPACE, numbers["in_space"]),
    ]


IN_SPACE: Cells = {
    "test": "{test}",
    "friction": "{friction:g}",
    "outcome": "{outcome}",
    "slide, mm": lambda each: f"{1e3 * each['slide']:.2g}",
    "out of plane, % of α": lambda each: f"{100 * each['out_of_plane']:.1f}",
    "turn, °": lambda each: f"{57.29578 * each['yaw']:.2g}",
    "energy missing, %": lambda each: f"{100 * each['energy_residual']:.2g}",
}


def _maps(numbers: Numbers) -> list[str]:
    charts = numbers["maps"]
    limits = [charts[model][limit] for model in ("linear", "contact") for limit in ("lower", "upper")]
    rows = [
        [
            f"{frequency:g}",
            f"{each['frequency_ratio']:.3f}",
            *map(_bracket, (each["rocking"], each["overturning"])),
            ", ".join(f"{level:.2f}" for level in each["stood_above"]) or "–",
            *map(fixed, computed),
        ]
        for frequency, each, *computed in zip(FREQUENCIES, numbers["boundaries"], *limits, strict=True)
    ]
    width, levels = charts["contact"]["width"], charts["contact"]["levels"]
    off = [
        [model, *(_off(each[f"{name}_off"]) for name in ("no_rocking", "lower", "upper"))]
        for model, each in {"linear, finely scanned": numbers["fine_map"], **charts}.items()
    ]
    made = numbers["made"]["map"]
    return [
        *_figures(numbers, "5", "7", "12", "13"),
        "## How they are made",
        f"All maps: sine of {made['cycles']} cycles, ramps of {made['ramp']}; the paper states neither. A limit "
        "depends on both, and on how finely A is scanned. Figure 7 is scanned finely: an interval of A that "
        f"overturns counts from {numbers['fine_map']['width']:g} on. The contact model is too slow for that. The "
        f"maps of figures 12 and 13 have {levels} levels, {width:.4f} apart, at the seven frequencies of the tests. "
        "Their limits are read from these levels, as the measured boundary is read from tests: the lower one is "
        "halfway between the first level that overturns and the one before it, the upper one halfway between the "
        "last level that stands and the next. A dash: nothing overturns, or the largest level stands.",
        "## Measured brackets and computed limits",
        "A bracket is the largest A short of a boundary and the smallest beyond it.",
        table(("Hz", "Ω", "onset of rocking", "overturning", "stands again at", *LIMITS), rows),
        "Computed limit over the middle of the measured bracket, less one: mean and RMS over the frequencies that "
        "have both.",
        table(("model", "onset of rocking", "lower limit", "upper limit"), off),
    ]


LIMITS = ("linear: lower", "upper", "contact: lower", "upper")


def _bracket(bracket: list[float | None]) -> str:
    return f"{fixed(bracket[0])} to {fixed(bracket[1])}"


def _off(found: Numbers) -> str:
    if found["rms"] is None:
        return "–"
    return f"{100 * found['mean']:+.1f} %, {100 * found['rms']:.1f} % ({found['frequencies']})"


def _earthquakes(numbers: Numbers) -> list[str]:
    rows = []
    for span in SPANS:
        each = numbers["earthquakes"][f"{span:.1f}"]
        test = numbers["tests"][each["test"]]
        rows.append(
            [
                f"{span:.1f}",
                fixed(test["pga"]),
                *(_outcome(found, 3) for found in (test, *(test["predicted"][model] for model in MODELS))),
                *(fixed(test["predicted"][model]["nrmse"], 3) for model in MODELS),
                fixed(each["numerical_to_analytical"], 3),
            ]
        )
    steps: Cells = {
        "Span": "{span}",
        "scheme": lambda row: {"runge-kutta": "Runge–Kutta", "hamming": "Hamming"}[row["scheme"]],
        "DT, s": "{step:.0e}",
        "RMS error": lambda row: f"{100 * row['rms_error']:.2f} %",
        "largest error": lambda row: f"{100 * row['largest_error']:.2f} %",
    }
    return [
        *_figures(numbers, "8", "14", "15"),
        "## In numbers",
        "Table's peak acceleration, m/s²; outcome and largest |θ|/α; RMS of predicted less measured θ over α, and of "
        "contact less linear model.",
        table(("Span", "peak, m/s²", "measured", *MODELS, "misfit: linear", *MODELS[1:], "contact − linear"), rows),
        "## The paper's own time step",
        "Its two schemes, with the step divided by ten around each contact, against the exact solution of the linear "
        "equation on the same recorded motion: error of θ over α. A contact is taken at the end of the step in which "
        "θ changes its sign; how the paper's program takes it is not stated. If it does so too, its step alone moves "
        "the responses to these motions by up to "
        f"{100 * max(row['largest_error'] for row in numbers['schemes']):.0f} % of α: a cause of misfit besides "
        "those of the study of Span 2.5.",
        columns(steps, numbers["schemes"]),
        "How often a prediction misbehaves as at the paper's Span 2.5, and of which cause, is [a study of its "
        "own](span-2.5.md).",
    ]


def _slips(numbers: Numbers) -> list[str]:
    found = answers(numbers)
    rows = [
        [slip.where, slip.printed, slip.meant, found[slip.statement].ours if slip.statement else "seen in the text"]
        for slip in SLIPS
    ]
    printed = ", ".join(f"{quantity.replace('_', ' ')} {digit:g}" for quantity, digit in LAST_DIGIT.items())
    return [
        "Where the paper contradicts itself, or its own dimensions. None of them changes what it observed. The "
        "printed “angle” even is the right number to divide an acceleration by: see [the setting](setting.md).",
        table(("where", "printed", "what it is", "arithmetic"), rows),
        f"One unit of the last printed digit, in SI units: {printed}.",
    ]


PAGES: dict[str, Page] = {
    "setting": Page("The setting, and what stands for what", "", _setting),
    "tables": Page("Tables 1 and 2", "Table 1, Table 2", _tables),
    "free-vibration": Page("Free vibration", "figures 3 and 10", _free),
    "sines": Page("Sine tests", "figures 4a–c", _sines),
    "maps": Page("Maps of outcomes", "figures 5, 7, 12, 13", _maps),
    "earthquakes": Page("Earthquake tests", "figures 8a–c, 14a–c, 15a–c", _earthquakes),
    "slips": Page("Slips, with the arithmetic", "", _slips),
}
"""By the name of the file, in the order of the index."""


def pages(numbers: Numbers) -> dict[str, str]:
    """Write all pages; return their text by file name."""
    return {"index.md": _index(numbers), **{f"{name}.md": _page(name, numbers) for name in PAGES}}


def _page(name: str, numbers: Numbers) -> str:
    page = PAGES[name]
    parts = [VIRTUAL, f"# {page.title}", *page.contents(numbers)]
    others = [statement for statement in STATEMENTS if statement.page == name and figure_of(statement) is None]
    if others:
        parts += ["## Further statements", statement_table(others, numbers)]
    return "\n\n".join([*parts, "[All pages](index.md)"]) + "\n"


def _index(numbers: Numbers) -> str:
    found = answers(numbers)
    counts = {verdict: sum(each.verdict == verdict for each in found.values()) for verdict in WORDS}
    listed = []
    for name, page in PAGES.items():
        mine = [found[each.id].verdict for each in STATEMENTS if each.page == name]
        tally = [str(mine.count(verdict)) if mine else "–" for verdict in WORDS]
        listed.append([f"[{page.title}]({name}.md)", page.of or "–", *tally])
    listed.append(["[Span 2.5](span-2.5.md): why one prediction failed", "figures 8b, 14b", "–", "–", "–"])
    differing = [each for each in STATEMENTS if found[each.id].verdict == "differs"]
    return (
        "\n\n".join(
            [
                VIRTUAL,
                "# The paper, statement by statement",
                f"**Of its {len(STATEMENTS)} statements {counts['agrees']} agree, {counts['differs']} differ, and "
                f"{counts['undecided']} cannot be decided with synthetic data.**",
                f"{PAPER} The copy used shows neither title nor year: these words describe it. Its "
                "recordings are not public.",
                "`make reproduce` runs the paper's programme on the virtual shake table (seed "
                f"{numbers['made']['seed']}), draws its figures and answers each statement by rule. All numbers are in "
                "[results.json](results.json).",
                table(("page", "of the paper", "agree", "differ", "undecided"), listed),
                "The paper calls agreement good or very good without a measure. Ours: two histories of θ agree well "
                f"up to an RMS difference of {HISTORIES['good']:g} α; for boundaries on the map see [Maps](maps.md).",
                "## What differs",
                table(
                    ("where", "the paper says", "we find", "page"),
                    [
                        [each.section, each.says, found[each.id].ours, f"[{each.page}]({each.page}.md)"]
                        for each in differing
                    ],
                ),
                "Large first amplitudes of cylinder and cone: [the study of the contact model](../contact-study.md) "
                "looks for their cause. The paper's integration schemes: [the study of their "
                "convergence](../convergence.md).",
            ]
        )
        + "\n"
    )
