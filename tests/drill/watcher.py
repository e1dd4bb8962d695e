"""
A watch in a process of its own: `python watcher.py CAMPAIGN POLLED`.

Each line is JSON on stdout. With POLLED = 1 the raw folder counts as one on another machine, which gives no events.
"""

import sys

from colonnade.cli import main
from colonnade.workflow.watching import arrivals as folders

if __name__ == "__main__":
    if sys.argv[2] == "1":
        folders._is_remote = lambda folder: True
    main(["watch", sys.argv[1], "--json", "--workers", "2"])
