"""Linux's Landlock: a process gives up, for good, all files but those that it names."""

from __future__ import annotations

import ctypes
import os
import struct
import sys
from collections.abc import Iterable
from pathlib import Path

CREATE_RULESET, ADD_RULE, RESTRICT_SELF = 444, 445, 446
"""System calls, the same on every processor."""
ASK_VERSION = 1
PATH_BENEATH = 1
NO_NEW_PRIVILEGES = 38
READ_FILE, READ_DIRECTORY, WRITE_FILE = 1 << 2, 1 << 3, 1 << 1
RIGHTS = ({1: (1 << 13) - 1, 2: (1 << 14) - 1, 3: (1 << 15) - 1, 5: (1 << 16) - 1}, {4: 0b11}, {6: 0b11})
"""All rights that a version of Landlock knows, from that version on: on files; TCP, to bind and connect; abstract
sockets and signals, of processes outside."""


def version() -> int:
    """Version of Landlock that the kernel has; 0 where it has none."""
    if sys.platform != "linux":
        return 0
    return max(int(_system().syscall(CREATE_RULESET, None, ctypes.c_size_t(0), ctypes.c_uint32(ASK_VERSION))), 0)


def restrict(readable: Iterable[Path]) -> bool:
    """
    Let this thread, and what it starts, read some files and folders, and nothing else: no writing, no programs, no TCP.

    Parameters
    ----------
    readable : iterable of Path
        Missing ones are skipped.

    Returns
    -------
    done : bool
        False if the kernel has no Landlock.

    Raises
    ------
    OSError
        If the kernel has it and refuses the rules.
    """
    known = version()
    if not known:
        return False
    system = _system()
    # Older kernels know a shorter list of rights.
    latest = [[bits for since, bits in rights.items() if since <= known] for rights in RIGHTS]
    rules = b"".join(struct.pack("=Q", bits[-1]) for bits in latest if bits)
    ruleset = _checked(system.syscall(CREATE_RULESET, rules, ctypes.c_size_t(len(rules)), ctypes.c_uint32(0)))
    try:
        for path in readable:
            _allow(system, ruleset, path, READ_FILE | (READ_DIRECTORY if path.is_dir() else 0))
        _allow(system, ruleset, Path(os.devnull), READ_FILE | WRITE_FILE)
        nothing = (ctypes.c_ulong(0),) * 3
        _checked(system.prctl(NO_NEW_PRIVILEGES, ctypes.c_ulong(1), *nothing))
        _checked(system.syscall(RESTRICT_SELF, ctypes.c_int(ruleset), ctypes.c_uint32(0)))
    finally:
        os.close(ruleset)
    return True


def _allow(system: ctypes.CDLL, ruleset: int, path: Path, rights: int) -> None:
    try:
        opened = os.open(path, os.O_PATH | os.O_CLOEXEC)
    except OSError:
        return
    try:
        rule, flags = struct.pack("=Qi", rights, opened), ctypes.c_uint32(0)
        _checked(system.syscall(ADD_RULE, ctypes.c_int(ruleset), ctypes.c_int(PATH_BENEATH), rule, flags))
    finally:
        os.close(opened)


def _system() -> ctypes.CDLL:
    return ctypes.CDLL(None, use_errno=True)


def _checked(result: int) -> int:
    if result < 0:
        number = ctypes.get_errno()
        raise OSError(number, os.strerror(number))
    return result
