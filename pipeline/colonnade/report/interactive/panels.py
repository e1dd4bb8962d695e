"""What the page's script draws and writes: panels of curves, bands and marks, tables, and packed samples."""

from __future__ import annotations

import hashlib
import json
import zlib
from base64 import b64encode
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import Any, TypeVar

import numpy as np

from colonnade.arrays import Array
from colonnade.campaign.assembly import Whole
from colonnade.dynamics.assembly import Assembly
from colonnade.figures.drawing.described import body_of
from colonnade.figures.drawing.view import Rocking
from colonnade.figures.files.output import Picture, as_csv
from colonnade.figures.files.table import Columns, columns_of
from colonnade.figures.stored.subject import OfTest
from colonnade.figures.style import name_of, style_of

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

    def with_more(self, add: Callable[[Samples], Found]) -> Found | None:
        """Return what `add` returns that adds to these; None, with nothing added, if they would be too many."""
        before = [*self.series], [*self.clocks], {**self._known}, {**self._known_clocks}
        found = add(self)
        if sum(values.size for values in self.series) <= MOST:
            return found
        self.series, self.clocks, self._known, self._known_clocks = before
        return None

    def add(self, values: Array) -> int:
        """Keep a series."""
        values = np.asarray(values, dtype=np.float64)
        number = self._known.setdefault(_hash(values), len(self.series))
        if number == len(self.series):
            self.series.append(values)
        return number

    def clock(self, time: Array) -> int:
        """Keep times (s): the first, the interval and, where they are not even, how far each is from even ones."""
        number = self._known_clocks.setdefault(_hash(time), len(self.clocks))
        if number < len(self.clocks):
            return number
        interval = float((time[-1] - time[0]) / (time.size - 1)) if time.size > 1 else 1.0
        uneven = time - (time[0] + interval * np.arange(time.size))
        described = {"start": float(time[0]), "interval": interval, "count": int(time.size)}
        if np.abs(uneven).max() > EVEN * interval:
            described["uneven"] = self.add(uneven)
        self.clocks.append(described)
        return number

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


BITS = 20
"""A sample is rounded to this many binary digits of the largest of its series: to a millionth of it, or finer."""

PLANES = 3
"""Bytes of a difference: twice the second difference of two numbers of `BITS` digits fits, with its sign."""


def packed(series: Sequence[Array]) -> tuple[list[dict[str, Any]], str]:
    """
    Pack series of samples into text, in milliseconds for a hundred thousand of them.

    Parameters
    ----------
    series : sequence of ndarray, shape (n,)
        NaN where there is no value; lengths may differ.

    Returns
    -------
    described : list of dict
        Of each series: `count`, `step` (the value of one), `order` (how often differences were taken), and `gaps`
        (first sample and the one after the last of each stretch without value).
    text : str
        The bytes of all, compressed by zlib, in base64. Unpacked as float32 each value is within half a step of what
        it was.

    Notes
    -----
    The bits of a float below what a transducer resolves are noise, which no compression makes smaller; rounded to
    whole steps, a smooth series has second differences of a byte or so. Their bytes are parted into planes (all lowest,
    all next, …), so that the high ones are runs of zeros.
    """
    described, planes = [], []
    for values in series:
        whole, step, gaps = _rounded(np.asarray(values, dtype=np.float64))
        candidates = [np.diff(whole, n=order, prepend=np.zeros(order, dtype=np.int64)) for order in (1, 2)]
        order = 1 + int(np.abs(candidates[1]).sum() < np.abs(candidates[0]).sum())
        different = candidates[order - 1]
        folded = ((different << 1) ^ (different >> 63)).astype("<u4")
        planes.append(np.ascontiguousarray(folded.view(np.uint8).reshape(-1, 4)[:, :PLANES].T).tobytes())
        described.append({"count": int(whole.size), "step": step, "order": order, "gaps": gaps})
    compressor = zlib.compressobj(level=1, strategy=zlib.Z_RLE)
    data = compressor.compress(b"".join(planes)) + compressor.flush()
    return described, b64encode(data).decode()


