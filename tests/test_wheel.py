"""The built wheel in a fresh environment, with nothing but what it declares: the command runs and finds its data."""

import os
import shutil
import subprocess
import sys
import venv
from importlib.metadata import PathDistribution, distribution
from pathlib import Path

import pytest
from packaging.requirements import Requirement

pytestmark = pytest.mark.whole

PROJECT = Path(__file__).parents[1]
EXAMPLE = PROJECT / "raw_schema" / "examples" / "delimited"


def run(*command, folder):
    clean = {name: value for name, value in os.environ.items() if name not in {"PYTHONPATH", "VIRTUAL_ENV"}}
    return subprocess.run([str(part) for part in command], cwd=folder, env=clean, capture_output=True, text=True)


def required(package):
    """What a distribution declares that it needs, at any depth: as installed here, in versions that it accepts."""
    found = {}
    wanted, asked = [(package, "")], set()
    while wanted:
        one, extra = wanted.pop()
        for text in one.requires or ():
            need = Requirement(text)
            if need.marker is None or need.marker.evaluate({"extra": extra}):
                own = found.setdefault(need.name, distribution(need.name))
                assert need.specifier.contains(own.version, prereleases=True), f"{text} is needed, not {own.version}"
                more = {(need.name, each) for each in ("", *need.extras)} - asked
                asked |= more
                wanted += [(own, each) for _, each in more]
    return found


def provide(package, site):
    """Put a distribution into another environment by links; a copy where links are not permitted."""
    for name in {file.parts[0] for file in package.files or () if file.parts[0] not in ("..", "__pycache__")}:
        source, target = Path(str(package.locate_file(name))), site / name
        if target.exists():
            continue
        try:
            target.symlink_to(source, target_is_directory=source.is_dir())
        except OSError:
            (shutil.copytree if source.is_dir() else shutil.copy2)(source, target)


@pytest.fixture(scope="module")
def commands(tmp_path_factory):
    """
    Folder of the commands of an environment that holds the wheel, made from the sdist, and what it declares.

    pip resolved the same list when the project was installed here: it is not asked to download all of it again.
    """
    folder = tmp_path_factory.mktemp("wheel")
    built = run(sys.executable, "-m", "build", "--outdir", folder, PROJECT, folder=folder)
    assert built.returncode == 0, built.stdout + built.stderr
    (wheel,) = folder.glob("colonnade-*.whl")
    venv.create(folder / "fresh")
    commands = folder / "fresh" / ("Scripts" if os.name == "nt" else "bin")
    # What is not imported here needs no compiling.
    into = (sys.executable, "-m", "pip", "--python", commands / "python", "install", "--quiet", "--no-compile")
    installed = run(*into, "--no-deps", wheel, folder=folder)
    assert installed.returncode == 0, installed.stderr
    where = "import sysconfig; print(sysconfig.get_path('purelib'))"
    site = Path(run(commands / "python", "-c", where, folder=folder).stdout.strip())
    own = PathDistribution(next(site.glob("colonnade-*.dist-info")))
    for package in required(own).values():
        provide(package, site)
    return commands


def test_the_command_runs(commands, tmp_path):
    told = run(commands / "colonnade", "--version", folder=tmp_path)
    assert (told.returncode, told.stderr) == (0, "")
    assert told.stdout.startswith("colonnade, version ")


def test_a_raw_file_becomes_a_page(commands, tmp_path):
    shutil.copytree(EXAMPLE, tmp_path / "example", ignore=shutil.ignore_patterns("processed", "report"))
    done = run(commands / "colonnade", "run", "example", folder=tmp_path)
    assert done.returncode == 0, done.stdout + done.stderr
    pages = list((tmp_path / "example" / "report" / "tests").glob("*.html"))
    assert pages
    assert all("<svg" in page.read_text(encoding="utf-8") for page in pages)


def test_the_demo_says_what_it_needs_where_its_extra_is_missing(commands, tmp_path):
    refused = run(commands / "colonnade", "demo", "demo", folder=tmp_path)
    assert refused.returncode == 2
    assert "Traceback" not in refused.stderr
    assert "colonnade[demo]" in refused.stderr
    assert "--motion" in refused.stderr
