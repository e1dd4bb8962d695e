"""The reading process: takes one request a line from stdin, and answers on what was its stdout."""

from __future__ import annotations

import faulthandler
import json
import os
import select
import signal
import sys
from collections.abc import Callable
from importlib import import_module
from typing import IO, Any

from colonnade.errors import ReadError
from colonnade.readers.bounded import messages
from colonnade.readers.bounded.enclosure import enclose, limit, own_folders, watch, watched_memory
from colonnade.readers.bounded.messages import Arrays, Request
from colonnade.readers.files import refusing

BACKSTOP = 5.0
"""Seconds by which this process outlives its time, if whoever asks does not end it."""
KILLED_WITH_PARENT = 1
"""PR_SET_PDEATHSIG."""


def main() -> None:
    """Serve until the input ends, as it does with the process that asks."""
    sys.dont_write_bytecode = True
    requests = os.fdopen(os.dup(0), "rb")
    answers = os.fdopen(os.dup(1), "wb")
    # A library that prints or reads must not take part in the conversation.
    nothing = os.open(os.devnull, os.O_RDWR)
    for stream in (0, 1):
        os.dup2(nothing, stream)
    serve(requests, answers, in_a_fork if sys.platform == "linux" else in_place)


def serve(requests: IO[bytes], answers: IO[bytes], handle: Callable[[Request, IO[bytes], IO[bytes]], None]) -> None:
    """Handle one request after the other; what their formats need is imported here, once, before any file is opened."""
    from colonnade.readers.registry import formats

    own_folders()
    formats()
    while line := requests.readline():
        request = Request.model_validate(json.loads(line))
        for module in (request.function.partition(":")[0], *request.modules):
            import_module(module)
        handle(request, requests, answers)


def in_a_fork(request: Request, requests: IO[bytes], answers: IO[bytes]) -> None:
    """
    Handle a request in a copy of this process, which gives up all but the campaign's files and ends with it.

    If the copy fails, this process ends with its exit code: half an answer would run into the next one.
    """
    own = os.getpid()
    ended, alive = os.pipe()
    copy = os.fork()
    if not copy:
        try:
            _end_with(own)
            requests.close()
            enclose(request.bounds, request.within)
            _handle(request, answers)
        except BaseException:
            os._exit(1)
        os._exit(0)
    os.close(alive)
    poll = select.poll()
    for descriptor in (ended, requests.fileno()):
        poll.register(descriptor, 0)  # the other end was closed; the next request may be there already
    if ended not in {descriptor for descriptor, _ in poll.poll()}:  # nobody is left who asks
        os.kill(copy, signal.SIGKILL)
        os._exit(1)
    os.close(ended)
    if code := os.waitstatus_to_exitcode(os.waitpid(copy, 0)[1]):
        os._exit(code if code >= 0 else 128 - code)


def in_place(request: Request, requests: IO[bytes], answers: IO[bytes]) -> None:
    """Handle a request in this process, where a system has no safe copies of one."""
    limit(request.bounds)
    watch([request.within, *own_folders()])
    with watched_memory(request.bounds):
        _handle(request, answers)


def _handle(request: Request, answers: IO[bytes]) -> None:
    # Ends this process even where a library never gives control back, and where nobody is left who could.
    faulthandler.dump_traceback_later(request.bounds.elapsed + BACKSTOP, exit=True, file=2)
    answers.write(messages.BEGUN)
    answers.flush()
    arrays, answer = _answer(request)
    messages.send(answers, arrays, **answer)
    faulthandler.cancel_dump_traceback_later()


def _answer(request: Request) -> tuple[Arrays, dict[str, Any]]:
    module, _, name = request.function.partition(":")
    try:
        with refusing(request.path, f'"{request.kind}"'):
            header, arrays = getattr(import_module(module), name)(request.path, **request.options)
        return arrays, {"header": header}
    except ReadError as error:
        cause: Any = error.__cause__
        return [], {"refusal": str(error), "error_number": cause.errno if isinstance(cause, OSError) else None}


def _end_with(parent: int) -> None:
    """Have the system end this process when its parent ends."""
    import ctypes

    ctypes.CDLL(None).prctl(KILLED_WITH_PARENT, ctypes.c_ulong(signal.SIGKILL), *(ctypes.c_ulong(0),) * 3)
    if os.getppid() != parent:
        os._exit(1)
