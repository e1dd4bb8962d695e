"""Peers of the benchmarks: what calls cost beside each other, and heyoka on a rocking block (x = p t, angle over α)."""

import time

import pytest

from prism import PRISM

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


def integrator(forcing, *, is_linearised, restitution, tolerance):
    """
    Give an integrator of (θ/α, its rate by x) that sets its state back at each impact; its first parameter is the side.

    `forcing` makes a/g of the parameters and of x.
    """
    heyoka = pytest.importorskip("heyoka", reason="install the extra bench")
    heyoka.set_logger_level_critical()
    (angle, rate), alpha = heyoka.make_vars("angle", "rate"), PRISM.critical_angle
    side, base = heyoka.par[0], forcing(heyoka)
    turned = alpha * (side - angle)
    bend = angle - side - base / alpha
    if not is_linearised:
        bend = -(heyoka.sin(turned) + base * heyoka.cos(turned)) / alpha

    def impact(integrator, _sign):
        state, pars = integrator.state, integrator.pars
        state[0], state[1], pars[0] = 0.0, restitution * state[1], -pars[0]
        return True

    event = heyoka.t_event(angle, callback=impact, cooldown=1e-6)
    return heyoka.taylor_adaptive([(angle, rate), (rate, bend)], [0.0, 0.0], tol=tolerance, t_events=[event])
