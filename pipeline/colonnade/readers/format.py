"""What a raw format is: what recognises its files, what reads them, and what can be said about them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pydantic import BaseModel, ConfigDict

from colonnade.readers.recording import Recording, Window


@dataclass(frozen=True)
class Recognition:
    """
    Whether a file looks like a format's, with the reason, which is shown if no format takes it.

    Attributes
    ----------
    yes : bool
    reason : str
    is_known : bool
        Whether the file is known to be of a format that is not read here, as `reason` says: no other format is asked.
    """

    yes: bool
    reason: str
    is_known: bool = False


class Options(BaseModel):
    """What can be said about a file of a format; nothing has to be, and nothing can unless a format adds to it."""

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
        Usual file name endings, such as `.csv`; they are shown, never relied on.
    recognise : callable
        Path -> Recognition, from the head of the file.
    read : callable
        (Path, options) -> Recording, which is refused if no channel has values; raises ReadError.
    options : type of Options
        What can be said about a file of this format; all of it optional.
    read_window : callable or None
        (Path, options, Window) -> Recording that holds at least the window, in memory for little more than that.
    modules : tuple of str
        What `read` imports only then; the bounded process imports it once for all files.
    companions : callable or None
        (Path, options) -> names of the other files that hold a part of it, all in its folder; raises ReadError.
    in_process : bool
        Whether `read` runs in this process: text, taken apart by code of our own. All else is read in the bounded one.
    """

    name: str
    summary: str
    suffixes: tuple[str, ...]
    recognise: Callable[[Path], Recognition]
    read: Callable[[Path, Any], Recording]
    options: type[Options] = Options
    read_window: Callable[[Path, Any, Window], Recording] | None = None
    modules: tuple[str, ...] = ()
    companions: Callable[[Path, Any], tuple[str, ...]] | None = None
    in_process: bool = False
