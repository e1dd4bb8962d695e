"""How numerical kernels are compiled, and how their machine code is kept between runs."""

from __future__ import annotations

import hashlib
import re
from collections.abc import Callable
from contextlib import suppress
from functools import cache
from pathlib import Path
from typing import Any, TypeVar, cast

import numba

Function = TypeVar("Function", bound=Callable[..., Any])

PACKAGE = Path(__file__).parents[1]

_OPTIONS: Any = {"nogil": True, "error_model": "numpy", "forceinline": True}
"""Kernels that are called are put in line: as calls, the parts that the engines share cost a run half as much again."""

_MARK = b"\n@kernel"
_IMPORT = re.compile(rb"^from " + PACKAGE.name.encode() + rb"\.([\w.]+) import ", re.MULTILINE)


def kernel(function: Function) -> Function:
    """
    Compile a function of scalars and arrays, keeping the machine code between runs if a folder can be written.

    Notes
    -----
    A kernel touches no Python object, so it lets other threads run. Its machine code is kept where numba puts it: in
    NUMBA_CACHE_DIR, beside the source, or in the user's cache. Without a folder that can be written (a read-only
    installation without a home) it is compiled again in each process.

    numba sees when a kernel's own file changes, but not when a kernel that it calls changes in another file. So the
    machine code is kept under a name with the hash of all sources that kernels are made of.
    """
    return _compiled(function)


def kernel_in_place(function: Function) -> Function:
    """
    Compile a function that only fills arrays that it is given, and makes and returns none, as `kernel` does.

    No references to arrays are counted then: a run on contact takes less than half as long, and so does its
    compilation; a history in the plane is a twentieth faster.
    """
    return _compiled(function, _nrt=False)


def kernel_fused(function: Function) -> Function:
    """
    Compile a function as `kernel_in_place` does, but let a product and a sum be rounded once, where the processor can.

    Chains of a polynomial then take half the time; the closed form of an arc is mostly these.
    """
    return _compiled(function, _nrt=False, fastmath={"contract"})


def _compiled(function: Function, **options: Any) -> Function:
    function.__qualname__ += f"-{_hash_of_sources()}"
    compiled = numba.njit(**_OPTIONS, **options)(function)
    with suppress(RuntimeError):  # no folder, or no source file, as in a frozen program
        compiled.enable_caching()
    return cast("Function", compiled)


@cache
def _hash_of_sources() -> str:
    """Hash the modules with kernels and those from which they import, whose constants are compiled in."""
    sources = {path.relative_to(PACKAGE).as_posix(): path.read_bytes() for path in PACKAGE.rglob("*.py")}
    with_kernels = {name for name, text in sources.items() if _MARK in text}
    imported = {
        module.decode().replace(".", "/") + ".py" for name in with_kernels for module in _IMPORT.findall(sources[name])
    }
    names = sorted(with_kernels | imported & sources.keys())
    hashed = b"".join(f"{name} {len(sources[name])}\n".encode() + sources[name] for name in names)
    return hashlib.sha256(hashed).hexdigest()[:16]
