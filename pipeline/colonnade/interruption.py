"""
Ctrl-C, SIGTERM and SIGHUP, noted when they arrive.

Python raises KeyboardInterrupt wherever its main thread is. In a callback or a finaliser it prints the exception and
goes on, and a compiled module may make another exception of it. So the signal is noted too: it is sent again if Python
says that it dropped the exception, and work asks at each point where it can stop.
"""

from __future__ import annotations

import signal
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

_AGAIN = 0.1
"""Seconds after which a signal whose exception was dropped is sent again: out of the callback by then."""

_noted: list[int] = []
"""Signals in the order in which they came."""


FROM_TERMINAL = frozenset({signal.SIGINT, getattr(signal, "SIGHUP", signal.SIGINT)})
"""Signals that a terminal sends to all processes of a command, and that a shell or `nohup` may have ignored."""


def listen() -> None:
    """Note SIGTERM, and those of `FROM_TERMINAL` that are not ignored; all raise KeyboardInterrupt."""
    for signum in {signal.SIGTERM, *FROM_TERMINAL}:
        if signum == signal.SIGTERM or signal.getsignal(signum) is not signal.SIG_IGN:
            signal.signal(signum, note)
    sys.unraisablehook = _dropped


def stop_listening() -> None:
    """Ignore what comes from here on: the process ends."""
    for signum in {signal.SIGTERM, *FROM_TERMINAL}:
        signal.signal(signum, signal.SIG_IGN)


def note(signum: int, frame: FrameType | None) -> None:
    """
    Note a signal.

    Raises
    ------
    KeyboardInterrupt
        Always.
    """
    _noted.append(signum)
    raise KeyboardInterrupt


def noted() -> bool:
    """Whether a signal came, even if its exception was lost."""
    return bool(_noted)


def answered() -> None:
    """Take what was noted for done: the command ends in its own way, and nothing is sent again."""
    _noted.clear()


def expect_none() -> None:
    """
    Stop here if a signal came: called between two pieces of work.

    Raises
    ------
    KeyboardInterrupt
        If one was noted.
    """
    if _noted:
        raise KeyboardInterrupt


@contextmanager
def held_back() -> Iterator[None]:
    """
    Keep signals from what must not be torn in two; they are sent again at its end.

    Processes that are started here do not get those of `FROM_TERMINAL` at all: they would be torn from their imports.
    The mask alone is not enough: it holds for this thread only, and Python runs handlers in its main thread whichever
    thread was sent the signal.
    """
    came: list[int] = []
    handlers = {
        signum: signal.signal(signum, lambda signum, frame: came.append(signum))
        for signum in {signal.SIGTERM, *FROM_TERMINAL}
        if threading.current_thread() is threading.main_thread() and callable(signal.getsignal(signum))
    }
    before = _masked()
    try:
        yield
    finally:
        if before is not None:
            signal.pthread_sigmask(signal.SIG_SETMASK, before)
        for signum, handler in handlers.items():
            signal.signal(signum, handler)
        for signum in came[:1]:
            _send(signum)


def _masked() -> set[signal.Signals | int] | None:
    """Mask the signals of a terminal in this thread; its mask before that, None where there are no masks."""
    if not hasattr(signal, "pthread_sigmask"):
        return None
    from multiprocessing import resource_tracker

    from joblib.externals.loky.backend import resource_tracker as of_loky

    before = signal.pthread_sigmask(signal.SIG_BLOCK, FROM_TERMINAL)
    for tracker in (resource_tracker, of_loky):  # which must outlive a closed terminal: it does not ignore SIGHUP
        tracker.ensure_running()
    signal.pthread_sigmask(signal.SIG_BLOCK, FROM_TERMINAL)  # again: a tracker's start lets Ctrl-C through
    return before


def _dropped(failure: sys.UnraisableHookArgs) -> None:
    """Send a signal again whose exception Python dropped; show other exceptions as usual."""
    if not (_noted and issubclass(failure.exc_type, KeyboardInterrupt)):
        sys.__unraisablehook__(failure)
        return
    again = threading.Timer(_AGAIN, _send_unanswered)
    again.daemon = True
    again.start()


def _send_unanswered() -> None:
    if _noted:
        _send(_noted[-1])


def _send(signum: int) -> None:
    main = threading.main_thread().ident
    if main is not None and hasattr(signal, "pthread_kill"):
        signal.pthread_kill(main, signum)
    else:
        signal.raise_signal(signum)
