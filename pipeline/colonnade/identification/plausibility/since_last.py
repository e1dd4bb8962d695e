"""What changed in a channel since the last test with the same set-up: it died, its noise or its zero is another."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from colonnade.findings import Finding, serious, warning

NOISE_FACTOR = 4.0
"""Noise that differs by more than this between two tests comes from another gain, cable or filter."""

STILL = 3.0
"""A channel that moves by less than this many times its noise does not move."""

ALIVE = 20.0
"""A channel that moves by more than this many times its noise moves."""

WANDERED = 0.25
"""Of the largest motion of both tests: a zero that shifts by more wandered."""


@dataclass(frozen=True)
class ChannelState:
    """
    A channel in one test, in its own SI unit.

    Attributes
    ----------
    zero : float
        Reading at rest.
    noise : float
        Standard deviation at rest.
    motion : float
        Largest magnitude about the zero.
    """

    zero: float
    noise: float
    motion: float

    @property
    def is_still(self) -> bool:
        """Whether it does not move."""
        return self.motion <= STILL * self.noise

    @property
    def is_alive(self) -> bool:
        """Whether it moves beyond doubt."""
        return self.motion > ALIVE * self.noise


def changes(now: Mapping[str, ChannelState], before: Mapping[str, ChannelState], last: str) -> Iterator[Finding]:
    """
    Compare the channels of a test with those of the last test of the same set-up.

    Parameters
    ----------
    now, before : mapping of str to ChannelState
        By channel.
    last : str
        Id of the last test.

    Yields
    ------
    finding : Finding
    """
    something_moves = any(state.is_alive for state in now.values())
    for name in now.keys() & before.keys():
        here, there = now[name], before[name]
        if something_moves and here.is_still and there.is_alive:
            yield serious(
                "dead channel",
                f"Channel {name} does not move, as it did in {last}, while others do. Check its cable and its core.",
            )
        elif there.noise > 0.0 and not 1 / NOISE_FACTOR < here.noise / there.noise < NOISE_FACTOR:
            yield warning(
                "gain",
                f"The noise of channel {name} is {here.noise / there.noise:.2g} times that in {last}. "
                "Was its gain, range or filter changed?",
            )
        elif abs(here.zero - there.zero) > WANDERED * max(here.motion, there.motion):
            share = abs(here.zero - there.zero) / max(here.motion, there.motion)
            yield warning(
                "zero",
                f"The zero of channel {name} moved since {last} by {share:.2g} times its largest motion. Was it moved?",
            )
