"""Arguments of `run`, as they come from a notebook."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from colonnade.validation import described, text, whole

MOST_WORKERS = 10_000
"""Processes; no machine has as many cores."""


def check_run(
    campaign: Any,
    *,
    stages: dict[str, Any],
    only: Any,
    workers: Any,
    scheduler: Any,
    verify: Any,
    awaiting: Any,
    results: Any,
    progress: Any,
) -> None:
    """
    Check the type of each argument; `stages` holds those that name a stage.

    Raises
    ------
    ValueError
        If one has the wrong type; the message names it.
    """
    for name, value, may_be_none in (("campaign", campaign, False), ("results", results, True)):
        if not (isinstance(value, (str, Path)) or (may_be_none and value is None)):
            raise ValueError(f"{name} is {described(value)}; a path was expected")
    for name, value in {**stages, "scheduler": scheduler}.items():
        if value is not None:
            text(name, value, "an address" if name == "scheduler" else "the name of a stage")
    if not isinstance(only, str) and not (
        isinstance(only, (list, tuple, set, frozenset)) and all(isinstance(each, str) for each in only)
    ):
        raise ValueError(f"only is {described(only)}; the id of a test, or a list of ids, was expected")
    if workers is not None:
        whole("workers", workers, 1, MOST_WORKERS)
    for name, value in {"verify": verify, "awaiting": awaiting}.items():
        if not isinstance(value, bool):
            raise ValueError(f"{name} is {described(value)}; True or False was expected")
    if progress is not None and not callable(progress):
        raise ValueError(f"progress is {described(progress)}; a function was expected")
