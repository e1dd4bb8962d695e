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


def _dropped(failure: sys.UnraisableHookArgs) -> None:
    """Send a signal again whose exception Python dropped; show other exceptions as usual."""
    if not (_noted and issubclass(failure.exc_type, KeyboardInterrupt)):
        sys.__unraisablehook__(failure)
        return
    again = threading.Timer(_AGAIN, _send, (_noted[-1],))
    again.daemon = True
    again.start()


def stop() -> None:
    """Stop this process in order, from any of its threads: as if SIGTERM came."""
    _send(signal.SIGTERM)


def _send(signum: int) -> None:
    main = threading.main_thread().ident
    if main is not None and hasattr(signal, "pthread_kill"):
        signal.pthread_kill(main, signum)
    else:
        signal.raise_signal(signum)
