"""The faults of docs/faults/: each is named as its page says, its mend works, and nothing is said without it."""

import re
import shutil

import numpy as np
import pytest

from fault_atlas import DOCUMENTS, FAULTS, GROUPS, mending_lines, planted
from faults.sound import RESTITUTION, findings, keep_only, write_sound
from faults.unseen import UNSEEN, effect

pytestmark = pytest.mark.whole

SLOW = {"table-that-moves-in-a-free-vibration"}
"""Mended, e is found on a table that moves: 50 s of processor time."""

NUMBER = re.compile(r"-?\d+(?:\.\d+)?")


@pytest.fixture(scope="module")
def sound(tmp_path_factory):
    folder = tmp_path_factory.mktemp("faults") / "sound"
    write_sound(folder)
    return folder


@pytest.fixture(scope="module")
def sections():
    """What the pages print of each fault: the message, and the page."""
    found = {}
    for group in GROUPS:
        text = (DOCUMENTS / f"{group.name}.md").read_text(encoding="utf-8")
        parts = re.split(r"^## ", text, flags=re.MULTILINE)[1:]
        found |= {fault.slug: part for fault, part in zip(group.faults, parts, strict=True)}
    return found


def numbers_apart(text):
    """Text without its numbers, and the numbers: their last digits differ between processors."""
    return NUMBER.sub("#", text), [float(number) for number in NUMBER.findall(text)]


@pytest.mark.parametrize("slug", FAULTS)
def test_a_planted_fault_is_named_as_the_page_says(slug, sound, sections, tmp_path):
    fault = FAULTS[slug]
    told = findings(fault.command, planted(fault, sound, tmp_path / slug))
    assert re.search(fault.message, told, re.IGNORECASE), told
    [printed] = re.findall(r"```text\n(.*?)\n```", sections[slug], re.DOTALL)
    (words, values), (expected, of_page) = numbers_apart(told), numbers_apart(printed)
    assert words == expected
    np.testing.assert_allclose(values, of_page, rtol=0.02)


@pytest.mark.parametrize(
    "slug", [pytest.param(slug, marks=[pytest.mark.slow] * (slug in SLOW)) for slug in FAULTS if FAULTS[slug].mending]
)
def test_the_lines_of_the_page_mend_a_fault(slug, sound, sections, tmp_path):
    fault = FAULTS[slug]
    faulty = planted(fault, sound, tmp_path / slug)
    mended = shutil.copytree(faulty, tmp_path / "mended")
    fault.mending(mended)
    assert mending_lines(faulty, mended) in sections[slug]
    told = findings(fault.command, mended)
    assert bool(re.search(fault.message, told, re.IGNORECASE)) is fault.stays, told


@pytest.mark.parametrize("test", ["free", "sine", "quake"])
def test_without_a_fault_nothing_is_said(test, sound, tmp_path):
    folder = shutil.copytree(sound, tmp_path / "campaign")
    keep_only(test, folder)
    assert findings("check", folder) == ""


def test_what_is_not_found_is_so(sound, tmp_path):
    page = (DOCUMENTS / "not-found.md").read_text(encoding="utf-8")
    for number in (0, 2):
        fault = UNSEEN[number]
        found = effect(fault, shutil.copytree(sound, tmp_path / str(number)))
        assert found.told == ""
        [(held, value)] = re.findall(rf"^\| {re.escape(fault.name)} \| ([\d.]+) α \| ([\d.]+) \|", page, re.MULTILINE)
        assert found.held == pytest.approx(float(held), abs=1e-3)
        assert found.restitution == pytest.approx(float(value), abs=1e-4)
        assert found.restitution == pytest.approx(RESTITUTION, abs=1e-3)
