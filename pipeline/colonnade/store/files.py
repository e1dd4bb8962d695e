"""
NetCDF and text on disk: whole or not at all.

A file is written in the same folder under a temporary name and renamed in one step, so a kill at any instant leaves the
old file or the new one. Reading checks the stored hash of the values.
"""

from __future__ import annotations

import errno
import os
import shutil
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar
from pathlib import Path
from typing import IO, TYPE_CHECKING, Any

from colonnade.errors import StoreError
from colonnade.store.description import describe
from colonnade.store.netcdf import attributes_of, dump, loaded, restored, storable
from colonnade.store.provenance import content_hash, coverage

if TYPE_CHECKING:
    import netCDF4
    import xarray as xr

PARTIAL = ".partial"
"""Ending of temporary names, as a killed run leaves them."""

_expect_permit: ContextVar[Callable[[], None]] = ContextVar("expect_permit", default=lambda: None)


@contextmanager
def only_while(expect_permit: Callable[[], None]) -> Iterator[None]:
    """
    In this context, ask for permission before each file that is put in place or removed.

    Parameters
    ----------
    expect_permit : callable
        Raises if files may not be changed any more.
    """
    before = _expect_permit.set(expect_permit)
    try:
        yield
    finally:
        _expect_permit.reset(before)


def write(dataset: xr.Dataset, path: Path, *, attributes: Mapping[str, Any]) -> xr.Dataset:
    """
    Store a stage's result.

    Parameters
    ----------
    dataset : xr.Dataset
        Values and attributes as the stage returns them; it is described here.
    path : Path
        Its folder is made if necessary.
    attributes : mapping
        Global attributes in addition to the dataset's own; `stage` is among them.

    Returns
    -------
    stored : xr.Dataset
        As `read` gives it. Its attribute `content` is the hash of the values and of the attributes that a later stage
        may read.

    Raises
    ------
    StoreError
        If a variable is not described, or the file cannot be written.
    """
    described = describe(dataset, str(attributes.get("stage", "")))
    described.attrs = storable({"status": "done", "warnings": [], **dataset.attrs, **attributes, **coverage(dataset)})
    for variable in described.variables.values():
        variable.attrs = storable(variable.attrs)
    _put_result(path, described)
    described.attrs = restored(described.attrs)
    return described


def write_failed(path: Path, reason: str, *, attributes: Mapping[str, Any]) -> None:
    """Store that a stage failed, and why; the file holds no data."""
    import xarray as xr

    failed = xr.Dataset(attrs=storable({"warnings": [], **attributes, "status": "failed", "reason": reason}))
    _put_result(path, failed)


def _put_result(path: Path, dataset: xr.Dataset) -> None:
    dataset.attrs["content"] = content_hash(dataset)
    _in_one_step(path, lambda partial: dump(partial, dataset))


def read(path: Path) -> xr.Dataset:
    """
    Load a result into memory; the file is closed again.

    Returns
    -------
    dataset : xr.Dataset
        With `warnings` as findings and lists of text as they were given; times are numbers, nothing is masked.

    Raises
    ------
    StoreError
        If it is missing, is not a whole NetCDF file, or its values differ from those that were written.
    """
    with _opened(path) as opened:
        dataset = loaded(opened)
    if dataset.attrs.get("content") != content_hash(dataset):
        raise _damaged(path, "its values differ from those that were written")
    dataset.attrs = restored(dataset.attrs)
    return dataset


def read_attributes(path: Path) -> dict[str, Any]:
    """
    Read the global attributes alone, which is fast.

    Raises
    ------
    StoreError
        If the file is missing or is not a NetCDF file.
    """
    with _opened(path) as opened:
        return restored(attributes_of(opened))


@contextmanager
def _opened(path: Path) -> Iterator[netCDF4.Dataset]:
    import netCDF4

    try:
        with netCDF4.Dataset(path) as opened:
            yield opened
    except FileNotFoundError:
        raise StoreError(f"{path}: result not found. Run `colonnade run` to make it.") from None
    except (OSError, RuntimeError, ValueError, KeyError) as error:
        raise _damaged(path, f"it cannot be read as NetCDF ({error})") from error


def write_text(path: Path, text: str) -> bool:
    """Write a text file, see `write_changed`."""
    return write_changed(path, text.encode())


def write_changed(path: Path, data: bytes) -> bool:
    """
    Write a file, unless it holds these bytes already.

    Returns
    -------
    written : bool

    Raises
    ------
    StoreError
        If it cannot be written.
    """
    try:
        if path.read_bytes() == data:
            return False
    except FileNotFoundError:
        pass
    except OSError as error:
        raise _unwritable(path, error) from error
    write_bytes(path, data)
    return True


