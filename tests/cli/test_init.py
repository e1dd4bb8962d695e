"""`colonnade init` as a newcomer meets it: draft, fill in, check, run."""

import json

import pytest

ANSWERS = {"width": "86 mm", "depth": "86 mm", "height": "456 mm", "mass": "26.10 kg", "relative_to": "table"}
ANSWERS |= {"at": ["43 mm", "0 mm", "440 mm"]}


@pytest.fixture
def raw(campaign):
    """The folder of a campaign whose file is still to be written."""
    (campaign / "campaign.toml").unlink()
    return campaign


def fill_in(path):
    """Answer what is asked, as a person does with an editor."""
    keyed = [(line.partition(" = ")[0], line) for line in path.read_text(encoding="utf-8").splitlines()]
    lines = [f"{key} = {json.dumps(ANSWERS[key])}" if key in ANSWERS else line for key, line in keyed]
    path.write_text("\n".join(lines), encoding="utf-8")


def test_a_newcomer_gets_from_raw_files_to_a_restitution(colonnade, raw):
    told = colonnade("init")
    assert (told.returncode, told.stderr) == (0, "")
    assert "2 tests, 2 set-ups" in told.stdout or "2 tests, 1 set-up" in told.stdout
    assert "To fill in: 6 values" in told.stdout
    assert colonnade("check").returncode == 2
    fill_in(raw / "campaign.toml")
    checked = colonnade("check")
    assert (checked.returncode, checked.stderr) == (0, "")
    assert colonnade("run", "--until", "restitution", "--workers", "1").returncode == 0
    summary = json.loads((raw / "processed" / "summary.json").read_text(encoding="utf-8"))
    restitution = summary["specimens"]["specimen"]["restitution"]
    assert restitution["low"] <= 0.95 <= restitution["high"]


def test_the_folder_of_the_raw_files_itself_will_do(colonnade, raw):
    assert colonnade("init", "raw").returncode == 0
    assert 'file = "free-01.csv"' in (raw / "raw" / "campaign.toml").read_text(encoding="utf-8")


def test_the_draft_is_drawn_next_to_it_and_what_is_asked_is_listed_with_its_line(colonnade, raw):
    told = colonnade("init")
    assert f"drawing: {raw / 'drawing.svg'}\n" in told.stdout
    assert ">1 top<" in (raw / "drawing.svg").read_text(encoding="utf-8")
    (raw / "campaign.toml").unlink()
    found = json.loads(colonnade("init", "--json").stdout)
    assert (found["drawing"], found["tests"]) == (str(raw / "drawing.svg"), 2)
    lines = (raw / "campaign.toml").read_text(encoding="utf-8").splitlines()
    assert all('"?' in lines[number - 1] for number in found["open"])


def test_a_drawing_of_yours_stays_and_then_no_draft_is_written(colonnade, raw):
    (raw / "drawing.svg").write_text("<svg/>", encoding="utf-8")
    told = colonnade("init")
    assert (told.returncode, "was not changed" in told.stderr) == (2, True)
    assert (raw / "drawing.svg").read_text(encoding="utf-8") == "<svg/>"
    assert not (raw / "campaign.toml").exists()
