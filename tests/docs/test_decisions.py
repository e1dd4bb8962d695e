"""Decisions: one a number, none lost, and two that contradict each other name each other."""

import re

from page_blocks import PROJECT

FOLDER = PROJECT / "docs" / "decisions"
PAGES = {path.name: path.read_text(encoding="utf-8") for path in FOLDER.glob("0*.md")}


def test_each_number_is_given_once_and_a_missing_one_is_accounted_for():
    numbers = sorted(int(name[:4]) for name in PAGES)
    assert len(numbers) == len(set(numbers))
    missing = [number for number in range(1, numbers[-1]) if number not in numbers]
    said = re.findall(r"no decision (\d+)", (FOLDER / "README.md").read_text(encoding="utf-8"))
    assert missing == [int(number) for number in said]
    assert [name for name, text in PAGES.items() if not text.startswith(f"# {int(name[:4])} · ")] == []


def test_a_reversed_decision_and_the_page_that_reverses_it_lead_to_each_other():
    pattern = r"[Rr]everses \[decision \d+\]\(([^)]+)\)"
    reversals = [(name, old) for name, text in PAGES.items() for old in re.findall(pattern, text)]
    assert reversals
    assert [(new, old) for new, old in reversals if f"({new})" not in PAGES[old]] == []
