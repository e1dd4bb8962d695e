"""Samples as text that a script unpacks: rounded to a power of two, differences, compressed, in letters."""

from __future__ import annotations

import zlib
from base64 import b64encode
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from colonnade.arrays import Array

BITS = 20
"""A sample is rounded to this many binary digits of the largest of its series: to a millionth of it, or finer."""

PLANES = 3
"""Bytes of a difference: twice the second difference of two numbers of `BITS` digits fits, with its sign."""


class Packed(NamedTuple):
    """
    Series of samples, packed.

    Attributes
    ----------
    series : list of dict
        Of each series: `count`, `step` (the value of one), `order` (how often differences were taken), and `gaps`
        (first sample and the one after the last of each stretch without value).
    text : str
        The bytes of all, compressed by zlib, in base64.
    """

    series: list[dict[str, Any]]
    text: str


def packed(series: Sequence[Array]) -> Packed:
    """
    Pack series of samples into text, in milliseconds for a hundred thousand of them.

    Parameters
    ----------
    series : sequence of ndarray, shape (n,)
        NaN where there is no value; lengths may differ.

    Returns
    -------
    packed : Packed
        Unpacked as float32 each value is within half a step of what it was.

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
    return Packed(described, b64encode(data).decode())


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
