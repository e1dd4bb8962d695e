"""What a call costs, as the benchmarks compare it."""

import time


def seconds_of(function, times):
    """Least processor time of some calls, s, after one that compiles."""
    function()
    spent = []
    for _ in range(times):
        begin = time.process_time()
        function()
        spent.append(time.process_time() - begin)
    return min(spent)
