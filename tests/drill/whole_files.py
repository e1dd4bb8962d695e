"""A small undamaged file of every format that is read here."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from functools import partial
from pathlib import Path

import h5py
import numpy as np
import scipy.io

from raw_files import COLUMNS, WRITERS, as_matlab_73, tdm
from workbooks import ROWS, SAMPLES, ods, xls, xlsx

EXAMPLES = Path(__file__).parents[2] / "raw_schema" / "examples"
TIME = np.arange(60) * 0.01
TABLE = np.random.default_rng(5).random((60, 3))


def matlab(path: Path, *, compressed: bool) -> None:
    cells = np.empty(2, dtype=object)
    cells[:] = ["text", TIME]
    structs = np.array([(1.0, TIME), (3.0, TIME)], dtype=[("a", object), ("b", object)])
    variables = {"t": TIME, "x": TABLE, "s": {"a": TIME, "n": "text", "c": cells}, "st": structs}
    scipy.io.savemat(path, variables, do_compression=compressed)


def matlab_hdf5(path: Path) -> None:
    with h5py.File(path, "w", userblock_size=512) as file:
        file.create_dataset("t", data=TIME[:, None]).attrs["MATLAB_class"] = np.bytes_("double")
        group = file.create_group("s")
        group.attrs["MATLAB_class"] = np.bytes_("struct")
        group.create_dataset("x", data=TABLE.T, compression="gzip")
        file["c"] = np.array([file["t"].ref, file["s/x"].ref], dtype=h5py.ref_dtype)
    as_matlab_73(path)


def netcdf3(path: Path) -> None:
    with scipy.io.netcdf_file(path, "w") as file:
        file.createDimension("time", 60)
        for name, values in (("time", TIME), ("top", TABLE[:, 0])):
            file.createVariable(name, "f8", ("time",))[:] = values
        file.variables["time"].units = b"s"


def example(path: Path, *, format: str) -> None:
    shutil.copyfile(next((EXAMPLES / format / "raw").iterdir()), path)


def delimited(path: Path, *, separator: str, decimal: str, encoding: str) -> None:
    text = (EXAMPLES / "delimited" / "raw" / "free-01.csv").read_text(encoding="latin-1")
    path.write_bytes(text.replace(",", decimal).replace(";", separator).encode(encoding))


WHOLE: dict[str, tuple[str, Callable[[Path], object]]] = {
    **{
        name: (f".{name}", partial(writer, time=np.arange(40) / 200, columns=COLUMNS))
        for name, writer in WRITERS.items()
    },
    "delimited semicolon": (".csv", partial(delimited, separator=";", decimal=",", encoding="latin-1")),
    "delimited utf-16": (".csv", partial(delimited, separator=",", decimal=".", encoding="utf-16")),
    "delimited tab": (".csv", partial(delimited, separator="\t", decimal=".", encoding="utf-8")),
    "excel xlsx": (".xlsx", lambda path: xlsx(path, Blatt=[*ROWS, *SAMPLES])),
    "excel ods": (".ods", lambda path: ods(path, SAMPLES)),
    "excel xls": (".xls", lambda path: xls(path, [*ROWS, *SAMPLES])),
    "tdms": (".tdms", partial(example, format="tdms")),
    "c3d": (".c3d", partial(example, format="c3d")),
    "matlab 5 plain": (".mat", partial(matlab, compressed=False)),
    "matlab 5 compressed": (".mat", partial(matlab, compressed=True)),
    "matlab 7.3": (".mat", matlab_hdf5),
    "netcdf 4": (".nc", partial(example, format="netcdf")),
    "netcdf 3": (".nc", netcdf3),
    "diadem tdm": (".TDM", tdm),
}
"""By name, of which the first word is the format: the suffix, and what writes it. A companion is beside it."""


def write(name: str, folder: Path) -> Path:
    """Write one of the files into a folder of its own."""
    suffix, writer = WHOLE[name]
    path = folder / name.replace(" ", "-") / f"record{suffix}"
    path.parent.mkdir(parents=True, exist_ok=True)
    writer(path)
    return path


def format_of(name):
    """Name of the format of a whole file."""
    return name.split()[0]
