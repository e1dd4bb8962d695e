"""The package as a whole: what it offers, what it loads when, and what it says about itself."""

import ast
import re
import subprocess
import sys
from pathlib import Path

import pytest

import colonnade
from every import every

PROJECT = Path(__file__).parents[1]
HEAVY = ("numba", "matplotlib", "xarray", "pandas", "scipy", "netCDF4", "joblib")


def loaded_by(statement):
    """Heavy libraries that a fresh interpreter holds after a statement."""
    code = f"import sys\n{statement}\nprint(*sorted({set(HEAVY)!r} & sys.modules.keys()))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    return set(done.stdout.split())


@pytest.mark.parametrize("module", ["colonnade", "colonnade.cli.app", "colonnade.campaign", "colonnade.units"])
def test_import_loads_no_heavy_library(module):
    assert loaded_by(f"import {module}") == set()


def test_a_run_loads_what_opens_results_only_when_it_opens_one():
    """Half of the time of a run with nothing to do, if it were loaded."""
    assert not loaded_by("import colonnade.workflow.run") & {"xarray", "pandas", "netCDF4", "matplotlib", "joblib"}


def test_help_needs_no_campaign():
    code = "import sys, colonnade.cli.app; print('colonnade.campaign' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True).stdout == "False\n"


def test_a_name_loads_what_it_needs_when_it_is_used():
    assert "numpy" not in HEAVY
    assert loaded_by("import colonnade; colonnade.Block.prism(width=1, depth=1, height=4, mass=1)") == set()
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
