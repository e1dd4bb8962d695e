"""
Description of each variable of a result: attributes from the table of variables, or from its channel.

A variable that neither the table nor the naming of channels knows is an error, so that nothing enters the store
undescribed.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from colonnade import units
from colonnade.errors import StoreError, nearest
from colonnade.store.results import rows

if TYPE_CHECKING:
    import xarray as xr

QUALITY_FLAGS = "1=good 2=not_evaluated 3=suspect 4=fail 9=missing"
MODEL_STAGES = frozenset({"contact", "predict", "ensemble", "map"})

_UDUNITS = frozenset({"V", "mV", "A", "mA", "m", "cm", "mm", "um", "s", "ms", "Hz", "kHz", "N", "kN", "rad", "mrad"})
"""Units that are spelt alike here and in UDUNITS; there `g` is the gram, so that all others are written in SI."""

_RESERVED_NAME = re.compile(r"(elapsed(_.*)?|time|.*_(recorded|quality|standard_error))(_channel)*", re.IGNORECASE)
_NUMBERED_NAME = re.compile(r"(id_)*\d", re.IGNORECASE)


def variable_name(channel_id: str) -> str:
    """
    Name of a channel's variable: the channel's id, made a valid CF name.

    Parameters
    ----------
    channel_id : str
        Letters, digits, ``.``, ``_`` and ``-``. Ids that differ after ``.`` and ``-`` have become ``_`` get different
        names.

    Examples
    --------
    >>> variable_name("top-left"), variable_name("2nd"), variable_name("time"), variable_name("top_quality")
    ('top_left', 'id_2nd', 'time_channel', 'top_quality_channel')
    """
    name = re.sub(r"[.-]", "_", channel_id)
    if _NUMBERED_NAME.match(name):
        name = f"id_{name}"
    # A channel may not take the name of a clock, or of what is stored beside another channel.
    return f"{name}_channel" if _RESERVED_NAME.fullmatch(name) else name


def udunits(unit: str | None) -> str:
    """
    UDUNITS spelling of a recorded unit, empty if it has none.

    Examples
    --------
    >>> udunits("Volts"), udunits("g's"), udunits("furlong"), udunits(None)
    ('V', '9.80665 m s-2', '', '')
    """
    if unit is None or (found := units.find_unit(unit)) is None:
        return ""
    if found.symbol in _UDUNITS:
        return found.symbol
    return found.si_unit if found.factor == 1.0 else f"{found.factor!r} {found.si_unit}"


def describe(dataset: xr.Dataset, stage: str = "") -> xr.Dataset:
    """
    Attach CF and ACDD attributes to every variable of a stage's result.

    Parameters
    ----------
    dataset : xr.Dataset
        As a stage returns it. A channel's variable has at least the attributes ``channel`` and ``quantity``, and
        ``recorded_unit`` where its file gives one; ``<channel>_recorded`` and ``<channel>_quality`` go with it.
    stage : str, optional
        Name of the stage: results of a model are marked as such.

    Returns
    -------
    described : xr.Dataset
        A new dataset, in the table's types; attributes that the stage gave are kept.

    Raises
    ------
    StoreError
        If a variable is neither in the table nor a channel.
    """
    described = {}
    for name, variable in ((str(name), variable) for name, variable in dataset.variables.items()):
        entry = _entry(name, dataset)
        attributes = entry.attributes()
        if stage in MODEL_STAGES and attributes.get("coverage_content_type") == MEASURED:
            attributes["coverage_content_type"] = MODELLED
        companions = [companion for companion in (f"{name}_quality", f"{name}_standard_error") if companion in dataset]
        if companions:
            attributes["ancillary_variables"] = " ".join(companions)
        if entry.dtype != "str" and variable.dtype != np.dtype(entry.dtype):
            variable = variable.astype(entry.dtype)
        own = {key: value for key, value in variable.attrs.items() if value is not None and value != ""}
        described[name] = (variable.dims, variable.data, attributes | own)
    return dataset.assign(described)


def _entry(name: str, dataset: xr.Dataset) -> Variable:
    if name in VARIABLES:
        return VARIABLES[name]
    if name.startswith("elapsed_"):
        return Variable(f"time since the zero of clock {name.removeprefix('elapsed_')}", "s", COORDINATE)
    own = dataset.variables[name].attrs
    if "channel" in own and "quantity" in own:
        return _of_channel(own["channel"], own["quantity"], own.get("recorded_unit"))
    base, _, form = name.rpartition("_")
    beside = dataset.variables[base].attrs if base in dataset else {}
    if "channel" in beside and form == "recorded":
        return Variable(f"as in the file, channel {beside['channel']}", udunits(beside.get("recorded_unit")), MEASURED)
    if "channel" in beside and form == "quality":
        said = f"quality of channel {beside['channel']}"
        return Variable(said, "", QUALITY, "quality_flag", "int8", flags=QUALITY_FLAGS)
    raise StoreError(
        f"variable '{name}' of {dict(dataset[name].sizes)} is not described: it is not in the table of variables, and "
        f"without the attributes `channel` and `quantity` it is not a channel either." + nearest(name, VARIABLES)
    )


def _of_channel(channel: str, quantity: str, recorded_unit: str | None) -> Variable:
    """Describe a channel's values in SI; of the quantity "other" in the unit of the recording if CF spells it."""
    dimension = units.QUANTITY_DIMENSIONS[quantity]
    unit = "N" if dimension == "force" else units.DIMENSIONS[dimension][0] if dimension else udunits(recorded_unit)
    words = "" if quantity == "other" else f"{quantity.replace('_', ' ')}, "
    return Variable(f"{words}channel {channel}", unit, MEASURED)


MEASURED = "physicalMeasurement"
MODELLED = "modelResult"
AUXILIARY = "auxiliaryInformation"
QUALITY = "qualityInformation"
COORDINATE = "coordinate"


class Variable(NamedTuple):
    """
    How one variable is stored and described; empty for what it does not have.

    Attributes
    ----------
    long_name : str
        In words.
    units : str
        UDUNITS spelling; "1" for a number, none for text and flags.
    content : str
        ACDD coverage_content_type.
    standard_name : str
        Where CF has one; rocking has almost none.
    dtype : str
        numpy's name; "str" for text.
    comment : str
        Sign, frame or definition, where the name does not say it.
    stages : tuple of str
        Whose results may have it.
    flags : str
        What its values mean, as ``0=left_out 1=used``.
    """

    long_name: str
    units: str = "1"
    content: str = AUXILIARY
    standard_name: str = ""
    dtype: str = "float64"
    comment: str = ""
    stages: tuple[str, ...] = ()
    flags: str = ""

    def attributes(self) -> dict[str, Any]:
        """CF and ACDD attributes, those that are not given left out."""
        given = self._asdict() | {"coverage_content_type": self.content}
        names = ("long_name", "standard_name", "units", "coverage_content_type", "comment")
        attributes = {name: given[name] for name in names if given[name]}
        if self.flags:
            values, meanings = zip(*(flag.split("=") for flag in self.flags.split()), strict=True)
            attributes |= {"flag_values": np.array(values, dtype=np.int8), "flag_meanings": " ".join(meanings)}
        return attributes


def _variable(row: dict[str, Any]) -> Variable:
    return Variable(**row | {"stages": tuple(row["stages"].split())})


VARIABLES = {row.pop("name"): _variable(row) for row in rows("variables.csv")}
