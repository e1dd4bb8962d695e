"""README.md is run as it stands: its commands in order in an empty folder, its campaign file, its Python."""

import contextlib
import io
import re
from pathlib import Path

import pytest
from PIL import Image

import rebuild
from colonnade.laboratory.programme import KEPT_AWAY
from page_blocks import Block, Reader

PROJECT = Path(__file__).parents[1]
README = (PROJECT / "README.md").read_text(encoding="utf-8")
PAGES = {name: (PROJECT / name).read_text(encoding="utf-8") for name in ("README.md", "CONTRIBUTING.md", "SECURITY.md")}


def blocks(language):
    return re.findall(rf"^```{language}\n(.*?)^```$", README, re.MULTILINE | re.DOTALL)


def commands():
    """Lines of all shell blocks, then the commands named in the text, but those with a word in capitals to fill in."""
    in_blocks = [line for block in blocks("sh") for line in block.splitlines()]
    in_text = re.findall(r"`(colonnade [^`]+)`", re.sub(r"```.*?```", "", README, flags=re.DOTALL))
    return in_blocks + [command for command in in_text if not re.search(r"\b[A-Z]{2,}\b", command)]


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Where the reader stands."""
    return tmp_path_factory.mktemp("reader")


@pytest.fixture(scope="module")
def outputs(folder, instead):
    """What each command that starts `colonnade` printed; the first that fails ends the run."""
    printed, reader = {}, Reader(folder, instead)
    (campaign,) = blocks("toml")
    for command in commands():
        command = command.removeprefix(".venv/bin/")
        if command.startswith(("colonnade ", "mkdir ", "cp ")):
            reader.do(Block(f"README.md, `{command}`", "sh", f"{command}\n"))
            printed[command] = reader.output
        if command.startswith(("mkdir ", "cp ")):
            (folder / "first" / "campaign.toml").write_text(campaign, encoding="utf-8")
    return printed


@pytest.mark.whole
def test_every_command_runs_and_the_demo_is_near_its_truth(outputs):
    assert {"colonnade demo demo --short", "colonnade check first", "colonnade run first"} <= outputs.keys()
    assert "inside the interval" in outputs["colonnade demo demo --short"]
    assert "wrong" not in outputs["colonnade demo demo --short"]
    assert "10 of 10 measured outcomes are right" in outputs["colonnade demo demo --short"]
    assert outputs["colonnade demo demo --short"].count("Its misfit (nrmse) is") == 2
    assert KEPT_AWAY in outputs["colonnade demo demo --short"]


@pytest.mark.whole
def test_its_demo_has_the_numbers_of_the_reference_report(outputs, folder, tmp_path, as_reported):
    rebuild.tell(folder / "demo" / "campaign.toml", tmp_path, "short")
    as_reported(tmp_path, "short")


@pytest.mark.whole
def test_the_first_campaign_gives_its_column_a_restitution(outputs):
    shown = outputs["colonnade show specimens first"]
    assert re.search(r"column +prism .* 0\.97\d* ± (< )?0\.00\d+ +identified", shown)


def test_the_python_runs_and_finds_the_restitution_it_computed_with():
    (source,) = blocks("python")
    printed, names = io.StringIO(), {}
    with contextlib.redirect_stdout(printed):
        exec(source, names)
    assert names["history"].outcome == "rocking"
    assert names["result"].value == pytest.approx(0.976, abs=1e-4)


@pytest.mark.parametrize("page", PAGES)
def test_every_link_leads_somewhere(page):
    links = re.findall(r"\]\((?!https?:)([^)#]+)[)#]", PAGES[page])
    assert links
    assert [link for link in links if not (PROJECT / link).exists()] == []


def test_its_picture_moves_and_is_small():
    [file] = re.findall(r"!\[.+\]\((.+)\)", README)
    assert (PROJECT / file).stat().st_size <= 1_000_000
    with Image.open(PROJECT / file) as picture:
        assert picture.n_frames > 100


def test_the_files_that_an_extension_changes_are_there():
    table = PAGES["CONTRIBUTING.md"].split("\n## Extend it\n")[1].split("\n## ")[0]
    cells = [row.split("|")[2] for row in table.splitlines() if row.startswith("|")]
    paths = [path for cell in cells for path in re.findall(r"`([^`]+)`", cell) if not re.search(r"\b[A-Z]{2,}\b", path)]
    package = PROJECT / "pipeline" / "colonnade"
    assert len(paths) > 10
    assert [path for path in paths if not ((package / path).is_file() or (PROJECT / path).is_file())] == []
