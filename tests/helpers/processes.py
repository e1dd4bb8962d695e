"""The command in a process of its own, and what is waited for."""

import subprocess
import sys
import time

from colonnade.errors import StoreError
from colonnade.workflow.lock import only_run


def started(*arguments, **options):
    """Start a command."""
    options = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "encoding": "utf-8"} | options
    return subprocess.Popen([sys.executable, "-m", "colonnade", *map(str, arguments)], **options)


def is_running(layout):
    """Whether a process runs the campaign."""
    try:
        with only_run(layout):
            return False
    except StoreError:
        return True


def wait_until(is_so, seconds=300.0, missing=lambda: "", pause=0.02):
    """Wait until something is so, looking after each pause, and give it; else tell what is missing."""
    until = time.monotonic() + seconds
    while not (found := is_so()):
        assert time.monotonic() < until, missing()
        time.sleep(pause)
    return found
