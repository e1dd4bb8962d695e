"""A pipe or a device where a file was expected is told and not waited for; hostile text costs no time and no screen."""

import os
from pathlib import Path

import pytest

import colonnade
from colonnade import units
from colonnade.campaign import load
from colonnade.campaign.draft.write import draft
from colonnade.campaign.syntax.document import key_lines
from colonnade.errors import CampaignError, ReadError, UnitError
from colonnade.readers.text.heading import take_apart
from colonnade.workflow import run

pipes = pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="named pipes are POSIX's")
CAMPAIGN = """\
schema = 1
campaign = "pipes"
title = "Pipes"
{tests}
[specimens]
prism = {{shape = "prism", width = "86 mm", depth = "86 mm", height = "456 mm", mass = "26.10 kg"}}

[setups.frame.channels]
table = {{column = 2, quantity = "acceleration", unit = "m/s^2", on = "table", direction = [1, 0, 0]}}

{rest}
"""
TEST = '[[tests]]\nid = "a"\nkind = "earthquake"\nmotion = "m"\nspecimen = "prism"\nsetup = "frame"\nfile = "a.csv"\n'
RECORD = "t,a\n" + "".join(f"{n / 100},{n % 5}\n" for n in range(900))
BLANKS = " " * 200_000


def write(folder, tests="", rest=TEST):
    (folder / "campaign.toml").write_text(CAMPAIGN.format(tests=tests, rest=rest), encoding="utf-8")
    return folder


@pipes
def test_a_campaign_file_a_review_and_a_test_log_that_are_pipes_are_told(tmp_path):
    os.mkfifo(tmp_path / "campaign.toml")
    for path in (tmp_path, tmp_path / "campaign.toml"):
        with pytest.raises(CampaignError, match="this is a named pipe; a text file"):
            load(path)
    (tmp_path / "campaign.toml").unlink()
    for log in ("log.csv", "log.xlsx"):
        os.mkfifo(tmp_path / log)
        with pytest.raises(CampaignError, match=rf"{log}: this is a named pipe; a test log was expected"):
            load(write(tmp_path, tests=f'tests = "{log}"', rest=""))
    os.mkfifo(tmp_path / "review.toml")
    with pytest.raises(CampaignError, match=r"review\.toml: this is a named pipe"):
        load(write(tmp_path))


@pytest.mark.skipif(not Path("/dev/zero").exists(), reason="there is no such device")
def test_a_device_is_told():
    for read, told in ((load, "this is a device"), (draft, "no folder of this name")):
        with pytest.raises(CampaignError, match=told):
            read(Path("/dev/zero"))
    with pytest.raises(ReadError, match="zero: this is a device; a raw file was expected"):
        colonnade.read_motion("/dev/zero", unit="g", dt=0.01)


@pytest.mark.whole
@pipes
def test_a_raw_file_and_a_reference_motion_that_are_pipes_fail_their_test_alone(tmp_path):
    os.mkfifo(tmp_path / "a.csv")
    os.mkfifo(tmp_path / "m.csv")
    (tmp_path / "b.csv").write_text(RECORD)
    second = TEST.replace('"a"', '"b"').replace("a.csv", "b.csv")
    campaign = write(tmp_path, rest=f'[motions]\nm = {{file = "m.csv", interval = "0.02 s"}}\n\n{TEST}\n{second}')
    ended = run(campaign, until="condition", workers=1)
    reasons = {stage.subject: stage.reason for stage in ended.stages if stage.action == "failed"}
    assert set(reasons) == {"a"}
    assert "this is a named pipe; a raw file was expected" in reasons["a"]


@pipes
def test_a_pipe_in_the_folder_of_a_draft_is_told(tmp_path):
    os.mkfifo(tmp_path / "a.csv")
    (tmp_path / "b.csv").write_text(RECORD)
    assert ("a.csv", "this is a named pipe; a raw file was expected.") in draft(tmp_path).refused
    with pytest.raises(CampaignError, match="no folder of this name"):
        draft(tmp_path / "a.csv")


@pytest.mark.parametrize("text", [f"86{BLANKS}mm{BLANKS}x", f"{BLANKS}x", f"86 {'m' * 200_000}", f"86 {'m ' * 99_999}"])
def test_long_text_in_a_quantity_is_refused_at_once_and_shortened(text):
    with pytest.raises(UnitError) as refused:
        units.to_si(text, "length")
    assert len(str(refused.value)) < 300


def test_blanks_around_a_quantity_do_not_matter():
    assert units.to_si(f"{BLANKS}86{BLANKS}mm{BLANKS}", "length") == 0.086


@pytest.mark.parametrize(
    "rest",
    [
        f'{TEST}frequency = "3 {"H" * 99_999}"',
        f"{TEST}{'k' * 99_999} = 3",
        f"{TEST}span = 0x{'f' * 9_999}",
        f'{TEST}zero = "{"z" * 99_999}"',
        TEST.replace('"a"', f'"{"i" * 99_999}"'),
        TEST.replace('"frame"', f'"{"s" * 99_999}"'),
    ],
    ids=["a unit", "a key", "a number", "a word", "an id", "a name"],
)
def test_a_message_does_not_repeat_what_fills_the_screen(tmp_path, rest):
    with pytest.raises(CampaignError) as refused:
        load(write(tmp_path, rest=rest))
    assert all(len(line) < 600 for line in str(refused.value).splitlines())


def test_blanks_in_lines_that_are_no_headers_cost_nothing():
    assert key_lines(f'a = """\n[{BLANKS}x\n"""\n[b{BLANKS}]\nc = 1')[("b", "c")] == 5
    assert take_apart(f"a{BLANKS}b") == (f"a{BLANKS}b", None)
