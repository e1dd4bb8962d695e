"""Variables of numbers in a NetCDF or HDF5 file, through all its groups; only the file itself is read, no links."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from colonnade.errors import ReadError
from colonnade.readers.binary.unpacking import Unpacking, UnreadableError
from colonnade.readers.hdf5 import opening

if TYPE_CHECKING:
    import h5py

HIDDEN = frozenset(("CLASS", "NAME", "DIMENSION_LIST", "REFERENCE_LIST", "_Netcdf4Dimid", "_Netcdf4Coordinates"))
SCALE = "DIMENSION_SCALE"
DIMENSION_ONLY = "This is a netCDF dimension but not a netCDF variable"


@dataclass(frozen=True)
class Variable:
    """
    An array of numbers.

    Attributes
    ----------
    path : str
        With its groups: `run/top`.
    values : ndarray
        As stored.
    dimensions : tuple of (str or None)
        Name of each, if it has one.
    attributes : dict
    """

    path: str
    values: NDArray[Any]
    dimensions: tuple[str | None, ...]
    attributes: dict[str, Any]

    @property
    def groups(self) -> tuple[str, ...]:
        """The groups that contain it, outermost first."""
        return tuple(self.path.split("/")[:-1])


@dataclass
class Content:
    """
    What a file holds.

    Attributes
    ----------
    variables : list of Variable
    attributes : dict
        Of the file.
    left_out : dict of str to str
        Path -> why it is not a variable of numbers.
    warnings : list of str
    """

    variables: list[Variable] = field(default_factory=list)
    attributes: dict[str, Any] = field(default_factory=dict)
    left_out: dict[str, str] = field(default_factory=dict)
    warnings: list[str] = field(default_factory=list)


def read_classic(path: Path) -> Content:
    """
    Read NetCDF of the classic format.

    Raises
    ------
    ReadError
        If it is of the variant for very large variables (CDF-5).
    """
    from scipy.io import netcdf_file

    with path.open("rb") as stream:
        if stream.read(4) == b"CDF\x05":
            raise ReadError(
                f"{path.name}: it is NetCDF of the variant CDF-5, which is not read. Convert it: nccopy -k nc4 "
                f"{path.name} converted.nc"
            )
        stream.seek(0)
        try:
            file = netcdf_file(stream, mmap=False)
        except MemoryError as error:
            raise ReadError(
                f"{path.name}: it claims more data than its {path.stat().st_size} bytes can hold: it is damaged. Copy "
                "it again."
            ) from error
        content = Content(attributes=_attributes(file._attributes.items()))
        for name, variable in file.variables.items():
            if variable.data.dtype.kind not in "fiu":
                content.left_out[name] = "it holds text"
                continue
            values = np.array(variable.data, dtype=variable.data.dtype.newbyteorder("="))
            content.variables.append(
                Variable(name, values, tuple(variable.dimensions), _attributes(variable._attributes.items()))
            )
    return content


def read_hdf5(path: Path) -> Content:
    """
    Read NetCDF-4, or any other HDF5 file.

    Raises
    ------
    ReadError
        As `open_hdf5`.
    """
    content = Content()
    with opening.open_hdf5(path) as file:
        content.attributes = _attributes(_items(file.attrs))
        unpacking = Unpacking(path.stat().st_size)
        for place, item in _datasets(file, "", content, ()):
            try:
                _take(place, item, content, unpacking)
            except UnreadableError as reason:
                content.left_out[place] = str(reason)
            except opening.DAMAGE as error:
                content.warnings.append(f"{place} is damaged, or packed in a way that cannot be unpacked here: {error}")
    return content


def _datasets(
    group: h5py.Group, above: str, content: Content, around: tuple[int, ...]
) -> Iterator[tuple[str, h5py.Dataset]]:
    """Go through all datasets that lie in the file itself; `around` are the addresses of the groups they lie in."""
    import h5py

    own = opening.address(group)
    if own in around or len(around) > opening.DEEPEST:
        content.left_out[above] = (
            "it contains itself" if own in around else f"it is more than {opening.DEEPEST} groups deep"
        )
        return
    try:
        names = list(group)[: opening.MOST_PARTS]
    except opening.DAMAGE as error:
        content.warnings.append(f'group "{above or "/"}" is damaged and not read: {error}')
        return
    for name in names:
        place = f"{above}/{name}" if above else name
        try:
            item = opening.member(group, name)
        except UnreadableError as reason:
            content.left_out[place] = str(reason)
            continue
        except opening.DAMAGE as error:
            content.warnings.append(f"{place} is damaged and not read: {error}")
            continue
        if isinstance(item, h5py.Group):
            yield from _datasets(item, place, content, (*around, own))
        elif isinstance(item, h5py.Dataset):
            yield place, item


def _take(place: str, dataset: h5py.Dataset, content: Content, unpacking: Unpacking) -> None:
    """Add a dataset; a table gives each of its columns of numbers."""
    opening.expect_numbers_here(dataset)
    if dataset.dtype.kind not in "fiub" and not (dataset.dtype.names and dataset.ndim == 1):
        raise UnreadableError("it holds no numbers")
    unpacking.take(dataset.nbytes)
    # Each attribute is read once: a text whose length is damaged costs as many bytes, up to 4 GB, before it is refused.
    kept = dict(_items(dataset.attrs))
    if DIMENSION_ONLY in str(kept.get("NAME", b"")):
        return
    if not dataset.dtype.names:
        dimensions, attributes = _dimensions(dataset, kept), _attributes(kept.items())
        content.variables.append(Variable(place, dataset[()], dimensions, attributes))
        return
    table = dataset[()]
    for name in dataset.dtype.names:
        if table.dtype[name].kind in "fiub" and table.dtype[name].shape == ():
            content.variables.append(Variable(f"{place}/{name}", np.array(table[name]), (place,), {}))
        else:
            content.left_out[f"{place}/{name}"] = "it holds no numbers"


def _dimensions(dataset: h5py.Dataset, kept: dict[str, Any]) -> tuple[str | None, ...]:
    """
    Paths of the variables that are the dataset's dimensions, by its attributes; of a coordinate it is its own.

    Taken from the attributes in which they are kept: HDF5's own functions for them end the process where those are
    damaged.
    """
    if SCALE in str(kept.get("CLASS", "")):
        return (str(dataset.name).strip("/"), *(None,) * (dataset.ndim - 1))
    scales = np.atleast_1d(kept.get("DIMENSION_LIST", np.empty(0, dtype=object)))
    if scales.shape != (dataset.ndim,):
        return tuple(None for _ in dataset.shape)
    return tuple(str(dataset.file[axis[0]].name).strip("/") if len(axis) else None for axis in scales)


def _items(attributes: Any) -> Iterator[tuple[str, Any]]:
    for name in attributes:
        try:
            yield name, attributes[name]
        except (OSError, RuntimeError, ValueError, TypeError, KeyError, UnicodeError):
            continue  # an attribute that cannot be read says nothing


def _attributes(items: Any) -> dict[str, Any]:
    """Attributes as text or numbers."""
    plain = {}
    for name, value in items:
        if name in HIDDEN:
            continue
        if isinstance(value, np.ndarray) and value.size == 1:
            value = value.ravel()[0]
        plain[name] = value.decode("utf-8", "replace") if isinstance(value, bytes) else value
    return plain
