"""The decisions of a review about one test, as the stages read them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Literal

from pydantic import BaseModel, ConfigDict


class Flagged(BaseModel):
    """A stretch of a channel that people flagged; the whole channel if the window is None."""

    model_config = ConfigDict(frozen=True)

    channel: str
    window: tuple[float, float] | None
    flag: Literal["suspect", "fail"]
    reason: str


class Review(BaseModel):
    """
    The decisions about one test.

    Attributes
    ----------
    excluded : str
        Why the whole test is left out, with who and when; empty if it is not.
    window : (float, float) or None
        The part of the file that is used, s.
    flags : tuple of Flagged
    factors : dict of str to float
        Factor on the gain of each channel.
    sentences : tuple of str
        One sentence for each entry: when, who, what, why.
    """

    model_config = ConfigDict(frozen=True)

    excluded: str = ""
    window: tuple[float, float] | None = None
    flags: tuple[Flagged, ...] = ()
    factors: dict[str, float] = {}
    sentences: tuple[str, ...] = ()

    def within(self, window: tuple[float, float] | None) -> tuple[float, float] | None:
        """
        Return the part of a test's window that is used.

        Examples
        --------
        >>> Review(window=(2.0, 9.0)).within((0.0, 5.0))
        (2.0, 5.0)
        """
        if window is None or self.window is None:
            return window or self.window
        return max(window[0], self.window[0]), min(window[1], self.window[1])


def decided(entries: Sequence[tuple[str, Mapping[str, Any]]]) -> Review:
    """
    Gather the decisions about one test.

    Parameters
    ----------
    entries : sequence of (str, mapping)
        What is done, "exclude", "trim", "flag" or "correct", and the fields of the entry. Several trims of a test
        leave their common part; several corrections of a channel multiply.
    """
    excluded, window = "", None
    flags: list[Flagged] = []
    factors: dict[str, float] = {}
    sentences: list[str] = []
    for action, entry in entries:
        said = f"{entry['when']}, {entry['who']}: {_what(action, entry)}: {entry['why']}"
        sentences.append(said)
        channel = str(entry.get("channel") or "")
        if action == "exclude" and not channel:
            excluded = excluded or f"excluded by {entry['who']} on {entry['when']}: {entry['why']}"
        elif action == "exclude":
            flags.append(Flagged(channel=channel, window=None, flag="fail", reason=f"review of {said}"))
        elif action == "flag":
            flags.append(
                Flagged(channel=channel, window=entry["window"], flag=entry["flag"], reason=f"review of {said}")
            )
        elif action == "trim":
            window = Review(window=window).within(entry["window"])
        else:
            factors[channel] = factors.get(channel, 1.0) * entry["factor"]
    return Review(excluded=excluded, window=window, flags=tuple(flags), factors=factors, sentences=tuple(sentences))


def _what(action: str, entry: Mapping[str, Any]) -> str:
    if action == "exclude":
        return f"channel {entry['channel']} excluded" if entry.get("channel") else "test excluded"
    if action == "correct":
        return f"gain of channel {entry['channel']} multiplied by {entry['factor']:g}"
    low, high = entry["window"]
    if action == "trim":
        return f"only {low:g} s to {high:g} s used"
    return f"channel {entry['channel']} from {low:g} s to {high:g} s flagged as {entry['flag']}"
