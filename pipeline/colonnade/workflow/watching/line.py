"""What is known of a test seconds after its file was finished, in one line and for programs."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from colonnade.campaign.forms.summary import RestitutionSummary, TestSummary, Warned
from colonnade.findings import Finding, Severity, as_record
from colonnade.units.text import interval, listed, number


@dataclass(frozen=True)
class Line:
    """
    What is known of a test that was just recorded.

    Attributes
    ----------
    test : str
        Its id.
    record : TestSummary
        As it will be in the summary, without what takes longer.
    restitution : RestitutionSummary
        The e of its specimen that is known so far.
    limits : mapping of str to float
        A of the limits of the specimen's map at the test's Ω: `no_rocking`, `lower`, `upper`; empty without a map.
    changed : tuple of Finding
        What is other than in the last test with the same set-up.
    seconds : float
        From the last change of its files to this line.
    """

    test: str
    record: TestSummary
    restitution: RestitutionSummary
    limits: Mapping[str, float]
    changed: tuple[Finding, ...]
    seconds: float

    def text(self) -> str:
        """Write it for people."""
        parts = [self._measured(), *self._predicted(), self._place(), self._restitution(), *self._warnings()]
        return f"{self.test}: {'; '.join(filter(None, parts))} ({number(self.seconds, 2)} s)"

    def as_json(self) -> dict[str, Any]:
        """Give it for programs."""
        return {
            "test": self.test,
            "seconds": round(self.seconds, 2),
            **self.record.model_dump(mode="json"),
            "specimen_restitution": self.restitution.model_dump(mode="json"),
            "map_limits": dict(self.limits),
            "changed": [as_record(each) for each in self.changed],
        }

    def _measured(self) -> str:
        record = self.record
        if record.status == "failed":
            return f"failed: {record.reason}"
        peak = "" if record.peak_ratio is None else f", peak {number(record.peak_ratio)} α"
        return f"{record.outcome or 'no rocking angle'}{peak}"

    def _predicted(self) -> list[str]:
        known = {model: each for model, each in self.record.predicted.items() if each.outcome}
        return [
            f"{model}: {each.outcome}" + ("" if each.peak_ratio is None else f", peak {number(each.peak_ratio)} α")
            for model, each in known.items()
        ]

    def _place(self) -> str:
        ratio = self.record.amplitude_ratio
        if ratio is None or self.record.frequency_ratio is None:
            return ""
        place = f"Ω {number(self.record.frequency_ratio)}, A {number(ratio)}"
        lower = self.limits.get("lower")
        return f"{place} (overturns from A {number(lower)} by the map)" if lower is not None else place

    def _restitution(self) -> str:
        found, own = self.restitution, self.record.restitution
        if own is None:
            return ""
        this = f"e {interval(own.value, own.low, own.high, found.level)}" if own.value is not None else "no e"
        why = f" ({own.reason})" if own.value is None and own.reason else ""
        value = found.value if not isinstance(found.value, tuple) else sum(found.value) / len(found.value)
        so_far = interval(value, found.low, found.high, found.level)
        return f"{this}{why}; {self.record.specimen} so far e {so_far} of {len(found.tests)}"

    def _warnings(self) -> list[str]:
        worst: list[Finding | Warned] = [*self.changed]
        worst += [each for each in self.record.warnings if each.severity is not Severity.NOTE and not each.explained]
        shown = [f"{each.severity}: {each.text.rstrip('.')}" for each in worst[:2]]
        return [*shown, f"and {listed([each.kind for each in worst[2:]])}"] if len(worst) > 2 else shown
