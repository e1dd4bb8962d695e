"""From the raw values of an MDF channel to physical ones: the standard's conversions, as far as they are numbers."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from colonnade.readers.recording import Array

Raw = NDArray[Any]


class NoNumbersError(ValueError):
    """A channel or conversion that gives no numbers; its text is the reason."""


class NotComputedError(NoNumbersError):
    """A conversion that might give numbers, but is not computed."""


def convert(raw: Raw, conversion: Any, *, is_version_4: bool) -> Array:
    """
    Compute physical values.

    Parameters
    ----------
    raw : ndarray, shape (n,)
        Numbers as stored.
    conversion : object or None
        Conversion block as asammdf has read it; only its parameters are used, never what it can do itself.
    is_version_4 : bool
        Whether the file is of version 4, whose numbers of kinds are others than those of versions 2 and 3.

    Returns
    -------
    values : ndarray, shape (n,)
        NaN where the conversion has no finite number for a raw value.

    Raises
    ------
    NoNumbersError
        If the conversion gives text only; NotComputedError if it is a formula in text.

    Notes
    -----
    ASAM MDF 4.2, § "The channel conversion block CCBLOCK"; MDF 3.3, § "CCBLOCK". A formula in text is not evaluated:
    what can compute any formula can do other things too.
    """
    kinds: Mapping[int, Callable[[Raw, Any], Array]] = KINDS_OF_4 if is_version_4 else KINDS_OF_3
    identity = 0 if is_version_4 else 65535
    kind = identity if conversion is None else int(conversion.conversion_type)
    with np.errstate(all="ignore"):
        if kind == identity:
            values = raw.astype(np.float64)
        elif kind in kinds:
            values = np.asarray(kinds[kind](raw, conversion), dtype=np.float64)
        else:
            raise NotComputedError(f"its conversion is of kind {kind}, which is not read")
    values[~np.isfinite(values)] = np.nan
    return values


def linear(raw: Raw, block: Any) -> Array:
    """A x + b."""
    return raw.astype(np.float64) * float(block.a) + float(block.b)


def rational(raw: Raw, block: Any) -> Array:
    """(P1 x² + P2 x + P3) / (P4 x² + P5 x + P6); a common factor x is divided out."""
    x = raw.astype(np.float64)
    above, below = (block.P1, block.P2, block.P3), (block.P4, block.P5, block.P6)
    if above[1:] == (0, 0) and (below[0], below[2]) == (0, 0):
        return x * (block.P1 / block.P5 if block.P5 else np.nan)
    return np.polyval(above, x) / np.polyval(below, x)


def polynomial(raw: Raw, block: Any) -> Array:
    """(P2 - P4 (x - P5 - P6)) / (P3 (x - P5 - P6) - P1), as MDF 3 calls a polynomial."""
    x = raw.astype(np.float64) - block.P5 - block.P6
    return np.asarray((block.P2 - block.P4 * x) / (block.P3 * x - block.P1))


def exponential(raw: Raw, block: Any) -> Array:
    """Of `_argument`, exp."""
    argument, divisor = _argument(raw, block)
    return np.exp(argument) / divisor


def logarithmic(raw: Raw, block: Any) -> Array:
    """Of `_argument`, ln."""
    argument, divisor = _argument(raw, block)
    return np.log(argument) / divisor


def _argument(raw: Raw, block: Any) -> tuple[Array, np.float64]:
    """((x - P7) P6 - P3) / P1 with divisor P2 where P4 is zero; (P3 / (x - P7) - P6) / P4 with P5 where P1 is."""
    x = raw.astype(np.float64) - block.P7
    if block.P4 == 0:
        return (x * block.P6 - block.P3) / np.float64(block.P1), np.float64(block.P2)
    if block.P1 == 0:
        return (block.P3 / x - block.P6) / block.P4, np.float64(block.P5)
    raise NotComputedError("its exponential or logarithmic conversion has neither P1 nor P4 zero, as the standard asks")


def interpolated(raw: Raw, block: Any) -> Array:
    """Between the points of a table, and as its ends beyond them."""
    keys, values = _table(block)
    return np.interp(raw.astype(np.float64), keys, values)


def nearest(raw: Raw, block: Any) -> Array:
    """The value of a table's nearest key, of two as near the lower one's."""
    keys, values = _table(block)
    x = raw.astype(np.float64)
    above = np.minimum(np.searchsorted(keys, x), keys.size - 1)
    below = np.maximum(above - 1, 0)
    return np.where(np.abs(x - keys[above]) >= np.abs(x - keys[below]), values[below], values[above])


def _table(block: Any) -> tuple[Array, Array]:
    """Keys and values, in the order of the keys."""
    count = (block.val_param_nr // 2) if hasattr(block, "val_param_nr") else block.ref_param_nr
    pairs = np.array([(block[f"raw_{n}"], block[f"phys_{n}"]) for n in range(count)], dtype=np.float64)
    if not pairs.size:
        raise NotComputedError("its conversion is a table without rows")
    pairs = pairs[np.argsort(pairs[:, 0], kind="stable")]
    return pairs[:, 0], pairs[:, 1]


def of_range(raw: Raw, block: Any) -> Array:
    """The value of the range that holds a raw one; its upper end is in it for whole numbers only."""
    values = np.full(raw.size, float(block.default))
    for number in range((block.val_param_nr - 1) // 3):
        values[_within(raw, block[f"lower_{number}"], block[f"upper_{number}"])] = block[f"phys_{number}"]
    return values


def named(raw: Raw, block: Any) -> Array:
    """Of a table of keys with texts or further conversions: a text counts as missing."""
    parts = [(raw == block[f"val_{n}"], block.referenced_blocks[f"text_{n}"]) for n in range(block.val_param_nr)]
    return _by_parts(raw, parts, block.referenced_blocks["default_addr"])


def named_of_range(raw: Raw, block: Any) -> Array:
    """Of a table of ranges with texts or further conversions: a text counts as missing."""
    parts = [
        (_within(raw, block[f"lower_{n}"], block[f"upper_{n}"]), block.referenced_blocks[f"text_{n}"])
        for n in range(block.val_param_nr // 2)
    ]
    return _by_parts(raw, parts, block.referenced_blocks["default_addr"])


def _within(raw: Raw, lower: float, upper: float) -> NDArray[np.bool_]:
    return (raw >= lower) & ((raw < upper) if raw.dtype.kind == "f" else (raw <= upper))


def _by_parts(raw: Raw, parts: list[tuple[NDArray[np.bool_], Any]], default: Any) -> Array:
    """Convert each part by what it refers to; a raw value in several belongs to the first."""
    values = np.full(raw.size, np.nan)
    left = np.ones(raw.size, dtype=bool)
    numbers = 0
    for chosen, reference in (*parts, (left.copy(), default)):
        mine = chosen & left
        left &= ~chosen
        if mine.any() and not isinstance(reference, bytes):
            values[mine] = convert(raw[mine], reference, is_version_4=True)
            numbers += int(mine.sum())
    if raw.size and not numbers:
        raise NoNumbersError("its values are names")
    return values


def _formula(raw: Raw, block: Any) -> Array:
    told = " ".join(str(block.formula).split())
    shown = told if len(told) <= 40 else told[:40] + "…"
    raise NotComputedError(f'its conversion is a formula in text ("{shown}"), which is never evaluated')


def _names(raw: Raw, block: Any) -> Array:
    raise NoNumbersError("its values are names")


KINDS_OF_4 = {
    **{1: linear, 2: rational, 3: _formula, 4: interpolated, 5: nearest, 6: of_range, 7: named, 8: named_of_range},
    **{9: _names, 10: _names, 11: _names},
}
KINDS_OF_3 = {
    **{0: linear, 1: interpolated, 2: nearest, 6: polynomial, 7: exponential, 8: logarithmic, 9: rational},
    **{10: _formula, 11: _names, 12: _names},
}
