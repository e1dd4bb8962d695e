"""The package as a whole: what it offers, what it loads when, and what it says about itself."""

import ast
import re
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

import colonnade
from every import every

PROJECT = Path(__file__).parents[1]
HEAVY = ("numba", "matplotlib", "xarray", "pandas", "scipy", "netCDF4", "joblib")


def loaded_by(statement):
    """Modules that a fresh interpreter holds after a statement."""
    code = f"import sys\n{statement}\nprint(*sys.modules)"
    return set(subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.split())


@pytest.mark.parametrize(
    ("module", "unneeded"),
    [
        *((module, HEAVY) for module in ("colonnade", "colonnade.cli.app", "colonnade.campaign", "colonnade.units")),
        ("colonnade.cli.app", ["colonnade.campaign"]),  # help needs no campaign
        # Half of the time of a run with nothing to do: what opens results.
        ("colonnade.workflow.run", ["xarray", "pandas", "netCDF4", "matplotlib", "joblib"]),
    ],
)
def test_import_loads_nothing_that_is_not_needed_yet(module, unneeded):
    assert loaded_by(f"import {module}").isdisjoint(unneeded)


def test_a_name_loads_what_it_needs_when_it_is_used():
    made = loaded_by("import colonnade; colonnade.Block.prism(width=1, depth=1, height=4, mass=1)")
    assert made.isdisjoint(HEAVY)
    assert "numba" in loaded_by(
        "import colonnade; block = colonnade.Block.prism(width=1, depth=1, height=4, mass=1);"
        "colonnade.rock(block, theta0=0.1, duration=0.1)"
    )


@every("name", colonnade.__all__)
def test_every_name_that_is_offered_is_there(name):
    assert getattr(colonnade, name) is not None
    assert name in dir(colonnade)


def test_a_name_that_is_not_offered_is_an_attribute_error():
    with pytest.raises(AttributeError, match=r"module 'colonnade' has no attribute 'Column'"):
        colonnade.Column  # noqa: B018


def test_editors_see_the_same_names_as_a_running_program():
    source = ast.parse(Path(colonnade.__file__).read_text(encoding="utf-8"))
    checked = next(node for node in source.body if isinstance(node, ast.If))
    for_editors = {name.name: node.module for node in checked.body for name in node.names}
    assert for_editors == colonnade._ROOMS
    assert {*for_editors, "__version__"} == set(colonnade.__all__)


def test_the_version_is_the_same_wherever_it_is_written():
    citation = (PROJECT / "CITATION.cff").read_text(encoding="utf-8")
    changelog = (PROJECT / "CHANGELOG.md").read_text(encoding="utf-8")
    assert re.search(r"^version: (\S+)$", citation, re.MULTILINE)[1] == colonnade.__version__
    released = re.search(r"^## (\d\S*)", changelog, re.MULTILINE)
    assert released is None or released[1] == colonnade.__version__


def test_rooms_take_nothing_from_the_front_door_but_the_version():
    offered = "|".join(sorted(set(colonnade.__all__) - {"__version__"}))
    taken = re.compile(rf"^\s*from colonnade import .*\b({offered})\b|\bcolonnade\.({offered})\b", re.MULTILINE)
    modules = [path for path in Path(colonnade.__file__).parent.rglob("*.py") if path.name != "__init__.py"]
    examples = re.compile(r"^\s*(>>>|\.\.\.) .*$", re.MULTILINE)  # show what a user types
    assert [str(path) for path in modules if taken.search(examples.sub("", path.read_text(encoding="utf-8")))] == []


PACKAGE = PROJECT / "pipeline" / "colonnade"
PAGE = (PROJECT / "docs" / "architecture.md").read_text(encoding="utf-8")


def table(heading):
    """First cells of a section's table, each as the list of names in it."""
    section = PAGE.split(f"\n## {heading}\n")[1].split("\n## ")[0]
    rows = [line.split("|") for line in section.splitlines() if line.startswith("|")][2:]
    return [(re.findall(r"`([^`]+)`", row[1]), re.findall(r"`([^`]+)`", row[2])) for row in rows]


def test_the_floors_are_those_that_imports_are_held_to():
    contracts = tomllib.loads((PROJECT / "pyproject.toml").read_text(encoding="utf-8"))["tool"]["importlinter"]
    [layers] = [each["layers"] for each in contracts["contracts"] if each["type"] == "layers"]
    assert [set(names) for names, _ in table("The floors")] == [set(layer.split(" | ")) for layer in layers]


def test_every_folder_is_named():
    folders = {path.parent.relative_to(PACKAGE).as_posix() for path in PACKAGE.rglob("*.py")} - {"."}
    named = [name for heading in ("The floors", "Rooms") for names, _ in table(heading) for name in names]
    assert folders - set(named) == set()
    assert len(named) == len(set(named))
    assert all((PACKAGE / name).is_dir() or (PACKAGE / f"{name}.py").is_file() for name in named)


@every(("fact", "places"), table("The one place of each fact"))
def test_every_place_is_there(fact, places):
    assert [place for place in places if place.endswith(".py") and not (PACKAGE / place).is_file()] == []


def test_the_walk_through_the_code_names_modules_that_are_there_each_once():
    walk = PAGE.split("\nTo follow one run")[1].split("\n## ")[0]
    places = re.findall(r"`([^`]+)`", walk)
    assert len(places) == len(set(places)) > 10
    assert [place for place in places if not (PACKAGE / place).exists()] == []
