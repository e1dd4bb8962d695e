"""What the interactive panels of a test show: curves, bands and marks in panels, and the samples that they draw."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Any, TypeVar

import numpy as np

from colonnade.arrays import Array
from colonnade.report.interactive.packing import PLANES, packed

MOST = 20_000_000
"""Samples of a page: in a browser they take half a second and some 200 MB. What is beyond is left out, and said so."""

EVEN = 1e-3
"""Times that stay this close to even ones, in intervals, are even."""

Found = TypeVar("Found")


@dataclass
class Samples:
    """
    Series of samples of a page, each kept once, with the clocks that they are on.

    `add` and `clock` return the number by which a curve names a series or clock.
    """

    series: list[Array] = field(default_factory=list)
    clocks: list[dict[str, Any]] = field(default_factory=list)
    _known: dict[bytes, int] = field(default_factory=dict)
    _known_clocks: dict[bytes, int] = field(default_factory=dict)

    def with_more(self, add: Callable[[Samples], Found]) -> tuple[Samples, Found | None]:
        """Return samples to which `add` has added, and what that returned; these and None if they would be too many."""
        more = replace(
            self,
            series=[*self.series],
            clocks=[*self.clocks],
            _known={**self._known},
            _known_clocks={**self._known_clocks},
        )
        found = add(more)
        return (more, found) if sum(values.size for values in more.series) <= MOST else (self, None)

    def add(self, values: Array) -> int:
        """Keep a series."""
        values = np.asarray(values, dtype=np.float64)
        number = self._known.setdefault(_hash(values), len(self.series))
        if number == len(self.series):
            self.series.append(values)
        return number

    def clock(self, time: Array) -> int:
        """Keep times (s): the first, the interval and, where they are not even, how far each is from even ones."""
        name = _hash(time)
        known = self._known_clocks.get(name)
        if known is not None:
            return known
        interval = float((time[-1] - time[0]) / (time.size - 1)) if time.size > 1 else 1.0
        uneven = time - (time[0] + interval * np.arange(time.size))
        described = {"start": float(time[0]), "interval": interval, "count": int(time.size)}
        if np.abs(uneven).max() > EVEN * interval:
            described["uneven"] = self.add(uneven)
        self.clocks.append(described)
        self._known_clocks[name] = len(self.clocks) - 1
        return len(self.clocks) - 1

    def curve(self, name: str, time: Array, values: Array, **look: Any) -> dict[str, Any]:
        """Keep a curve and describe it: its name, and its look (`colour`, `dash`, `width`)."""
        return {"name": name, "clock": self.clock(time), "values": self.add(values), **look}


def _hash(values: Array) -> bytes:
    return hashlib.sha256(values.tobytes()).digest()  # a processor's own: twice as fast as blake2b


def script(page: str, samples: Samples, **more: Any) -> str:
    """
    Return the data of a page: a classic script that calls one function.

    Parameters
    ----------
    page : str
        Name of the page.
    samples : Samples
        What its panels draw and its tables hold.
    **more
        What else the script reads, as JSON can hold it.
    """
    series, text = packed(samples.series)
    given = {"page": page, "clocks": samples.clocks, "planes": PLANES, "series": series, **more, "samples": text}
    # Within a script of its own no text can end the script early; U+2028 and U+2029 are escaped by json.
    return f"colonnade.show({json.dumps(given, separators=(',', ':'), allow_nan=False)});\n"
