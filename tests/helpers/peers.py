"""What calls cost beside each other."""

import time

TURN = 0.01
"""s of a function's turn at least: a single short call after another function's would find the caches cold."""


def least_seconds(*functions, rounds):
    """Least processor time of each call, s: in turns, since a processor's clock moves; after one that compiles."""
    for function in functions:
        function()
    least = [float("inf")] * len(functions)
    for _ in range(rounds):
        for number, function in enumerate(functions):
            end = time.process_time() + TURN
            while (begin := time.process_time()) < end:
                function()
                least[number] = min(least[number], time.process_time() - begin)
    return least
