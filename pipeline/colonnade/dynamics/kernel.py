"""The one way in which numerical kernels are compiled."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar, cast

import numba

Function = TypeVar("Function", bound=Callable[..., Any])


def kernel(function: Function) -> Function:
    """
    Compile a function of scalars and arrays, keeping the machine code between runs where a folder can be written.

    Notes
    -----
    A kernel touches no Python object, so it lets other threads run.
    A cached kernel goes stale when a kernel that it calls changes in *another* file, so all kernels of one call chain
    live in one file. Where no cache folder is writable (a read-only installation without a home), numba refuses to
    decorate; the kernel is then compiled anew in each process.
    """
    try:
        return cast(Function, numba.njit(cache=True, nogil=True, error_model="numpy")(function))
    except RuntimeError:
        return cast(Function, numba.njit(nogil=True, error_model="numpy")(function))
