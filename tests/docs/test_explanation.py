"""The explanation pages: the files that they name exist, and the figures of the verification page are the studies'."""

import re

import pytest

import colonnade
import verification
from every import every
from faults.sound import PRISM, earthquake
from page_blocks import PROJECT

PAGES = sorted((PROJECT / "docs" / "explanation").glob("*.md"))
STRENGTH = 0.55
"""Of the earthquake on the page: the block is sensitive to it."""

PLACES = (PROJECT, PROJECT / "pipeline" / "colonnade")


@every("page", PAGES, ids=lambda page: page.stem)
def test_the_files_that_a_page_names_exist(page):
    named = re.findall(r"`((?:\w+/)+[\w.-]*)`", page.read_text(encoding="utf-8"))
    assert [name for name in named if not any((place / name).exists() for place in PLACES)] == []


def test_the_figures_of_the_verification_page_are_those_of_the_studies():
    document = verification.DOCUMENT.read_text(encoding="utf-8")
    assert verification.renewed(document, verification.MARKS, verification.measured()) == document
    changed = document.replace("93.9", "99.9")
    assert verification.renewed(changed, verification.MARKS, verification.measured()) == document


@pytest.mark.parametrize("page", ["docs/index.md", "docs/explanation/paper.md"])
def test_a_page_counts_the_papers_statements_as_their_page_does(page):
    counted = r"(\d+) statements\D+(\d+) agree, (\d+) differ,? and (\d+) cannot be decided"
    [due] = re.findall(counted, (PROJECT / "reports" / "manos" / "index.md").read_text(encoding="utf-8"))
    assert re.findall(counted, (PROJECT / page).read_text(encoding="utf-8")) == [due]


@pytest.mark.parametrize(("change", "outcome"), [(0.0, "overturned"), (1e-3, "rocking")])
def test_a_motion_that_is_stronger_by_a_thousandth_does_not_overturn_the_block(change, outcome):
    motion = earthquake(1)
    shaken = colonnade.Motion(STRENGTH * (1 + change) * motion.acceleration, 0.25 * motion.dt)
    assert colonnade.rock(PRISM, shaken, restitution=0.976).outcome == outcome


ASSESSMENT = PROJECT / "docs" / "explanation" / "assessment.md"


def test_the_example_of_an_assessment_runs(capsys):
    [block] = re.findall(r"```python\n(.*?)```", ASSESSMENT.read_text(encoding="utf-8"), re.DOTALL)
    names = {}
    exec(compile(block, str(ASSESSMENT), "exec"), names)
    assert names["measured"].values["pga"] < 2.5
    assert 0.1 < names["found"].isotonic.reaches(0.5).value < 10.0
    assert names["spectrum"].overturned.shape == (1, 2)
    assert names["limits"].lower[0] < names["limits"].upper[0]
    assert capsys.readouterr().out.count("\n") == 4
