"""
Make a release: `make release VERSION=1.2.3`.

Cuts the changelog, sets the version, builds wheel and sdist, checks their contents, installs the wheel on each Python
that is found, then commits and tags. Nothing is uploaded. If a step fails, or is interrupted, the tree is as before.
"""

from __future__ import annotations

import argparse
import datetime
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[1]
VERSION_FILE = "pipeline/colonnade/__init__.py"
UNRELEASED = "## Unreleased"
WHICH = "import sys; print('%d.%d' % sys.version_info[:2], sys.executable)"
USE = "import colonnade as c; c.rock(c.Block.prism(width=1, depth=1, height=4, mass=1e4), theta0=0.1, duration=1)"


class ReleaseError(Exception):
    """Why there is no release; its text is for whoever asked for one."""


def checked_version(text: str) -> str:
    """
    Return a version of three numbers.

    Raises
    ------
    ReleaseError
        If it is none.
    """
    if not re.fullmatch(r"(0|[1-9]\d*)(\.(0|[1-9]\d*)){2}", text):
        raise ReleaseError(f'The version is "{text}"; three numbers were expected, such as VERSION=1.2.3.')
    return text


def cut(changelog: str, version: str, day: str) -> str:
    """
    Give what is unreleased its version and day.

    Raises
    ------
    ReleaseError
        If nothing is unreleased, or the version is there already.
    """
    if re.search(rf"^## {re.escape(version)}\b", changelog, re.MULTILINE):
        raise ReleaseError(f"CHANGELOG.md has a section {version} already.")
    parts = re.split(rf"^{UNRELEASED}$", changelog, flags=re.MULTILINE)
    if len(parts) != 2:
        raise ReleaseError(f'CHANGELOG.md has {len(parts) - 1} headings "{UNRELEASED}"; one was expected.')
    if not re.split(r"^## ", parts[1], flags=re.MULTILINE)[0].strip():
        raise ReleaseError(f'Nothing is listed under "{UNRELEASED}" in CHANGELOG.md.')
    return f"{parts[0]}## {version} · {day}{parts[1]}"


def versioned(source: str, version: str) -> str:
    """Set the version of the package."""
    return _replaced(source, r'^__version__ = ".*"$', f'__version__ = "{version}"', VERSION_FILE)


def cited(citation: str, version: str, day: str) -> str:
    """Set version and day in CITATION.cff."""
    bare = re.sub(r"^date-released: .*\n", "", citation, flags=re.MULTILINE)
    return _replaced(bare, r"^version: .*$", f"version: {version}\ndate-released: {day}", "CITATION.cff")


def _replaced(text: str, pattern: str, by: str, name: str) -> str:
    changed, count = re.subn(pattern, by, text, flags=re.MULTILINE)
    if count != 1:
        raise ReleaseError(f"{name} gives its version {count} times; once was expected.")
    return changed


def release(version: str, candidates: Sequence[str], fits: str) -> None:
    """
    Make a release of the tree that this file is in.

    Parameters
    ----------
    version : str
    candidates : sequence of str
        Commands that may start a Python.
    fits : str
        Python code that ends with an error where an interpreter is of no use.
    """
    tag = f"v{checked_version(version)}"
    if _said("git", "status", "--porcelain"):
        raise ReleaseError("The tree has changes that are not committed. Commit them first.")
    if _said("git", "tag", "--list", tag):
        raise ReleaseError(f"The tag {tag} is there already.")
    start, day = _said("git", "rev-parse", "HEAD"), datetime.date.today().isoformat()
    try:
        for name, change in (
            ("CHANGELOG.md", lambda text: cut(text, version, day)),
            (VERSION_FILE, lambda text: versioned(text, version)),
            ("CITATION.cff", lambda text: cited(text, version, day)),
        ):
            path = PROJECT / name
            path.write_text(change(path.read_text(encoding="utf-8")), encoding="utf-8")
        with tempfile.TemporaryDirectory() as scratch:
            built = build(Path(scratch) / "dist")
            for name, python in interpreters(candidates, fits).items():
                install(built, python, Path(scratch) / name, version)
            _run("git", "commit", "--quiet", "--all", "--message", f"Release {version}")
            (PROJECT / "dist").mkdir(exist_ok=True)
            kept = [shutil.copy(path, PROJECT / "dist") for path in sorted(built.iterdir())]
        _run("git", "tag", "--annotate", tag, "--message", f"colonnade {version}")
    except BaseException:
        _run("git", "reset", "--quiet", "--hard", start)
        raise
    print(f"Released {version} here: tag {tag}, {' and '.join(str(Path(path).name) for path in kept)} in dist/.")
    print("Nothing was uploaded. Push the branch and the tag, then upload dist/ where others find it.")