def write_bytes(path: Path, data: bytes | memoryview) -> None:
    """
    Write a file of any kind, whole or not at all.

    Raises
    ------
    StoreError
        If it cannot be written.
    """
    write_stream(path, lambda stream: stream.write(data))


def write_stream(path: Path, write_to: Callable[[IO[bytes]], object]) -> None:
    """
    Let a long file be written piece by piece, whole or not at all.

    Raises
    ------
    StoreError
        If it cannot be written.
    """

    def write_partial(partial: Path) -> None:
        with partial.open("wb") as stream:
            write_to(stream)
            stream.flush()
            os.fsync(stream.fileno())

    _in_one_step(path, write_partial)


def remove(path: Path) -> bool:
    """Remove a file if it exists; return whether it did."""
    _expect_permit.get()()
    try:
        path.unlink()
    except FileNotFoundError:
        return False
    except OSError as error:
        raise _unwritable(path, error) from error
    return True


def half_written(folder: Path) -> list[Path]:
    """List temporary files that a killed run left; only the holder of the lock may remove them. Raises: `own_files`."""
    return [path for path in own_files(folder) if path.name.startswith(".") and path.name.endswith(PARTIAL)]


def _in_one_step(path: Path, write_to: Callable[[Path], object]) -> None:
    """Have a file written under a temporary name, then put it in place."""
    partial = path.with_name(f".{path.name}.{os.getpid()}{PARTIAL}")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        partial.unlink(missing_ok=True)  # it may be a link
        try:
            write_to(partial)
            _expect_permit.get()()
            partial.replace(path)
        except BaseException:  # Ctrl-C too: nothing half-written stays
            partial.unlink(missing_ok=True)
            raise
    except OSError as error:
        raise _unwritable(path, error) from error


def _unwritable(path: Path, error: OSError) -> StoreError:
    if error.errno in (errno.ENOSPC, errno.EDQUOT):
        there = next(folder for folder in path.parents if folder.exists())
        free = shutil.disk_usage(there).free
        return StoreError(
            f"{path}: the disk is full ({free / 1e6:.1f} MB free). Results so far are complete; free some space "
            "and run again."
        )
    if error.errno in (errno.EACCES, errno.EPERM, errno.EROFS):
        return StoreError(
            f"{path}: it cannot be written ({error.strerror}). Make its folder writable, or give another folder with "
            "--results."
        )
    return StoreError(f"{path}: it cannot be written ({error.strerror or error}). Check the disk and run again.")


def _damaged(path: Path, found: str) -> StoreError:
    return StoreError(
        f"{path}: {found}; it was changed or damaged after colonnade wrote it. Run `colonnade run`: it is "
        "recomputed from the raw file."
    )


def own_files(folder: Path) -> list[Path]:
    """
    List the files of a folder of results, and of the folders in it.

    Parameters
    ----------
    folder : Path
        It need not exist.

    Returns
    -------
    files : list of Path
        A link to a file counts as one: results are put in its place, never through it.

    Raises
    ------
    StoreError
        If the folder or one in it is a link, which would let results be written or removed elsewhere, or if an entry
        is neither a file nor a folder.
    """
    if folder.is_symlink():
        raise _refused(folder)
    found = []
    for root, folders, names in os.walk(folder, onerror=_expect_gone):
        paths = [Path(root, name) for name in names]
        links = [path for path in (Path(root, name) for name in folders) if path.is_symlink()]
        # What a link leads to may be missing; a pipe or a device would be waited for.
        strange = links + [path for path in paths if path.exists() and not path.is_file()]
        if strange:
            raise _refused(strange[0])
        found += paths
    return found


def _expect_gone(error: OSError) -> None:
    """Pass over a folder that is not made yet, or was taken away by a run that ends; refuse one that cannot be read."""
    if not isinstance(error, (FileNotFoundError, NotADirectoryError)):
        raise StoreError(
            f"{error.filename}: this folder of results cannot be read ({error.strerror}). Check its permissions."
        ) from error


def _refused(path: Path) -> StoreError:
    if path.is_symlink():
        return StoreError(
            f"{path}: this is a link, to {path.readlink()}. Results are not written or removed through links. Remove "
            "it; to keep results on another disk, give its folder with --results."
        )
    return StoreError(f"{path}: this is neither a file nor a folder. Only results were expected here; remove it.")
