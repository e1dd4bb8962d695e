"""The TOML files of a campaign, read with plain messages about what is wrong, and values written as TOML."""

from __future__ import annotations

import json
import re
import tomllib
from collections.abc import Iterable, Mapping
from datetime import date
from pathlib import Path
from typing import Any, TypeVar

from pydantic import BaseModel, ValidationError

from colonnade.campaign.syntax.fields import one_line
from colonnade.campaign.syntax.places import Place
from colonnade.errors import CampaignError
from colonnade.readers.files import irregular

Model = TypeVar("Model", bound=BaseModel)

_LARGEST_BYTES = 20_000_000


def read_text(path: Path) -> str:
    """
    Read a text file that a person wrote.

    Raises
    ------
    CampaignError
        If it cannot be read or is not UTF-8.
    """
    if kind := irregular(path):
        raise CampaignError(f"{path.name}: this is {kind}; a text file was expected.")
    try:
        if path.stat().st_size > _LARGEST_BYTES:
            raise CampaignError(f"{path.name} is too large for a campaign's own file. Is it a raw file?")
        return path.read_bytes().decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise CampaignError(
            f"{path.name}: byte {error.start + 1} is not UTF-8 text. "
            "Save the file as UTF-8; editors offer it as the encoding."
        ) from None
    except OSError as error:
        raise CampaignError(f"{path.name}: it cannot be read ({error.strerror}).") from None


def parse(text: str, name: str) -> dict[str, Any]:
    """
    Parse TOML.

    Raises
    ------
    CampaignError
        If it is not TOML; the message gives line and column.
    """
    try:
        return tomllib.loads(text.replace("\r\n", "\n"))
    except (ValueError, RecursionError) as error:  # a number of thousands of digits is a plain ValueError
        said = "tables or lists are nested too deeply" if isinstance(error, RecursionError) else str(error)
        raise CampaignError(
            f"{name}: this is not valid TOML: {said}. Put text in quotes and lists in [ ]; give each key once."
        ) from None


def validated(
    model: type[Model], document: Mapping[str, Any], folder: Path
) -> tuple[Model | None, list[tuple[Place, str]]]:
    """Read a document as a model, None if it is not one; with the problems and their places."""
    try:
        return model.model_validate(document, context={"folder": folder}), []
    except ValidationError as error:
        return None, [(tuple(part for part in each["loc"] if part != "[key]"), each["msg"]) for each in error.errors()]


def refusal(paragraphs: Iterable[str]) -> CampaignError:
    """Build the error of a file with several problems, each paragraph once and on one line."""
    return CampaignError("\n".join(dict.fromkeys(map(one_line, paragraphs))))


def toml_value(value: object) -> str:
    """
    Write a value as TOML.

    Examples
    --------
    >>> toml_value("mm"), toml_value([1, 0, 0]), toml_value({"main": "a.csv"})
    ('"mm"', '[1, 0, 0]', '{main = "a.csv"}')
    """
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{toml_key(str(key))} = {toml_value(each)}" for key, each in value.items()) + "}"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(toml_value(each) for each in value) + "]"
    if isinstance(value, date):
        return value.isoformat()
    # JSON's strings are TOML's basic strings, but for one sign that TOML wants escaped too.
    return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")


def toml_key(name: str) -> str:
    """
    Write a key as TOML.

    Examples
    --------
    >>> toml_key("daq2"), toml_key("span-2.0")
    ('daq2', '"span-2.0"')
    """
    return name if re.fullmatch(r"[A-Za-z0-9_-]+", name) else toml_value(name)


def natural(name: str) -> tuple[tuple[int, str], ...]:
    """
    Sort names as people do, `free-2` before `free-10`.

    Examples
    --------
    >>> sorted(["free-10", "free-2"], key=natural)
    ['free-2', 'free-10']
    """
    parts = re.split(r"([0-9]+)", name.casefold())
    return tuple((int(part), "") if part.isdecimal() else (-1, part) for part in parts)
