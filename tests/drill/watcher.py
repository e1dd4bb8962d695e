"""
A watch in a process of its own: `python watcher.py CAMPAIGN POLLED`.

Each line is JSON on stdout. With POLLED = 1 the raw folder gives no events, as one on another machine.
"""

import sys
import time
from contextlib import nullcontext

from colonnade.cli import main
from colonnade.workflow.watching import watch

if __name__ == "__main__":
    if sys.argv[2] == "1":
        watch.listening = lambda folder: nullcontext(time.sleep)
    main(["watch", sys.argv[1], "--json", "--workers", "2"])