def build(folder: Path) -> Path:
    """Build wheel and sdist, and check what is in them."""
    _run(sys.executable, "-m", "build", "--no-isolation", "--outdir", folder, PROJECT)
    _run(sys.executable, "-m", "check_wheel_contents", *folder.glob("*.whl"))
    _run(sys.executable, "-m", "twine", "check", "--strict", *folder.iterdir())
    return folder


def interpreters(candidates: Sequence[str], fits: str) -> dict[str, str]:
    """
    Find the Pythons of this machine, one of each version.

    Raises
    ------
    ReleaseError
        If there is none.
    """
    found: dict[str, str] = {}
    for each in candidates:
        path = shutil.which(each)
        if path is not None and subprocess.run([path, "-c", fits], capture_output=True).returncode == 0:
            name, executable = _said(path, "-c", WHICH).split(" ", 1)
            found.setdefault(name, executable)
    if not found:
        raise ReleaseError(f"None of {', '.join(candidates)} starts a Python that fits.")
    print(f"Pythons: {', '.join(found)}")
    return found


def install(built: Path, python: str, folder: Path, version: str) -> None:
    """
    Install the wheel in a fresh environment and use it.

    Raises
    ------
    ReleaseError
        If it gives another version.
    """
    _run(python, "-m", "venv", folder)
    own = folder / ("Scripts" if sys.platform == "win32" else "bin")
    _run(own / "python", "-m", "pip", "install", "--quiet", "--disable-pip-version-check", *built.glob("*.whl"))
    said = _said(own / "colonnade", "--version", at=folder)
    if said.split()[-1] != version:
        raise ReleaseError(f'`colonnade --version` says "{said}"; {version} was expected.')
    _run(own / "python", "-c", USE, at=folder)
    _said(own / "colonnade", "schema", "campaign", at=folder)


def _run(*command: str | Path, at: Path | None = None) -> None:
    print("+", shlex.join(map(str, command)), flush=True)
    if subprocess.run(command, cwd=at or PROJECT, env=_environment()).returncode != 0:
        raise ReleaseError(f"{shlex.join(map(str, command))} failed.")


def _said(*command: str | Path, at: Path | None = None) -> str:
    done = subprocess.run(command, cwd=at or PROJECT, env=_environment(), capture_output=True, encoding="utf-8")
    if done.returncode != 0:
        raise ReleaseError(f"{shlex.join(map(str, command))} failed: {done.stderr.strip()}")
    return done.stdout.strip()


def _environment() -> dict[str, str]:
    """Return the environment without what would let an installed package see this tree."""
    return {name: value for name, value in os.environ.items() if name not in {"PYTHONPATH", "VIRTUAL_ENV"}}


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description="Make a release; nothing is uploaded.")
    parser.add_argument("version")
    parser.add_argument("pythons", nargs="+")
    parser.add_argument("--fits", required=True)
    asked = parser.parse_args()
    try:
        release(asked.version, asked.pythons, asked.fits)
    except ReleaseError as error:
        sys.exit(f"No release: {error}")
