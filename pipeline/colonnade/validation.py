"""Checks of the arguments of library calls; errors name the argument, what was found and what was expected."""

from __future__ import annotations

from collections.abc import Sequence
from math import inf, isfinite, nan
from typing import Any, TypeVar

import numpy as np

from colonnade.arrays import Array

Kind = TypeVar("Kind")

LONGEST_SHOWN = 40
"""Characters of a value in a message."""


def number(
    name: str,
    value: Any,
    expected: str,
    *,
    above: float = -inf,
    low: float = -inf,
    below: float = inf,
    high: float = inf,
    finite: bool = True,
) -> float:
    """
    Return an argument that is one real number in its range.

    Parameters
    ----------
    name : str
        Of the argument.
    value : object
    expected : str
        What the message says was expected, such as "a positive number".
    above, low, below, high : float, optional
        Bounds; the number may be equal to `low` and `high`.
    finite : bool, optional
        Whether infinity is refused; NaN always is.

    Raises
    ------
    ValueError
        If it is anything else; the message names the argument.

    Examples
    --------
    >>> number("mass", 26.1, "a positive number", above=0.0)
    26.1
    """
    plain = _plain(value)
    is_inside = low <= plain <= high and (above == -inf or plain > above) and (below == inf or plain < below)
    if is_inside and (isfinite(plain) or not finite):
        return plain
    raise ValueError(f"{name} is {described(value)}; {expected} was expected")


def sided(name: str, value: Any, expected: str, **bounds: Any) -> tuple[float, float]:
    """
    Return an argument that is one number for both sides, or a pair (for θ < 0, for θ > 0); bounds as of `number`.

    Raises
    ------
    ValueError
        As `number`.
    """
    pair = value if np.ndim(np.asarray(value, dtype=object)) else (value, value)
    if len(pair) != 2:
        raise ValueError(f"{name} is {described(value)}; {expected}, or a pair of them, was expected")
    negative, positive = (number(name, each, expected, **bounds) for each in pair)
    return negative, positive


def whole(name: str, value: Any, low: int, high: int, expected: str = "") -> int:
    """
    Return an argument that is a whole number from `low` to `high`.

    Raises
    ------
    ValueError
        If it is anything else.
    """
    expected = expected or f"a whole number from {low} to {high}"
    plain = number(name, value, expected, low=low, high=high)
    if plain != int(plain):
        raise ValueError(f"{name} is {described(value)}; {expected} was expected")
    return int(value)


def samples(
    name: str,
    values: Any,
    *,
    dimensions: Sequence[int] = (1,),
    fewest: int = 1,
    finite: bool = True,
    each: str = "number",
) -> Array:
    """
    Return an argument that is an array of real numbers.

    Parameters
    ----------
    name : str
        Of the argument.
    values : object
    dimensions : sequence of int, optional
        Numbers of dimensions that it may have.
    fewest : int, optional
        Values that it holds at least.
    finite : bool, optional
        Whether infinity and NaN are refused.
    each : str, optional
        What one value is, for the message.

    Returns
    -------
    array : ndarray
        Contiguous, of float64.

    Raises
    ------
    ValueError
        If it is anything else; the message names the argument.
    """
    if np.ma.is_masked(values):
        raise ValueError(f"{name} is a masked array; a plain array was expected: fill or cut the gap first")
    try:
        array = np.asarray(values)
    except (ValueError, TypeError) as error:
        raise ValueError(f"{name} is not an array of numbers ({error}); one was expected") from None
    if array.dtype.kind not in "iuf":
        found = f"holds values of type {array.dtype.name}" if array.ndim else f"is {described(values)}"
        raise ValueError(f"{name} {found}; an array of real numbers was expected")
    if array.ndim not in dimensions or array.size < fewest:
        forms = " or ".join(f"a {number_of}-dimensional" for number_of in dimensions)
        least = f"at least one {each}" if fewest == 1 else f"at least {fewest} {each}s"
        raise ValueError(f"{name} has shape {array.shape}; {forms} array with {least} was expected")
    plain = np.asarray(array, dtype=np.float64, order="C")
    if finite and not np.isfinite(plain).all():
        place = int(np.argmin(np.isfinite(plain)))
        raise ValueError(f"{name} is not finite at {each} {place}; fill or cut the gap first")
    return plain


def instance(name: str, value: Any, kind: type[Kind], expected: str = "") -> Kind:
    """
    Return an argument that is of a class.

    Raises
    ------
    ValueError
        If it is of another.
    """
    if not isinstance(value, kind):
        raise ValueError(f"{name} is {described(value)}; {expected or f'a {kind.__name__}'} was expected")
    return value


def described(value: Any) -> str:
    """
    Say what a value is, in a few words.

    Examples
    --------
    >>> described(-1.5), described("x"), described([1.0, 2.0]), described(1j)
    ('-1.5', "the text 'x'", 'an array of shape (2,)', '1j')
    """
    if isinstance(value, (str, bytes)):
        return f"the text {value[:LONGEST_SHOWN]!r}"
    if isinstance(value, (np.ndarray, list, tuple)):
        return f"an array of shape {np.asarray(value, dtype=object).shape}"
    written = str(value)
    return written if len(written) <= LONGEST_SHOWN and "\n" not in written else f"a {type(value).__name__}"


def _plain(value: Any) -> float:
    """One real number as float; NaN, which is inside of nothing, if it is anything else."""
    if value is np.ma.masked or isinstance(value, (list, tuple)):
        return nan
    array = np.asarray(value)
    return float(array) if array.ndim == 0 and array.dtype.kind in "iuf" else nan
