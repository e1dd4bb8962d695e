"""The package's own sources: which modules a module needs, and a hash of their code without docstrings."""

from __future__ import annotations

import ast
import hashlib
from collections.abc import Collection, Iterable, Iterator
from functools import cache
from pathlib import Path
from typing import Any

PACKAGE = Path(__file__).parent
"""Folder of the package."""

_DATA = (".jinja", ".css", ".js", ".mplstyle", ".typ", ".csv", ".toml")
"""Suffixes of templates, scripts, styles and tables: what they say counts to the byte."""


@cache
def package_hash() -> str:
    """Hash of every source and template of the package, to the byte, as they were when this process first asked."""
    digest = hashlib.sha256()
    for path in sorted(path for path in PACKAGE.rglob("*") if path.suffix in (".py", *_DATA)):
        text = path.read_bytes()
        digest.update(f"{path.relative_to(PACKAGE).as_posix()} {len(text)}\n".encode() + text)
    return digest.hexdigest()


def code_hash(roots: Collection[str], *, alone: Collection[str] = (), without: Collection[str] = ()) -> str:
    """
    Hash the code that a result is made by.

    Parameters
    ----------
    roots : collection of str
        Names of modules, or of folders with all that is in them, such as "colonnade.stages.rocking". What they import
        counts too, directly or not, also inside functions; what they import only to check types does not.
    alone, without : collection of str, optional
        Modules or folders whose own code counts, but not what they import; and those that do not count.

    Returns
    -------
    code : str
        SHA-256 of their statements as written: a docstring, or a blank line or a comment between statements, changes
        nothing. With a room count its templates, scripts, styles and tables.
    """
    reached: set[str] = set()
    waiting = [name for name in _modules() if _is_in(name, roots)]
    while waiting:
        name = waiting.pop()
        if name in reached or _is_in(name, without):
            continue
        reached.add(name)
        if not _is_in(name, alone):
            waiting += _module(name)[1]
    return hashlib.sha256("".join(f"{name} {_module(name)[0]}\n" for name in sorted(reached)).encode()).hexdigest()


def _is_in(name: str, folders: Collection[str]) -> bool:
    return any(name == folder or name.startswith(f"{folder}.") for folder in folders)


@cache
def _modules() -> dict[str, Path]:
    """Files of the package's modules, by name; not the package itself, which only lists names."""
    found = {}
    for path in PACKAGE.rglob("*.py"):
        parts = path.relative_to(PACKAGE.parent).with_suffix("").parts
        found[".".join(parts[:-1] if parts[-1] == "__init__" else parts)] = path
    del found[PACKAGE.name]
    return found


def _statements(body: Iterable[Any]) -> Iterator[Any]:
    """Give statements, also those within others, but what is there only to check types."""
    for node in body:
        is_for_types = isinstance(node, ast.If) and ast.unparse(node.test) == "TYPE_CHECKING"
        if isinstance(node, ast.stmt) and not is_for_types:
            yield node
        for part in ("orelse",) if is_for_types else ("body", "handlers", "cases", "orelse", "finalbody"):
            yield from _statements(getattr(node, part, ()))


@cache
def _module(name: str) -> tuple[str, frozenset[str]]:
    """Hash of what a module does, and the modules of this package that it names, with the rooms around them."""
    path = _modules()[name]
    text = path.read_text(encoding="utf-8")
    said, within, named = set[int](), set[int](), set[str]()
    for node in _statements(ast.parse(text).body):
        lines = range(node.lineno, node.end_lineno + 1)
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant) and type(node.value.value) is str:
            said.update(lines)
        elif not hasattr(node, "body"):
            within.update(lines)
        if isinstance(node, (ast.Import, ast.ImportFrom)):
            start = f"{node.module}." if isinstance(node, ast.ImportFrom) else ""
            named |= {f"{start}{alias.name}" for alias in node.names}
    digest = hashlib.sha256()
    for number, line in enumerate(text.split("\n"), 1):
        if number not in said and (number in within or line.lstrip()[:1] not in ("", "#")):
            digest.update(f"{line}\n".encode())
    if path.name == "__init__.py" and path.parent.parent == PACKAGE:
        for data in sorted(each for each in path.parent.rglob("*") if each.suffix in _DATA):
            digest.update(f"{data.name}\n".encode() + data.read_bytes())
    around = {each.rsplit(".", up)[0] for each in named for up in range(each.count(".") + 1)}
    return digest.hexdigest(), frozenset(around & _modules().keys() - {name})
