"""What colonnade prints about a campaign with one fault."""

from __future__ import annotations

import contextlib
import io
import re
import textwrap
from pathlib import Path

from colonnade.cli import invoke

COMMANDS = {"check": ("check",), "run": ("run", "--until", "restitution", "--workers", "1")}
"""`check` stops before the identification of e, which some faults show up in."""


def keep_only(test: str, folder: Path) -> None:
    """Take the other tests out of a campaign."""
    path = folder / "campaign.toml"
    head, *entries = re.split(r"(?=^\[\[tests\]\]\n)", path.read_text(encoding="utf-8"), flags=re.MULTILINE)
    [kept] = [entry for entry in entries if f'id = "{test}"\n' in entry]
    path.write_text(head + kept, encoding="utf-8")


def findings(command: str, folder: Path) -> str:
    """
    Run a command on the campaign in a folder, and give the problems and findings that it prints, a line each.

    Lines on what was done, such as paths and counts, are left out.
    """
    out, err = io.StringIO(), io.StringIO()
    with contextlib.chdir(folder), contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        invoke(list(COMMANDS[command]))
    said = out.getvalue() + err.getvalue()
    kept = re.findall(
        r"^ *(?:serious|warning|note|follows from the above|problem|would fail)\b.*(?:\n {4}.*)*", said, re.MULTILINE
    )
    return textwrap.dedent("\n".join(kept))
