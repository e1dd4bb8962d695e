"""What the reading process may take, and what it gives up before it opens a file: files, programs, the network."""

from __future__ import annotations

import ctypes
import os
import struct
import sys
import sysconfig
import threading
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import colonnade

MEGABYTE = 1_000_000

MEMORY = 1500 * MEGABYTE
"""Bytes that the reading of the smallest file may take."""
MEMORY_RATIO = 64
"""Bytes more for each byte of the file: two of them become a number of eight, compressed ones many, in a few copies."""
MEMORY_SHARE = 0.75
"""Share of the machine's memory that no reading may exceed, so that it fails before the system stops others."""
SECONDS = 8
"""Processor time that the reading of the smallest file may take."""
BYTES_PER_SECOND = MEGABYTE // 4
"""Bytes of the file that each add a second; the slowest reader, of .ods, is five times as fast."""
PATIENCE = 3.0
"""Longest time that may pass, as a multiple of the processor time, on a machine that does other things too."""


@dataclass(frozen=True)
class Bounds:
    """
    What the reading of one file may take.

    Attributes
    ----------
    memory : int
        Bytes, beyond what the process has before it opens the file.
    processor : int
        s of processor time.
    elapsed : float
        s from the start of the reading to its end.
    """

    memory: int
    processor: int
    elapsed: float


def bounds_of(*paths: Path) -> Bounds:
    """Bounds for a raw file that is in one or several files, by their size; a missing one counts as empty."""
    size = sum(path.stat().st_size for path in paths if path.is_file())
    memory = min(MEMORY + MEMORY_RATIO * size, max(MEMORY, int(MEMORY_SHARE * _machine())))
    processor = SECONDS + size // BYTES_PER_SECOND
    return Bounds(memory, processor, PATIENCE * processor)


def _machine() -> int:
    """Bytes of memory of this machine; a large number where the system does not tell."""
    try:
        return os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
    except (AttributeError, ValueError, OSError):
        return 1 << 62


SYSTEM = (
    *("/usr/lib", "/usr/lib64", "/lib", "/lib64", "/usr/local/lib", "/usr/share/zoneinfo", "/etc/ld.so.cache"),
    *("/etc/localtime", "/dev/urandom", "/proc/self", "/proc/cpuinfo", "/proc/meminfo", "/sys/devices/system/cpu"),
)
"""What libraries read on their way: shared libraries, time zones, the number of cores."""

FORBIDDEN = (
    *("os.system", "os.exec", "os.fork", "os.forkpty", "os.posix_spawn", "os.spawn", "os.startfile", "os.kill"),
    *("os.remove", "os.rename", "os.rmdir", "os.mkdir", "os.truncate", "os.link", "os.symlink", "os.chmod", "os.chown"),
    *("subprocess.Popen", "pty.spawn", "webbrowser.open", "pickle.find_class", "shutil.", "urllib.Request", "ftplib."),
    *("socket.connect", "socket.bind", "socket.sendto", "socket.sendmsg", "socket.getaddrinfo", "socket.gethostbyname"),
)
"""Audit events of Python, or their beginnings, that reading never needs."""

WRITING = os.O_WRONLY | os.O_RDWR | os.O_CREAT | os.O_TRUNC | os.O_APPEND


OUT_OF_MEMORY = 77
"""Exit code of a process that took more memory than it may, where the system has no limit for that."""
OFTEN = 0.1
"""Seconds between two looks at the memory."""


CREATE_RULESET, ADD_RULE, RESTRICT_SELF = 444, 445, 446
"""System calls of Linux's Landlock, by which a process gives up, for good, all files but those that it names."""
ASK_VERSION = 1
PATH_BENEATH = 1
NO_NEW_PRIVILEGES = 38
READ_FILE, READ_DIRECTORY, WRITE_FILE = 1 << 2, 1 << 3, 1 << 1
RIGHTS = ({1: (1 << 13) - 1, 2: (1 << 14) - 1, 3: (1 << 15) - 1, 5: (1 << 16) - 1}, {4: 0b11}, {6: 0b11})
"""All rights that a version of Landlock knows, from that version on: on files; TCP, to bind and connect; abstract
sockets and signals, of processes outside."""


class ForbiddenError(PermissionError):
    """Something that the reading of a file never has to do."""


def enclose(bounds: Bounds, within: Path) -> None:
    """Bind this process for good to a file's bounds and to the files of one folder, besides those of Python itself."""
    limit(bounds)
    readable = [within, *own_folders()]
    with suppress(OSError):  # a kernel that refuses its own rules: what follows holds nevertheless
        restrict(readable)
    watch(readable)


