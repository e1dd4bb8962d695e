"""Limits for unpacking a compressed file, so that none can exhaust the memory."""

from __future__ import annotations


class UnreadableError(Exception):
    """A part of a file that is whole, but not read; its text is the reason."""


LARGEST = 1 << 28
"""Bytes that a file's variables may unpack to, however small it is."""
LARGEST_RATIO = 100
"""Beyond `LARGEST`, as many times its own bytes."""


def swollen(unpacked: int, packed: int) -> str:
    """
    Say why compressed data is not unpacked; empty if it may be.

    Parameters
    ----------
    unpacked : int
        Bytes that it says it has, with all that was unpacked of the file before.
    packed : int
        Bytes of the file.

    Examples
    --------
    >>> swollen(unpacked=1000, packed=10)
    ''
    """
    if unpacked <= max(LARGEST, LARGEST_RATIO * packed):
        return ""
    return (
        f"{unpacked} bytes would come out of a file of {packed}, more than {LARGEST_RATIO} times as many: it is not "
        "unpacked, because no recording compresses that far"
    )


class Unpacking:
    """
    Bytes that came out of one file so far.

    Parameters
    ----------
    packed : int
        Bytes of the file.
    """

    def __init__(self, packed: int) -> None:
        self._packed, self._unpacked = packed, 0

    def take(self, size: int) -> None:
        """Count what is to be unpacked next; UnreadableError if it would be too much, and then nothing is counted."""
        if reason := swollen(self._unpacked + size, self._packed):
            raise UnreadableError(reason)
        self._unpacked += size
