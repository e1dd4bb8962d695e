"""Results of the library in a line, and in a notebook as a small table."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from html import escape


class Digested(ABC):
    """A result that gives its essence by `digest`: shown by `repr` in a line and by a notebook as a table."""

    @abstractmethod
    def digest(self) -> Mapping[str, str]:
        """Return what is most worth knowing, by name, with units."""

    def __repr__(self) -> str:
        """Write it in a line."""
        said = ", ".join(f"{name} {text}" for name, text in self.digest().items())
        return f"<{type(self).__name__}: {said}>"

    def _repr_html_(self) -> str:
        """Write it as a table; whatever a text holds, it is shown as text."""
        rows = "".join(
            f'<tr><th scope="row" style="text-align: left">{escape(name)}</th><td>{escape(text)}</td></tr>'
            for name, text in self.digest().items()
        )
        return f"<table><caption>{escape(type(self).__name__)}</caption><tbody>{rows}</tbody></table>"


def written(value: float | None, unit: str = "", digits: int = 4) -> str:
    """
    Write a number with its unit; a dash if it is not known.

    Examples
    --------
    >>> written(0.41234, "rad"), written(None)
    ('0.4123 rad', '–')
    """
    return "–" if value is None or value != value else f"{value:.{digits}g} {unit}".rstrip()