def limit(bounds: Bounds) -> None:
    """Bound memory and processor time from here on; nothing if the system has no such limits."""
    try:
        import resource
    except ImportError:  # Windows
        return
    used = resource.getrusage(resource.RUSAGE_SELF)
    seconds = int(used.ru_utime + used.ru_stime) + bounds.processor
    wanted = {"RLIMIT_CORE": 0, "RLIMIT_FSIZE": 0, "RLIMIT_CPU": seconds, "RLIMIT_DATA": _data() + bounds.memory}
    for name, value in wanted.items():
        kind = getattr(resource, name)
        with suppress(ValueError, OSError):  # where a lower one holds already
            resource.setrlimit(kind, (value, resource.getrlimit(kind)[1]))


def _data() -> int:
    """Bytes of data that this process has; 0 where the system does not tell."""
    with suppress(OSError), Path("/proc/self/status").open(encoding="ascii", errors="replace") as lines:
        for line in lines:
            if line.startswith("VmData:"):
                return 1024 * int(line.split()[1])
    return 0


@contextmanager
def watched_memory(bounds: Bounds) -> Iterator[None]:
    """End this process once it has taken too much memory, for systems on which `limit` cannot bound it."""
    highest, done = _largest() + bounds.memory, threading.Event()

    def look() -> None:
        while not done.wait(OFTEN):
            if _largest() > highest:
                os._exit(OUT_OF_MEMORY)

    threading.Thread(target=look, daemon=True).start()
    try:
        yield
    finally:
        done.set()


def _largest() -> int:
    """Bytes of memory that this process has had at most."""
    if sys.platform == "win32":
        counters = (ctypes.c_size_t * 10)()  # two numbers of four bytes in front, then the largest working set
        counters[0] = ctypes.sizeof(counters)
        process = ctypes.c_void_p(ctypes.windll.kernel32.GetCurrentProcess())
        ctypes.windll.kernel32.K32GetProcessMemoryInfo(process, counters, ctypes.sizeof(counters))
        return int(counters[1])
    import resource

    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * (1 if sys.platform == "darwin" else 1024)


def landlock_version() -> int:
    """Version of Landlock that the kernel has; 0 where it has none."""
    if sys.platform != "linux":
        return 0
    return max(int(_system().syscall(CREATE_RULESET, None, ctypes.c_size_t(0), ctypes.c_uint32(ASK_VERSION))), 0)


def restrict(readable: Iterable[Path]) -> bool:
    """
    Let this thread, and what it starts, read some files and folders, and nothing else: no writing, no programs, no TCP.

    False if the kernel has no Landlock; OSError if it has it and refuses the rules.
    """
    known = landlock_version()
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


def watch(readable: Iterable[Path]) -> None:
    """Refuse to Python code, from here on, all that is forbidden, and every file outside some folders."""
    is_new = not _folders
    _folders[:] = [os.path.realpath(path) for path in readable]
    if is_new:
        sys.addaudithook(_refuse)


_folders: list[str] = []


def _refuse(event: str, arguments: tuple[Any, ...]) -> None:
    if event == "open":
        _expect_reading(arguments[0], arguments[2])
    elif event.startswith(FORBIDDEN):
        raise ForbiddenError(f"{event} was refused: reading never needs it")


def _expect_reading(opened: Any, flags: Any) -> None:
    if not isinstance(opened, (str, bytes, os.PathLike)):
        return  # a number: it is open already
    name = os.fsdecode(opened)
    if name == os.devnull:
        return
    if isinstance(flags, int) and flags & WRITING:
        raise ForbiddenError("writing a file was refused: reading never needs it")
    path = os.path.realpath(name)
    if not any(path == folder or path.startswith(folder.rstrip(os.sep) + os.sep) for folder in _folders):
        raise ForbiddenError("opening a file outside the campaign's folder was refused")


@cache
def own_folders() -> tuple[Path, ...]:
    """Folders that Python and its packages are in."""
    folders = {Path(colonnade.__file__).parents[1], *(Path(each) for each in SYSTEM)}
    folders |= {Path(sysconfig.get_path(name)) for name in ("stdlib", "platstdlib", "purelib", "platlib")}
    folders |= {Path(each) for each in sys.path if each}
    folders |= {Path(each) for each in (sys.prefix, sys.base_prefix) if each not in ("/", "/usr")}
    return tuple(folder for folder in folders if folder != Path(folder.anchor))
