"""The methods as used: settings stored with the results, gathered over the tests, with wording and literature."""

from __future__ import annotations

import importlib.metadata
import platform
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from math import isfinite, nan
from typing import Any

from colonnade import __version__
from colonnade.store.records.stored import Stored
from colonnade.units import text
from colonnade.units.text import format_percent

LIBRARIES = ("numpy", "scipy", "numba", "xarray", "netCDF4", "pandas", "matplotlib")
"""Libraries whose versions are shown."""

_LONGEST = 6


def _to_a_tenth(share: float) -> str:
    return format_percent(share, 1)


def _range(share: float) -> str:
    return f"± {format_percent(share)}"


_STORED: dict[str, tuple[str, str, str | Callable[[float], str]]] = {
    "spike threshold": ("ingest", "settings.spike_threshold", "{:g} robust standard deviations"),
    "flat duration": ("ingest", "settings.flat_duration", "{:g} s"),
    "gap": ("ingest", "settings.gap", "{:g} sampling intervals"),
    "jitter": ("ingest", "settings.jitter", "{:g} of a sampling interval"),
    "filter order": ("condition", "settings.filter_order", "{:d}"),
    "low-pass rule": ("condition", "settings.lowpass", "{:g} Hz"),
    "base low-pass rule": ("condition", "settings.base_lowpass", "{:g} Hz"),
    "zero": ("condition", "zero", "{}"),
    "rest duration": ("condition", "settings.rest_duration", "{:g} s"),
    "longest offset": ("condition", "settings.longest_offset", "{:g} s"),
    "lowest amplitude": ("restitution", "settings.lowest_amplitude", "{:g} α"),
    "level": ("restitution", "settings.level", format_percent),
    "rest angle": ("predict", "rest_angle", "{:g} α"),
    "mesh": ("predict", "space.settings.mesh", "elastic (about {:d} degrees of freedom)"),
    "contact step": ("predict", "space.settings.step", lambda step: text.quantity(step, "µs")),
    "friction": ("predict", "space.settings.friction", "{:g}"),
    "damping fraction": ("predict", "space.settings.damping_fraction", "{:g}"),
    "initial rotation": ("predict", "space.settings.out_of_plane", "{:g} rad"),
    "runs": ("ensemble", "plane.members", "{:d}"),
    "deviation of e": ("ensemble", "plane.restitution", "{:g}"),
    "deviation of α": ("ensemble", "plane.critical_angle", _to_a_tenth),
    "deviation of p": ("ensemble", "plane.p", _to_a_tenth),
    "deviation of gain": ("ensemble", "plane.gain", _to_a_tenth),
    "deviation of clock": ("ensemble", "plane.clock", "{:g}"),
    "deviation of filter": ("ensemble", "plane.filter", format_percent),
    "horizon": ("ensemble", "measured.horizon", "{:g} α"),
    "deviation of zero": ("ensemble", "measured.angle_zero", "{:g} α"),
    "deviation of angle gain": ("ensemble", "measured.angle_gain", _to_a_tenth),
    "runs in space": ("ensemble", "contact.members", "{:d}"),
    "range of friction": ("ensemble", "contact.friction", _range),
    "range of damping": ("ensemble", "contact.damping_fraction", _range),
    "range of rotation": ("ensemble", "contact.out_of_plane", "± {:g} rad"),
    "range of penetration": ("ensemble", "contact.penetration", _range),
    "misplacement": ("ensemble", "contact.misplacement", lambda place: f"± {text.quantity(place, 'mm')}"),
}
"""Settings by the name that the text uses: stage, path in its inputs, and how the value is written."""


@dataclass
class Used:
    """Values by name, and of each value the tests that were made with it."""

    values: dict[str, dict[str, dict[str, None]]] = field(default_factory=dict)
    versions: dict[str, None] = field(default_factory=dict)

    def gather(self, test: str, stored: Stored) -> None:
        """Take note of what a test's results were made with."""
        for (stage, _), inputs in stored.settings.items():
            for name, (read_by, path, form) in _STORED.items():
                value = _at(inputs, path) if read_by == stage else None
                self._note(name, "" if value is None else _written(value, form), test)
        on_specimen = [name for name, each in _channels(stored).items() if each.get("on") == "specimen"]
        for given in stored.channels.values():
            place = "specimen" if given.get("channel") in on_specimen else "table"
            cutoff = float(given.get("cutoff_hz", nan))
            self._note(f"cut-off on the {place}", text.quantity(cutoff, "Hz") if isfinite(cutoff) else "", test)
        for stage, model in stored.datasets:
            self._note("source of e", stored.text(stage, "restitution_source", model), test)
        if isfinite(stored.value("restitution", "restitution")):
            self._note("method of e", stored.text("restitution", "method"), test)
        self._note("separation", stored.text("rocking", "separation"), test)
        self.versions |= stored.versions

    def add(self, other: Used) -> None:
        """Take over what another has gathered."""
        for name, values in other.values.items():
            for value, tests in values.items():
                self.values.setdefault(name, {}).setdefault(value, {}).update(tests)
        self.versions |= other.versions

    def _note(self, name: str, value: str, test: str) -> None:
        if value:
            self.values.setdefault(name, {}).setdefault(value, {})[test] = None

    def text(self, name: str) -> str:
        """
        Write a value, or those that all tests share; where tests differ, each value with its tests.

        Examples
        --------
        >>> used = Used({"gap": {"1.5": {"a": None, "b": None}, "2": {"c": None}}})
        >>> used.text("gap"), used.text("jitter")
        ('1.5 (a, b) or 2 (c)', '–')
        """
        values = self.values.get(name, {})
        if len({tuple(tests) for tests in values.values()}) < 2:
            return " and ".join(values) or text.NOTHING
        return " or ".join(f"{value} ({text.listed(list(tests), _LONGEST)})" for value, tests in values.items())

    def differing(self) -> list[tuple[str, list[tuple[str, Iterable[str]]]]]:
        """Settings in which tests differ: each value with its tests."""
        return [(name, list(self.values[name].items())) for name in _STORED if len(self.values.get(name, {})) > 1]


def software() -> list[tuple[str, str]]:
    """Name and version of what this page was made with."""
    known = [(name, importlib.metadata.version(name)) for name in LIBRARIES]
    return [("colonnade", __version__), ("Python", platform.python_version()), *known]


def _at(inputs: Mapping[str, Any], path: str) -> Any:
    """Return what is at a dotted path of a stage's inputs; None if it has no such entry."""
    value: Any = inputs
    for key in path.split("."):
        value = value.get(key) if isinstance(value, Mapping) else None
    return value


def _written(value: Any, form: str | Callable[[float], str]) -> str:
    if isinstance(value, str):
        return value
    if isinstance(value, list):
        return f"{value[0]:g} s to {value[1]:g} s"
    return form.format(value) if isinstance(form, str) else form(value)


def _channels(stored: Stored) -> Mapping[str, Mapping[str, Any]]:
    channels: Mapping[str, Mapping[str, Any]] = stored.settings.get(("condition", None), {}).get("channels", {})
    return channels
