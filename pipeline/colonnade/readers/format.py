"""A raw format: how its files are recognised and read, and its options."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pydantic import BaseModel, ConfigDict

from colonnade.readers.recording import Recording


@dataclass(frozen=True)
class Recognition:
    """
    Whether a file looks like one of a format, with the reason, which is shown if no format recognises it.

    Attributes
    ----------
    yes : bool
    reason : str
    is_known : bool
        Whether the file is known, and is not read, for the `reason`; no other format is tried.
    """

    yes: bool
    reason: str
    is_known: bool = False


class Options(BaseModel):
    """The options of a format, all optional; none unless the format adds some."""

    model_config = ConfigDict(extra="forbid", frozen=True)


@dataclass(frozen=True)
class Format:
    """
    One raw format.

    Attributes
    ----------
    name : str
        As in `file = {format = "…"}`.
    summary : str
        One line for `show formats`.
    suffixes : tuple of str
        Usual file name endings, such as `.csv`; they are shown, but recognition does not use them.
    recognise : callable
        Path -> Recognition, from the head of the file.
    read : callable
        (Path, options) -> Recording, which is refused if no channel has values; raises ReadError.
    options : type of Options
        Options for files of this format, all optional.
    modules : tuple of str
        Heavy packages that `read` imports; the bounded process imports them once for all files.
    companions : callable or None
        Path -> the other files that hold a part of it, by the names in its folder; missing ones too.
    in_process : bool
        Whether `read` runs in this process, as for text parsed by this package; others run in the bounded process.
    """

    name: str
    summary: str
    suffixes: tuple[str, ...]
    recognise: Callable[[Path], Recognition]
    read: Callable[[Path, Any], Recording]
    options: type[Options] = Options
    modules: tuple[str, ...] = ()
    companions: Callable[[Path], tuple[Path, ...]] | None = None
    in_process: bool = False
