"""The package's own sources: which modules a module needs, and a hash of their code without docstrings."""

from __future__ import annotations

import ast
import hashlib
from collections.abc import Collection, Iterator
from functools import cache
from pathlib import Path
from typing import NamedTuple

PACKAGE = Path(__file__).parent
"""Folder of the package."""

_DATA = (".jinja", ".css", ".js", ".mplstyle", ".typ")
"""Suffixes of templates, scripts and styles: what they say counts to the byte."""


class _Module(NamedTuple):
    """Hash of what a module does, and the modules of this package that it names."""

    digest: str
    names: frozenset[str]


def package_hash() -> str:
    """Hash of every source and template of the package, to the byte."""
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
        SHA-256 of the modules as parsed: a comment, a docstring or a blank line changes nothing. With a room count its
        templates, scripts and styles.
    """
    reached: set[str] = set()
    waiting = [name for name in _modules() if _is_in(name, roots)]
    while waiting:
        name = waiting.pop()
        if name in reached or _is_in(name, without):
            continue
        reached.add(name)
        if not _is_in(name, alone):
            waiting += _module(name).names
    digest = hashlib.sha256()
    for name in sorted(reached):
        digest.update(f"{name} {_module(name).digest}\n".encode())
    return digest.hexdigest()


def _is_in(name: str, folders: Collection[str]) -> bool:
    return any(name == folder or name.startswith(f"{folder}.") for folder in folders)


@cache
def _modules() -> dict[str, Path]:
    """Files of the package's modules, by name."""
    found = {}
    for path in PACKAGE.rglob("*.py"):
        parts = path.relative_to(PACKAGE.parent).with_suffix("").parts
        found[".".join(parts[:-1] if parts[-1] == "__init__" else parts)] = path
    return found


@cache
def _module(name: str) -> _Module:
    tree = ast.parse(_modules()[name].read_bytes())
    names = frozenset(known for named in _named(tree) for known in _with_packages(named) if known != name)
    for node in ast.walk(tree):
        if isinstance(node, (ast.Module, ast.ClassDef, ast.FunctionDef)):
            node.body = [each for each in node.body if not _is_text(each)]
    digest = hashlib.sha256(ast.dump(tree).encode())
    for path in _data(_modules()[name]):
        digest.update(f"{path.name}\n".encode() + path.read_bytes())
    return _Module(digest.hexdigest(), names)


def _data(module: Path) -> list[Path]:
    """Templates, scripts and styles of a room: those in its folder, and in folders below that hold no modules."""
    if module.name != "__init__.py" or module.parent == PACKAGE:
        return []
    return sorted(
        path
        for path in module.parent.rglob("*")
        if path.suffix in _DATA and next(folder for folder in path.parents if _is_room(folder)) == module.parent
    )


def _is_room(folder: Path) -> bool:
    return (folder / "__init__.py").exists()


def _is_text(node: ast.stmt) -> bool:
    """Whether a statement is a text alone, such as a docstring."""
    return isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant) and isinstance(node.value.value, str)


def _named(node: ast.AST) -> Iterator[str]:
    """Give each name that is imported, and may be a module's; not what is imported only to check types."""
    if isinstance(node, ast.If) and isinstance(node.test, ast.Name) and node.test.id == "TYPE_CHECKING":
        children: Iterator[ast.AST] = iter(node.orelse)
    else:
        children = ast.iter_child_nodes(node)
    if isinstance(node, ast.Import):
        yield from (alias.name for alias in node.names)
    elif isinstance(node, ast.ImportFrom) and node.module:
        yield from (f"{node.module}.{alias.name}" for alias in node.names)
    for child in children:
        yield from _named(child)


def _with_packages(name: str) -> Iterator[str]:
    """Give the module that a name is, or is of, and the rooms around it; not the package, which only lists names."""
    parts = name.split(".")
    if parts[0] == PACKAGE.name:
        names = (".".join(parts[:count]) for count in range(2, len(parts) + 1))
        yield from (each for each in names if each in _modules())
