"""The tutorial's campaign.toml says what the draft of `init` says with its questions answered from the wiring sheet."""

import shutil

import pytest

from colonnade.campaign import load
from colonnade.campaign.draft.write import draft
from filling_in import filled_in
from page_blocks import PROJECT, Block, Reader, blocks_of

TUTORIAL = PROJECT / "docs" / "tutorial"
LARGEST = 150_000
"""Bytes of a picture."""

SHEET = {
    "width": '"100 mm"',
    "depth": '"100 mm"',
    "height": '"500 mm"',
    "mass": '"11.50 kg"',
    "relative_to": '"table"',
    "lvdt_1.gain": '"15 mm/V"',
    "lvdt_2.gain": '"15 mm/V"',
    "tischweg.gain": '"5 mm/V"',
    "acc.gain": '"0.2 g/V"',
    "daq2.clock": '{align = ["tischweg", "acc"]}',
    "lvdt_1.at": '["50 mm", "0 mm", "440 mm"]',
    "lvdt_2.at": '["50 mm", "0 mm", "40 mm"]',
}
"""Answers, by the end of the question's key."""


@pytest.mark.whole
def test_the_draft_with_its_answers_is_the_campaign_of_the_page(tmp_path):
    blocks = blocks_of(TUTORIAL / "morning.md")
    reader = Reader(tmp_path)
    reader.do(next(block for block in blocks if block.remark == "with"))
    drafted = draft(tmp_path / "morning")

    def answer(table, key):
        [found] = [value for asked, value in SHEET.items() if f"{table}.{key}".endswith(asked)]
        return found

    filled_in(drafted, answer)
    by_draft = load(drafted.path)

    [written] = [block for block in blocks if block.remark == "file"]
    reader.do(Block(written.place, "toml", written.text, "file", "page/campaign.toml"))
    shutil.copytree(tmp_path / "morning" / "raw", tmp_path / "page" / "raw")
    by_page = load(tmp_path / "page")

    def recorded(campaign):
        """What each test's columns are, whatever the channels are called."""
        return {
            test.id: (
                test.kind,
                sorted(
                    (each.column, str(each.quantity), str(each.gain), str(each.on), str(each.at), str(each.relative_to))
                    for each in campaign.setups[test.setup].channels.values()
                ),
            )
            for test in campaign.tests.values()
        }

    assert recorded(by_draft) == recorded(by_page)
    [drafted_specimen], [specimen] = by_draft.specimens.values(), by_page.specimens.values()
    assert drafted_specimen == specimen


@pytest.mark.parametrize("picture", sorted(path.name for path in TUTORIAL.iterdir() if path.suffix in (".svg", ".png")))
def test_a_picture_is_small_and_shown(picture):
    assert (TUTORIAL / picture).stat().st_size <= LARGEST
    assert any(f"]({picture})" in page.read_text(encoding="utf-8") for page in TUTORIAL.glob("*.md"))
