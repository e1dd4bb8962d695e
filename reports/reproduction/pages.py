"""The pages of the reproduction, written from the numbers of results.json alone."""

from __future__ import annotations

from colonnade.report.references import REFERENCES
from reproduction.contents import PAGES
from reproduction.markdown import VIRTUAL
from reproduction.statement import HISTORIES, WORDS, Numbers
from reproduction.statement_table import figure_of, statement_table
from reproduction.statements import STATEMENTS, answers
from study import table


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
                f"{REFERENCES['manos']} The copy at hand shows neither title nor year: these words describe it. Its "
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
