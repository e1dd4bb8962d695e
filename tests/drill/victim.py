"""
Runs to be killed: `python victim.py WARMING`.

The campaign WARMING is run first, so that all is imported and compiled. Then, for each line "FOLDER WORKERS" on stdin,
a process of its own, with a session of its own, gets its workers ready and says "ready PROCESS WORKER ...". At the next
line it runs FOLDER and says "ended", with the reason if it could not. When it is gone, by itself or killed, "gone
STATUS" is said.

Workers are forked here; as colonnade starts them each would take seconds to import, and kills would fall on that.
"""

import os
import sys

from joblib.externals.loky import get_reusable_executor
from joblib.externals.loky.backend.context import set_start_method

from colonnade.errors import ColonnadeError
from colonnade.workflow import run
from colonnade.workflow.executors import spread


def workers_ready(workers):
    """Start the processes that `spread` will find there."""
    if workers == 1:
        return []
    list(spread(abs, range(2 * workers), workers=workers))
    return list(get_reusable_executor(reuse=True)._processes)


def be_killed(folder, workers):
    """Get ready, wait for the word, run."""
    print("ready", os.getpid(), *workers_ready(workers), flush=True)
    sys.stdin.readline()
    try:
        failed = run(folder, workers=workers).failed
        print("ended", "failed" if failed else "", flush=True)
    except ColonnadeError as error:
        print("ended", *str(error).split(), flush=True)
    if workers > 1:
        get_reusable_executor(reuse=True).shutdown(kill_workers=True)  # as at the end of an interpreter


def main(warming):
    """Serve runs until stdin is closed."""
    set_start_method("fork")
    run(warming, workers=1)
    while line := sys.stdin.readline():
        folder, workers = line.rstrip("\n").split("\t")
        child = os.fork()
        if child == 0:
            os.setsid()
            status = 1
            try:
                be_killed(folder, int(workers))
                status = 0
            finally:
                sys.stdout.flush()
                sys.stderr.flush()
                os._exit(status)
        _, status = os.waitpid(child, 0)
        print("gone", os.waitstatus_to_exitcode(status), flush=True)


if __name__ == "__main__":
    main(sys.argv[1])
