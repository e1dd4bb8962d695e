"""A command that is told of each test: the line as JSON on its stdin."""

from __future__ import annotations

import json
import shlex
import subprocess
from collections.abc import Mapping, Sequence
from typing import Any

from colonnade.errors import CampaignError

PATIENCE = 10.0
"""Seconds after which the command is ended."""


def command_of(text: str) -> list[str]:
    """
    Split a command into program and arguments; no shell reads it.

    Raises
    ------
    CampaignError
        If it is empty or a quote is not closed.

    Examples
    --------
    >>> command_of("notify-send 'A test'")
    ['notify-send', 'A test']
    """
    try:
        parts = shlex.split(text)
    except ValueError as error:
        raise CampaignError(f"--notify {text!r}: this is not a command ({error}).") from None
    if not parts:
        raise CampaignError("--notify: it is empty. A program and its arguments were expected.")
    return parts


def notify(command: Sequence[str], line: Mapping[str, Any]) -> str:
    """Give a line to a command, and wait for it; return what went wrong, empty if nothing did."""
    try:
        done = subprocess.run(
            command,
            input=json.dumps(line, ensure_ascii=False),
            encoding="utf-8",
            errors="replace",
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            timeout=PATIENCE,
            check=False,
        )
    except subprocess.TimeoutExpired:
        return f"{command[0]} was ended: it took longer than {PATIENCE:g} s."
    except OSError as error:
        return f"{command[0]} could not be started ({error.strerror or error})."
    if done.returncode:
        said = (done.stderr or "").strip().splitlines()
        return f"{command[0]} ended with {done.returncode}{f': {said[-1][:200]}' if said else ''}."
    return ""
