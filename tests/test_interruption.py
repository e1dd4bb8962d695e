"""A signal is noted, whatever becomes of its exception."""

import signal
import subprocess
import sys
import threading
import time

import pytest

from colonnade import interruption


@pytest.fixture(autouse=True)
def nothing_noted(monkeypatch):
    monkeypatch.setattr(interruption, "_noted", [])


def test_a_signal_stops_at_once_and_at_every_point_after():
    with pytest.raises(KeyboardInterrupt):
        interruption.note(signal.SIGTERM, None)
    assert interruption.noted()
    for _ in range(2):
        with pytest.raises(KeyboardInterrupt):
            interruption.expect_none()


@pytest.mark.skipif(not hasattr(signal, "pthread_kill"), reason="signals of this kind are POSIX's")
@pytest.mark.usefixtures("interruptible")
def test_a_signal_is_held_back_whichever_thread_it_is_sent_to():
    waiting, begun, done = threading.Event(), threading.Event(), []
    other = threading.Thread(target=lambda: (begun.set(), waiting.wait()))

    def work(thread):
        with interruption.held_back():
            signal.pthread_kill(thread.ident, signal.SIGINT)
            time.sleep(0.05)
            done.append(thread)

    other.start()  # it has no mask: Python runs the handler in the main thread all the same
    begun.wait()
    try:
        for thread in (threading.main_thread(), other):
            with pytest.raises(KeyboardInterrupt):
                work(thread)
    finally:
        waiting.set()
        other.join()
    assert done == [threading.main_thread(), other]


@pytest.mark.skipif(not hasattr(signal, "pthread_kill"), reason="signals of this kind are POSIX's")
def test_the_trackers_of_a_pool_outlive_a_closed_terminal():
    done = subprocess.run(
        [sys.executable, "-c", CLOSED], capture_output=True, text=True, timeout=60, check=False, start_new_session=True
    )
    assert (done.returncode, done.stderr) == (0, "")


CLOSED = """
import os, signal, time
from joblib.externals.loky.backend import resource_tracker
from colonnade.interruption import held_back

with held_back():  # as a pool is started
    pass
signal.signal(signal.SIGHUP, signal.SIG_IGN)
os.killpg(0, signal.SIGHUP)
time.sleep(0.2)
resource_tracker.ensure_running()  # starts a dead one again, with a warning
"""


@pytest.mark.skipif(not hasattr(signal, "SIGHUP"), reason="signals of this kind are POSIX's")
@pytest.mark.parametrize(
    ("before", "listened_to"),
    [
        ("", ["True"] * 3),
        ("signal.signal(signal.SIGINT, signal.SIG_IGN)", ["True", "False", "True"]),
        ("signal.signal(signal.SIGHUP, signal.SIG_IGN)", ["True", "True", "False"]),
    ],
)
@pytest.mark.usefixtures("interruptible")
def test_a_signal_that_a_shell_ignores_stays_ignored(before, listened_to):
    lines = ["import signal", before, "from colonnade import interruption as i", "i.listen()"]
    lines += ["print(*(signal.getsignal(each) is i.note for each in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP)))"]
    lines += ["i.stop_listening()", "print(signal.getsignal(signal.SIGTERM) == signal.SIG_IGN)"]
    told = subprocess.run([sys.executable, "-c", "\n".join(lines)], capture_output=True, text=True)
    assert told.stdout.split() == [*listened_to, "True"], told.stderr
