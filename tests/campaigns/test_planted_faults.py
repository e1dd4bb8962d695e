"""The faults of docs/faults/: each is named as its page says, its mend works, and nothing is said without it."""

import re
import shutil

import numpy as np
import pytest

from fault_atlas import DOCUMENTS, FAULTS, GROUPS, mending_lines, planted
from faults.fault import TOP, both, channel_line, in_file
from faults.sound import COMMANDS, RESTITUTION, findings, keep_only, write_sound
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


def _saturated(samples):
    """The top at 80 % of its largest value, under noise."""
    zero, noise = np.median(samples[:200, TOP]), np.random.default_rng(0).normal(0, 0.002, len(samples))
    limit = 0.8 * np.abs(samples[:, TOP] - zero).max()
    samples[:, TOP] = np.clip(samples[:, TOP], zero - limit, zero + limit) + noise
    return samples


MISTAKES = {
    "saturated, without a range": (
        "quake",
        both(channel_line("rig", "top", ', range = "10 V"', ""), in_file("quake.csv", _saturated)),
        r"warning \(end of the range\): quake: channel top: .*: the channel saturates, .* Its peaks are lower bounds",
    ),
    "V for mm": (
        "free",
        channel_line("frame", "top", 'unit = "V", gain = "15 mm/V", range = "10 V"', 'unit = "mm"'),
        r'serious \(unit\): free: channel top: free.csv says "V" .* the campaign file says "mm"',
    ),
}


@pytest.mark.parametrize("mistake", MISTAKES)
def test_the_true_cause_comes_first(mistake, sound, tmp_path):
    test, plant, expected = MISTAKES[mistake]
    folder = shutil.copytree(sound, tmp_path / "campaign")
    keep_only(test, folder)
    plant(folder)
    for command in COMMANDS:
        told = findings(command, folder)
        first = re.search(r"^(?:serious|warning).*", told, re.MULTILINE)
        assert re.match(expected, first[0]), told


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
