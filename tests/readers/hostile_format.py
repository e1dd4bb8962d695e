"""A format whose reader does what a library might be brought to by a hostile file; a test installs it as a package."""

from __future__ import annotations

import ctypes
import os
import pickle
import socket
import subprocess
import sys
import time
from pathlib import Path

import numpy as np

from colonnade.errors import ReadError
from colonnade.readers.format import Format, Options, Recognition
from colonnade.readers.recording import RecordedChannel, Recording


class Deed(Options):
    """What is done, and to which file."""

    deed: str = ""
    victim: str = ""


class Program:
    """As a pickle may hold one."""

    def __reduce__(self) -> tuple[object, ...]:
        return os.getcwd, ()


def read(path: Path, options: Deed) -> Recording:
    """Do the deed; give back as a value what came of it."""
    came = DEEDS[options.deed](options.victim) if options.deed else os.getpid()
    values = np.array([float(came or 0), float(os.getppid())])
    return Recording(path, "hostile", (RecordedChannel("what came of it", None, values),))


def crash(victim: str) -> None:
    ctypes.string_at(0)


def abort(victim: str) -> None:
    os.abort()


def stumble(victim: str) -> None:
    raise ValueError(f"half a block\nat byte {victim}")


def refuse(victim: str) -> None:
    raise ReadError("free-01.hostile: its rate is 0 Hz. Give sampling_rate.")


def swell(victim: str) -> float:
    return float(np.ones(10**8).sum())


def swell_natively(victim: str) -> float:
    allocate = ctypes.CDLL(None).malloc
    allocate.restype = ctypes.c_void_p
    return float(allocate(ctypes.c_size_t(10**9)) is not None)


def spin(victim: str) -> None:
    while True:
        pass


def sleep(victim: str) -> None:
    time.sleep(1000)


def look(victim: str) -> float:
    return float(len(Path(victim).read_bytes()))


def look_natively(victim: str) -> float:
    return float(ctypes.CDLL(None).open(victim.encode(), os.O_RDONLY))


def write(victim: str) -> float:
    return float(Path(victim).write_text("written"))


def write_natively(victim: str) -> float:
    return float(ctypes.CDLL(None).open(victim.encode(), os.O_WRONLY | os.O_CREAT, 0o600))


def remove(victim: str) -> None:
    Path(victim).unlink()


def spawn(victim: str) -> float:
    return float(subprocess.run([sys.executable, "-c", f"open({victim!r}, 'w')"]).returncode)


def spawn_natively(victim: str) -> float:
    return float(ctypes.CDLL(None).system(f"touch {victim}".encode()))


def call(victim: str) -> None:
    socket.create_connection(("127.0.0.1", int(victim)), timeout=1).close()


def call_natively(victim: str) -> float:
    system = ctypes.CDLL(None)
    address = b"\x02\x00" + int(victim).to_bytes(2, "big") + b"\x7f\x00\x00\x01" + bytes(8)
    return float(system.connect(system.socket(2, 1, 0), address, len(address)))


def unpickle(victim: str) -> float:
    return float(len(pickle.loads(pickle.dumps(Program()))))


def lie(victim: str) -> None:
    for descriptor in range(3, 30):
        try:
            os.write(descriptor, b'{"arrays": [{"dtype": "<f8", "shape": [1000000000000]}]}\n' * 3)
        except OSError:
            continue


def chatter(victim: str) -> None:
    print("a library that prints", flush=True)
    os.write(1, b"and one that writes\n")


DEEDS = {
    deed.__name__: deed
    for deed in (
        *(crash, abort, stumble, refuse, swell, swell_natively, spin, sleep, look, look_natively, write),
        *(write_natively, remove, spawn, spawn_natively, call, call_natively, unpickle, lie, chatter),
    )
}

FORMAT = Format("hostile", "", (".hostile",), lambda path: Recognition(path.suffix == ".hostile", "asked"), read, Deed)
