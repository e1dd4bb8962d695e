"""A small undamaged file of every format that is read here, written by the readers' own tests."""

import importlib.util
import sys
from pathlib import Path

import numpy as np

READERS = Path(__file__).parents[1] / "readers"
BY_PACKAGES = ("waveform",)
"""Formats whose parsers are other people's; they are drilled where those live."""


def write(folder):
    """
    Write the files.

    Returns
    -------
    files : dict of str to Path
        By name; the format is the name's first word. A file that belongs to another lies beside it.
    """
    files = {}
    for name, writer in _writers().items():
        place = folder / name.replace(" ", "-")
        place.mkdir(parents=True)
        files[name] = writer(place / "record")
    return files


def format_of(name):
    """Name of the format of a whole file."""
    return name.split()[0]


def _writers():
    instruments, binary, excel = _room("conftest"), _room("test_binary_mutations"), _room("binary/test_excel")
    text, diadem = _room("text/test_delimited_mutations"), _room("binary/test_diadem")
    time = np.arange(40) / 200
    columns = [
        instruments.Column("top", "mm", 10 * np.sin(40 * time)),
        instruments.Column("table", "g", 0.3 * np.cos(30 * time)),
    ]

    def by_instrument(name):
        return lambda path: instruments.WRITERS[name](path.with_suffix(f".{name}"), time, columns)

    def by_binary(name):
        def write_binary(path):
            writer, suffix = binary.WRITERS[name]
            writer(path.with_suffix(suffix))
            return path.with_suffix(suffix)

        return write_binary

    def by_text(separator, decimal, encoding):
        def write_text(path):
            path.with_suffix(".csv").write_bytes(text.undamaged(separator, decimal, encoding))
            return path.with_suffix(".csv")

        return write_text

    rows = [*excel.ROWS, *excel.SAMPLES]
    return {
        "delimited semicolon": by_text(";", ",", "latin-1"),
        "delimited utf-16": by_text(",", ".", "utf-16"),
        "delimited tab": by_text("\t", ".", "utf-8"),
        "excel xlsx": lambda path: excel.xlsx(path.with_suffix(".xlsx"), Blatt=excel.sheet_xml(rows)),
        "excel ods": lambda path: excel.ods(path.with_suffix(".ods"), rows[3:]),
        "excel xls": lambda path: excel.xls(path.with_suffix(".xls"), rows),
        "tdms": by_binary("tdms"),
        "matlab 5 plain": by_binary("matlab 5, plain"),
        "matlab 5 compressed": by_binary("matlab 5, compressed"),
        "matlab 7.3": by_binary("matlab 7.3"),
        "netcdf 4": by_binary("netcdf 4"),
        "netcdf 3": by_binary("netcdf 3"),
        "diadem tdm": lambda path: diadem.tdm(path.parent),
        **{name: by_instrument(name) for name in instruments.WRITERS if name not in BY_PACKAGES},
    }


def _room(name):
    spec = importlib.util.spec_from_file_location(f"readers_{name.replace('/', '_')}", READERS / f"{name}.py")
    if spec is None or spec.loader is None:
        raise ImportError(f"there is no {name}.py in {READERS}")
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    return module
