"""
Errors: what colonnade reports when it cannot continue.

Every message is written for the person in the laboratory: what was found, what was expected, where, what to do.
Each class takes the finished message as its one argument, so that it crosses process borders unchanged.
"""

from __future__ import annotations

import difflib
from collections.abc import Iterable


class ColonnadeError(Exception):
    """
    A problem that the user can fix; its text is shown without a traceback.

    Examples
    --------
    >>> import colonnade
    >>> try:
    ...     colonnade.run("no-such-folder")
    ... except colonnade.ColonnadeError as error:
    ...     print(str(error)[:14])
    no-such-folder
    """


class UnitError(ColonnadeError, ValueError):
    """A quantity or unit in text that cannot be parsed."""


class CampaignError(ColonnadeError):
    """The campaign file or the test log cannot be used; one paragraph per problem."""


class ReadError(ColonnadeError):
    """A raw file cannot be read."""


class StageError(ColonnadeError):
    """A stage refuses a test; the others go on."""


class StoreError(ColonnadeError):
    """A result cannot be written or read back."""


SHORT_OF_MEMORY = (
    "The machine ran out of memory. Finished results are kept. Run again with fewer workers (`--workers 1` uses the "
    "least memory), or close other programs first."
)


class RunEndedError(ColonnadeError):
    """The run that this process works for has ended; it must not write anything."""


_LONGEST = 60
"""Characters of a user's text that a message repeats."""


def quoted(text: str) -> str:
    """
    Put a user's text in quotes, shortened.

    Examples
    --------
    >>> quoted("mm")
    '"mm"'
    """
    return f'"{text}"' if len(text) <= _LONGEST else f'"{text[: _LONGEST - 3]}…"'


def nearest(name: str, valid: Iterable[str]) -> str:
    """
    Hint at the valid name closest to a mistyped one.

    Returns
    -------
    hint : str
        ``' Did you mean "top"?'``, or a list of what exists, or an empty string if nothing exists.

    Examples
    --------
    >>> nearest("tpo", ["top", "bottom"])
    ' Did you mean "top"?'
    """
    names = [str(candidate) for candidate in valid]
    folded = {candidate.casefold(): candidate for candidate in names}
    close = difflib.get_close_matches(name.casefold(), list(folded), n=1, cutoff=0.6)
    if close:
        return f" Did you mean {quoted(folded[close[0]])}?"
    if names:
        listed = ", ".join(map(quoted, names[:12]))
        return f" Choose one of: {listed}{'…' if len(names) > 12 else ''}."
    return ""


def count(amount: int, one: str, several: str = "") -> str:
    """
    Write a number of things.

    Examples
    --------
    >>> count(1, "test"), count(3, "test"), count(0, "test")
    ('1 test', '3 tests', 'no test')
    """
    if amount == 0:
        return f"no {one}"
    return f"{amount} {one if amount == 1 else several or one + 's'}"
