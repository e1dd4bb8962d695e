"""The generated reference names all that there is, once, with what it says."""

import re
from pathlib import Path

import click
import pytest

import contract
import reference
from colonnade.campaign import test
from colonnade.campaign.settings import NextSettings, Processing, settings
from colonnade.campaign.specimen import Measured, Prism
from colonnade.cli.app import app
from colonnade.store.results import STAGES
from page_blocks import PROJECT


@pytest.fixture(scope="module")
def pages():
    return reference.all_pages()


def test_every_link_of_a_page_leads_to_a_page_or_a_place(pages):
    places = {place for text in pages.values() for place in re.findall(r"^\(([\w-]+)\)=$", text, re.MULTILINE)}
    for name, text in pages.items():
        for target in re.findall(r"\]\(([^)#\s]+)\)", text):
            assert (Path(name).parent / target).as_posix() in pages, (name, target)
        assert set(re.findall(r"\]\(#([^)]+)\)", text)) <= places, name


def test_every_setting_has_its_place_default_and_unit(pages):
    for place, setting in (settings(Processing(), "processing") | settings(NextSettings(), "next")).items():
        table_of, _, key = place.rpartition(".")
        page = pages[f"campaign/{contract.page_of(table_of)}.md"]
        section = page.partition(f"({contract.place('campaign', place)})=\n## `{key}`")[2].partition("\n(")[0]
        assert setting["description"] in section, place
        assert setting["unit"] in section, place
        assert "| default |" in section, place


@pytest.mark.parametrize(
    ("page", "path", "model"),
    [("tests", "tests", test.Test), ("specimens", "specimens.<id>", Prism), ("specimens", "specimens.<id>", Measured)],
)
def test_every_key_of_a_model_has_its_place(pages, page, path, model):
    for key, purpose in model.purposes().items():
        assert f"({contract.place('campaign', f'{path}.{key}')})=" in pages[f"campaign/{page}.md"], key
        assert " ".join(purpose.split()) in pages[f"campaign/{page}.md"]


def test_every_stage_has_its_file(pages):
    assert [name for name in STAGES if f"(file-{name})=" not in pages["files.md"]] == []
    assert "| `rocking_angle` | `rad` |" in reference.pages_of_results()["files.md"]


def test_every_kind_of_finding_has_advice():
    page = (PROJECT / "docs" / "reference" / "findings.md").read_text(encoding="utf-8").partition("## Errors")[0]
    advised = re.findall(r"^\| ((?!finding)[a-z -]*[a-z]) \| ", page, re.MULTILINE)
    assert len(advised) == len(set(advised)) > 50
    paths = [path for path in (PROJECT / "pipeline").rglob("*.py") if path.name != "findings.py"]
    sources = "\n".join(path.read_text(encoding="utf-8") for path in paths)
    made = set(re.findall(r'\b(?:serious|warning|note)\(\s*"([a-z -]+)",', sources))
    assert sorted(made - set(advised)) == []
    assert [kind for kind in advised if f'"{kind}"' not in sources] == []


def test_every_option_of_every_command_says_what_it_does():
    commands = dict(walk(app, "colonnade"))
    assert len(commands) > 15
    params = [(name, each) for name, of in commands.items() for each in of.get_params(click.Context(of))]
    options = [(name, each) for name, each in params if "--" in each.opts[0]]
    assert [(name, each.opts) for name, each in options if not each.help] == []


def walk(command, name):
    """Give each command with the words that call it."""
    yield name, command
    for word, below in getattr(command, "commands", {}).items():
        yield from walk(below, f"{name} {word}")


def test_every_public_name_has_its_group(monkeypatch):
    monkeypatch.setitem(reference.GROUPS, "Pictures", ("plot",))
    with pytest.raises(ValueError, match="animate"):
        reference.pages_of_library()
