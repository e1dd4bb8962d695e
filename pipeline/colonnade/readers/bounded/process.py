"""The bounded process, seen from outside: started with the first file, and started again if it ends."""

from __future__ import annotations

import atexit
import errno
import os
import subprocess
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any, TypeVar

import colonnade
from colonnade.errors import ReadError
from colonnade.readers.bounded import messages
from colonnade.readers.bounded.enclosure import MEGABYTE, bounds_of
from colonnade.readers.bounded.messages import Answer, Arrays, BrokenAnswerError, Request

Taken = TypeVar("Taken")

START = 120.0
"""Seconds within which the process has to have imported what it needs."""
ENDING = 5.0
"""Seconds that a process is given to end by itself."""
PIPE = 1 << 20
"""Bytes that the system may hold between the two processes, where it lets itself be asked."""
STOPPED = 128 + 9
"""Exit code of a process that was killed."""

_COMMAND = "import sys; sys.path[:] = sys.argv[1:]; from colonnade.readers.bounded.server import main; main()"
_THREADS = ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS", "NUMEXPR_NUM_THREADS", "NUMEXPR_MAX_THREADS")


def run_bounded(
    function: str,
    path: Path,
    options: dict[str, Any],
    take: Callable[[Any, Arrays], Taken],
    *,
    kind: str,
    within: Path,
    modules: tuple[str, ...] = (),
    others: tuple[Path, ...] = (),
) -> Taken:
    """
    Have a function `module:name` read a file in the bounded process.

    It is called with the path and the options, and returns a header for JSON and arrays; `take` makes what is wanted
    of these, and trusts neither: ValueError if they are not what the function returns. `kind` is what the file is read
    as, `within` the folder whose files may be read, `modules` what the function imports, `others` further files of
    which a part is read. ReadError if the function refuses the file, or reading it crashes, swells or does not end.
    """
    request = Request(
        function=function,
        path=path.absolute(),
        within=within.resolve(),
        options=options,
        kind=kind,
        modules=modules,
        bounds=bounds_of(path, *others),
    )
    answer, arrays = _ask(request)
    if answer.refusal:
        raise _refusal(answer.refusal, answer.error_number)
    try:
        return take(answer.header, arrays)
    except ValueError:
        raise _failure(request) from None


class _Reader:
    """One process that reads."""

    def __init__(self) -> None:
        paths = [*(each for each in sys.path if each), str(Path(colonnade.__file__).parents[1])]
        process = subprocess.Popen(
            [sys.executable, "-P", "-c", _COMMAND, *dict.fromkeys(paths)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            pipesize=2**20,  # where the system has larger ones than 64 kB: long files are passed on faster
            env={**os.environ, **dict.fromkeys(_THREADS, "1"), "MPLBACKEND": "Agg"},
            start_new_session=True,  # Ctrl-C is for the process that asks
            creationflags=getattr(subprocess, "CREATE_NEW_PROCESS_GROUP", 0),
        )
        assert process.stdin is not None
        assert process.stdout is not None
        self.process, self.requests, self.answers, self.is_late = process, process.stdin, process.stdout, False
        with suppress(ImportError, AttributeError, OSError):
            import fcntl

            fcntl.fcntl(self.answers, fcntl.F_SETPIPE_SZ, PIPE)

    def ask(self, request: Request) -> tuple[Answer, Arrays]:
        """Request a file; raises ReadError and ends the process if no answer comes."""
        begun = False
        try:
            with self._deadline(START):
                self.requests.write(request.line())
                self.requests.flush()
                begun = self.answers.readline(len(messages.BEGUN)) == messages.BEGUN
            if begun:
                with self._deadline(request.bounds.elapsed):
                    return messages.receive(self.answers, request.bounds.memory)
        except (OSError, BrokenAnswerError):
            pass  # its exit code says why
        except BaseException:
            self.process.kill()  # what is still to come would be taken for the next answer
            self.end()
            raise
        code = self.end()
        if begun:
            raise _failure(request, errno.ETIMEDOUT if self.is_late else errno.ENOMEM if code == STOPPED else None)
        raise _refusal(
            f"{request.path.name}: the process that reads binary files could not be started, so the file was not "
            "looked at. Run again with less else open.",
            errno.EAGAIN,
        )

    @contextmanager
    def _deadline(self, seconds: float) -> Iterator[None]:
        """End the process if it takes longer."""
        timer = threading.Timer(seconds, self._pass_by)
        timer.daemon = True
        timer.start()
        try:
            yield
        finally:
            timer.cancel()

    def _pass_by(self) -> None:
        self.is_late = True
        self.process.kill()

    def end(self) -> int:
        """Let it end; its exit code, as that of a copy that a signal has ended."""
        for stream in (self.requests, self.answers):
            with suppress(OSError):
                stream.close()
        try:
            code = self.process.wait(ENDING)
        except subprocess.TimeoutExpired:
            self.process.kill()
            code = self.process.wait()
        return code if code >= 0 else 128 - code


_lock = threading.Lock()
_readers: list[_Reader] = []
"""The one process that is there, if it is."""


def _ask(request: Request) -> tuple[Answer, Arrays]:
    with _lock:
        if _readers and _readers[0].process.poll() is not None:
            _readers.pop().end()
        if not _readers:
            _readers.append(_Reader())
        return _readers[0].ask(request)


@atexit.register
def end() -> None:
    """End the process; the next file starts another one."""
    while _readers:
        _readers.pop().end()


def _forget() -> None:
    """Leave the process to the parent of this one, which goes on asking it."""
    global _lock
    _lock = threading.Lock()
    _readers.clear()


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_forget)


def _failure(request: Request, number: int | None = None) -> ReadError:
    """What to say of a file that had no answer, or one that cannot be trusted; a machine that was busy may be why."""
    bounds = request.bounds
    return _refusal(
        f'{request.path.name}: reading it as "{request.kind}" took too much memory (more than '
        f"{bounds.memory // MEGABYTE} MB, or than was free) or time (more than {bounds.processor} s), or crashed the "
        "library that does it. The file is damaged, was cut off, was made to cause this, or is a workbook with a cell "
        "far outside its table. Nothing else was affected. Copy it from the recorder again, export it as text, or run "
        "again with fewer workers.",
        number,
    )


def _refusal(text: str, number: int | None) -> ReadError:
    """Refuse a file; with the machine's error, by number, if that is the cause: after it the file is tried again."""
    refusal = ReadError(text)
    refusal.__cause__ = None if number is None else OSError(number, os.strerror(number))
    return refusal
