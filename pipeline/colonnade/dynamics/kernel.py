"""How numerical kernels are compiled, and the folder that caches their machine code."""

from __future__ import annotations

import hashlib
import re
import tempfile
from collections.abc import Callable, Iterator
from contextlib import suppress
from functools import cache
from pathlib import Path
from threading import Lock
from typing import Any, TypeVar, cast

import numba
from numba.misc import appdirs

Function = TypeVar("Function", bound=Callable[..., Any])

PACKAGE = Path(__file__).parents[1]
FOLDER = "colonnade-kernels-"
"""What the name of a cache folder begins with; the hash of the kernels' sources follows."""

_SETTINGS: Any = numba.config
_APPDIRS: Any = appdirs
_OPTIONS: Any = {"nogil": True, "error_model": "numpy", "forceinline": True}
"""Kernels that are called are put in line: as calls, the parts that the engines share cost a run half as much again."""

_MARK = b"\n@kernel"
_IMPORT = re.compile(rb"^from " + PACKAGE.name.encode() + rb"\.([\w.]+) import ", re.MULTILINE)
_DECORATING = Lock()


def kernel(function: Function) -> Function:
    """
    Compile a function of scalars and arrays, keeping the machine code between runs if a folder can be written.

    Notes
    -----
    A kernel touches no Python object, so it lets other threads run. Without a writable folder (a read-only installation
    without a home) it is compiled again in each process.

    numba sees when a kernel's own file changes, but not when a kernel that it calls changes in another file. So the
    machine code is kept in a folder named by the hash of all sources that kernels are made of.
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
    compiled, folder = numba.njit(**_OPTIONS, **options)(function), _cache_folder()
    if folder is not None:
        with _DECORATING:
            # numba reads its setting here; kernels of other packages keep theirs.
            theirs, _SETTINGS.CACHE_DIR = _SETTINGS.CACHE_DIR, str(folder)
            with suppress(RuntimeError):  # no source file, as in a frozen program
                compiled.enable_caching()
            _SETTINGS.CACHE_DIR = theirs
    return cast("Function", compiled)


@cache
def _cache_folder() -> Path | None:
    """Return the cache folder of these sources, in the first place that can be written; None if nothing can."""
    name = FOLDER + _hash_of_sources()
    for place in _places():
        folder = place / name
        with suppress(OSError):
            folder.mkdir(parents=True, exist_ok=True)
            tempfile.TemporaryFile(dir=folder).close()
            return folder
    return None


def _places() -> Iterator[Path]:
    """Give the user's choice, then the package itself, then the user's cache."""
    if _SETTINGS.CACHE_DIR:
        yield Path(_SETTINGS.CACHE_DIR)
    yield Path(__file__).parent / "__pycache__"
    home = Path(_APPDIRS.user_cache_dir("colonnade", False))
    if home.is_absolute():  # not so without a home
        yield home


def _hash_of_sources() -> str:
    """Hash the modules with kernels and those from which they import, whose constants are compiled in."""
    sources = {path.relative_to(PACKAGE).as_posix(): path.read_bytes() for path in PACKAGE.rglob("*.py")}
    with_kernels = {name for name, text in sources.items() if _MARK in text}
    imported = {
        module.decode().replace(".", "/") + ".py" for name in with_kernels for module in _IMPORT.findall(sources[name])
    }
    digest = hashlib.sha256()
    for name in sorted(with_kernels | imported & sources.keys()):
        digest.update(f"{name} {len(sources[name])}\n".encode() + sources[name])
    return digest.hexdigest()[:16]
