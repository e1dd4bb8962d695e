"""The command in a process of its own, and what is waited for."""

import subprocess
import sys
import time


def started(*arguments, **options):
    """Start a command."""
    options = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "encoding": "utf-8"} | options
    return subprocess.Popen([sys.executable, "-m", "colonnade", *map(str, arguments)], **options)


def wait_until(is_so, seconds=300.0, missing=lambda: "", pause=0.02):
    """Wait until something is so, looking after each pause, and give it; else tell what is missing."""
    until = time.monotonic() + seconds
    while not (found := is_so()):
        assert time.monotonic() < until, missing()
        time.sleep(pause)
    return found
