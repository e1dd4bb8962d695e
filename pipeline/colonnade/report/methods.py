"""What was really used: the settings stored with the results, gathered over the tests, and the words around them."""

from __future__ import annotations

import importlib.metadata
import platform
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from math import isfinite
from typing import Any

from colonnade import __version__
from colonnade.report import wording
from colonnade.report.results import Results

LIBRARIES = ("numpy", "scipy", "numba", "xarray", "netCDF4", "pandas", "matplotlib")
"""Libraries whose versions are told."""

_LONGEST = 6

_ANY_ENSEMBLE = "any ensemble"

_STORED: dict[str, tuple[str, str, str | Callable[[float], str]]] = {
    "spike threshold": ("ingest", "spike_threshold", "{:g} robust standard deviations"),
    "flat duration": ("ingest", "flat_duration", "{:g} s"),
    "gap": ("ingest", "gap", "{:g} sampling intervals"),
    "jitter": ("ingest", "jitter", "{:g} of a sampling interval"),
    "filter order": ("condition", "filter_order", "{:d}"),
    "low-pass rule": ("condition", "lowpass", "{:g} Hz"),
    "base low-pass rule": ("condition", "base_lowpass", "{:g} Hz"),
    "zero": ("condition", "zero", "{}"),
    "rest duration": ("condition", "rest_duration", "{:g} s"),
    "longest offset": ("condition", "longest_offset", "{:g} s"),
    "lowest amplitude": ("restitution", "lowest_amplitude", "{:g} α"),
    "level": ("restitution", "level", "{:.0%}"),
    "rest angle": ("predict", "rest_angle", "{:g} α"),
    "mesh": ("predict", "mesh", "{}"),
    "contact step": ("predict", "step", lambda step: wording.quantity(step, "µs")),
    "friction": ("predict", "friction", "{:g}"),
    "damping fraction": ("predict", "damping_fraction", "{:g}"),
    "initial rotation": ("predict", "out_of_plane", "{:g} rad"),
    "runs": ("ensemble", "members", "{:d}"),
    "deviation of e": ("ensemble", "restitution", "{:g}"),
    "deviation of α": ("ensemble", "critical_angle", "{:.1%}"),
    "deviation of p": ("ensemble", "p", "{:.1%}"),
    "deviation of gain": ("ensemble", "gain", "{:.1%}"),
    "deviation of clock": ("ensemble", "clock", "{:g}"),
    "deviation of filter": ("ensemble", "filter", "{:.0%}"),
    "horizon": (_ANY_ENSEMBLE, "horizon", "{:g} α"),
    "deviation of zero": (_ANY_ENSEMBLE, "angle_zero", "{:g} α"),
    "deviation of angle gain": (_ANY_ENSEMBLE, "angle_gain", "{:.1%}"),
    "runs in space": ("ensemble contact", "runs", "{:d}"),
    "range of friction": ("ensemble contact", "friction_range", "± {:.0%}"),
    "range of damping": ("ensemble contact", "damping_range", "± {:.0%}"),
    "range of rotation": ("ensemble contact", "out_of_plane_range", "± {:g} rad"),
}
"""Settings by the name that the text uses: stage, key, and how the value is written."""


@dataclass
class Used:
    """Values by name, and of each value the tests that were made with it."""

    values: dict[str, dict[str, dict[str, None]]] = field(default_factory=dict)
    versions: dict[str, None] = field(default_factory=dict)

    def gather(self, test: str, results: Results) -> None:
        """Take note of what a test's results were made with."""
        for name, (stage, key, form) in _STORED.items():
            for stored_stage, settings in results.settings.items():
                # The contact model's ensemble varies other things than those of the plane models.
                own = stored_stage if stored_stage == "ensemble contact" else stored_stage.split()[0]
                is_one = own == stage or (stage == _ANY_ENSEMBLE and stored_stage.startswith("ensemble"))
                value = _within(settings, key) if is_one else None
                if value is not None:
                    self._note(name, _written(value, form), test)
        for given in results.channels.values():
            cutoff = given.get("cutoff_hz")
            if cutoff is not None and isfinite(float(cutoff)):
                place = "specimen" if _is_on_specimen(results, given) else "table"
                self._note(f"cut-off on the {place}", wording.quantity(float(cutoff), "Hz"), test)
        for dataset in results.datasets.values():
            source = dataset.attrs.get("restitution_source")
            if source:
                self._note("source of e", str(source), test)
        method = results.text("restitution", "method")
        if method:
            self._note("method of e", method, test)
        if results.text("rocking", "separation"):
            self._note("separation", results.text("rocking", "separation"), test)
        self.versions |= dict.fromkeys(results.versions)

    def _note(self, name: str, value: str, test: str) -> None:
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
            return " and ".join(values) or wording.NOTHING
        return " or ".join(f"{value} ({wording.listed(list(tests), _LONGEST)})" for value, tests in values.items())

    def differing(self) -> dict[str, Mapping[str, Iterable[str]]]:
        """Settings in which tests differ: each value with its tests."""
        return {name: self.values[name] for name in _STORED if len(self.values.get(name, {})) > 1}


def software() -> list[tuple[str, str]]:
    """Name and version of what this page was made with."""
    known = [(name, importlib.metadata.version(name)) for name in LIBRARIES]
    return [("colonnade", __version__), ("Python", platform.python_version()), *known]


def _within(settings: Mapping[str, Any], key: str) -> Any:
    """Return a setting of this name, wherever a stage keeps it; None where it has none."""
    if key in settings:
        return settings[key]
    for inner in settings.values():
        found = _within(inner, key) if isinstance(inner, dict) else None
        if found is not None:
            return found
    return None


def _written(value: Any, form: str | Callable[[float], str]) -> str:
    if value == "auto":
        return "auto"
    if isinstance(value, list):
        return f"{value[0]:g} s to {value[1]:g} s"
    return form.format(value) if isinstance(form, str) else form(value)


def _is_on_specimen(results: Results, given: Mapping[str, Any]) -> bool:
    channels = results.settings.get("condition", {}).get("channels", {})
    entry = channels.get(given.get("channel"))
    place = entry.get("on") if isinstance(entry, dict) else entry[1] if isinstance(entry, list) else None
    return place == "specimen"