def _rounded(values: Array) -> tuple[np.ndarray[Any, np.dtype[np.int64]], float, list[list[int]]]:
    """Give whole multiples of a step, the step, and the gaps, which hold the value before them."""
    finite = np.isfinite(values)
    edges = np.flatnonzero(np.diff(np.concatenate(([False], ~finite, [False])).astype(np.int8)))
    if not finite.all():
        before = np.maximum.accumulate(np.where(finite, np.arange(values.size), -1))
        values = np.where(before >= 0, values[before], 0.0)
    largest = float(np.abs(values).max(initial=0.0))
    step = float(2.0 ** (np.frexp(largest)[1] - BITS)) if largest else 1.0
    return np.rint(values / step).astype(np.int64), step, edges.reshape(-1, 2).tolist()


LONG = 2000
"""Cells up to which a table is CSV text; the columns of a longer one are packed with the samples of the page."""


def tables_of(pictures: Iterable[Picture], samples: Samples) -> dict[str, Any]:
    """
    Give the table of each picture by its id: CSV text, or headings with columns. One that is too long has none.

    A column is a list of words, or names a series or, if it rises throughout, a clock of the samples.
    """
    found: dict[str, Any] = {}
    for picture in pictures:
        table = columns_of(picture.figure)
        if sum(map(len, table.values())) <= LONG:
            found[picture.identity] = as_csv(table)
        else:
            columns = samples.with_more(partial(_columns, table))
            if columns is not None:
                found[picture.identity] = {"heads": list(table), "columns": columns}
    return found


def of_page(address: str, pictures: Iterable[Picture]) -> str:
    """Return the script with the data of a page that has no histories: the tables of its pictures."""
    samples = Samples()
    return script(address, samples, tables=tables_of(pictures, samples))


def _columns(table: Columns, samples: Samples) -> list[Any]:
    return [_column(column, samples) for column in table.values()]


def _column(column: Array | list[str], samples: Samples) -> Any:
    if isinstance(column, list):
        return column
    rises = column.size > 1 and (column[1:] > column[:-1]).all()
    return {"clock": samples.clock(column)} if rises else {"series": samples.add(column)}


def look_of(who: str) -> dict[str, Any]:
    """Colour and dashes of what was "measured", of a model, or without a name of what was recorded beside."""
    own, style = {"measured": "ink", "": "soft"}.get(who), style_of(who)
    dash = style["linestyle"][1] if isinstance(style["linestyle"], tuple) else ()
    return {"colour": own or style["color"], "dash": list(dash)}


def of_test(one: OfTest, samples: Samples) -> dict[str, Any]:
    """Describe the moving block for the script: measured and by each model, on the recorded motion of the base."""
    specimen, gravity = one.specimen, one.campaign.gravity
    base, how = one.base_displacement()
    if isinstance(specimen, Whole):
        height, parts = _bodies(one, specimen.assembly(gravity), specimen, samples)
    else:
        body, slide = body_of(specimen, one.block), one.motion("slide", "mm")
        shape, height = {"outline": body.outline(), "poles": Rocking.of(one.block).poles}, body.height
        parts = {who: [samples.curve("", *ratio) | shape] for who, ratio in one.ratios().items()}
        if slide is not None and "measured" in parts:
            parts["measured"][0]["slide"] = samples.add(slide.values)
    return {
        "height": height,
        "bodies": [{"name": name_of(who), "parts": each, **look_of(who)} for who, each in parts.items()],
        "base": None if base is None else samples.curve("base", base.time, 1e3 * base.values),
        "how": f"base: {how}",
    }


Parts = dict[str, list[dict[str, Any]]]
"""What moves, "measured" and by model."""


def _bodies(one: OfTest, assembly: Assembly, specimen: Whole, samples: Samples) -> tuple[float, Parts]:
    """Describe the bodies of an assembly, each turned by its angle (rad) with its slide and rise (mm)."""
    found: Parts = {}
    for place, (name, placed) in enumerate(assembly.bodies.items()):
        shape = {
            "outline": body_of(specimen.made[name], placed.block).outline(),
            "poles": Rocking.of(placed.block).poles,
            "place": [placed.position[0], assembly.levels[name]],
            "is_angle": True,
        }
        slides, rises = (one.bodies(place, f"body_{each}") for each in ("slide", "uplift"))
        for who, angle in one.bodies(place, "body_angle").items():
            more = {"slide": slides.get(who), "rise": rises.get(who)}
            moves = {key: samples.add(1e3 * curve.values) for key, curve in more.items() if curve is not None}
            found.setdefault(who, []).append(samples.curve(name, *angle) | shape | moves)
    return assembly.height, found
