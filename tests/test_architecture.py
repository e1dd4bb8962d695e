"""docs/architecture.md says what is so: floors, rooms and places."""

import re
import tomllib
from pathlib import Path

from every import every

ROOT = Path(__file__).parents[1]
PACKAGE = ROOT / "pipeline" / "colonnade"
PAGE = (ROOT / "docs" / "architecture.md").read_text(encoding="utf-8")


def table(heading):
    """First cells of a section's table, each as the list of names in it."""
    section = PAGE.split(f"\n## {heading}\n")[1].split("\n## ")[0]
    rows = [line.split("|") for line in section.splitlines() if line.startswith("|")][2:]
    return [(re.findall(r"`([^`]+)`", row[1]), re.findall(r"`([^`]+)`", row[2])) for row in rows]


def test_the_floors_are_those_that_imports_are_held_to():
    contracts = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["tool"]["importlinter"]
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
