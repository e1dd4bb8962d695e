"""Lines of a drafted campaign file: known, guessed with a reason, or asked."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from colonnade.campaign.syntax.fields import one_line


@dataclass(frozen=True)
class Line:
    """
    One key.

    Attributes
    ----------
    key, value : str
        As TOML; a person has to replace a "?" in the value.
    reason : str
        Reason for the guess; empty if it is obvious.
    question : str
        What a person should check; empty if there is no doubt.
    """

    key: str
    value: str
    reason: str = ""
    question: str = ""

    def text(self) -> str:
        """Write the line, followed by its reason or question."""
        said = f"? {self.question}" if self.question else self.reason
        if self.question and self.reason:
            said = f"? {self.question} ({self.reason})"
        return f"{self.key} = {self.value}" + (f"    # {one_line(said)}" if said else "")


def value(content: object) -> str:
    """
    Write a value as TOML.

    Examples
    --------
    >>> value("mm"), value([1, 0, 0]), value({"main": "a.csv"})
    ('"mm"', '[1, 0, 0]', '{main = "a.csv"}')
    """
    if isinstance(content, str):
        # JSON's strings are TOML's basic strings, but for one sign that TOML wants escaped too.
        return json.dumps(content, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(content, Mapping):
        return "{" + ", ".join(f"{key(str(name))} = {value(each)}" for name, each in content.items()) + "}"
    if isinstance(content, Sequence):
        return "[" + ", ".join(value(each) for each in content) + "]"
    return json.dumps(content)


def key(name: str) -> str:
    """
    Write a key as TOML.

    Examples
    --------
    >>> key("daq2"), key("span-2.0")
    ('daq2', '"span-2.0"')
    """
    bare = name.replace("_", "").replace("-", "")
    return name if bare.isascii() and bare.isalnum() else value(name)


def comment(text: str) -> str:
    """Write a line of comment."""
    return f"# {one_line(text)}"
