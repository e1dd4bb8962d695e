"""What a table says of one test: finished text, values with units, dashes for what is not known."""

from __future__ import annotations

from dataclasses import dataclass
from math import nan

from colonnade.campaign import Campaign, Test
from colonnade.identification.verdict import is_within
from colonnade.report import wording
from colonnade.report.agreement import Score
from colonnade.report.results import Message, Results


@dataclass(frozen=True)
class ModelRow:
    """A model and the measurement: outcome, peak ratio and nrmse as text, and how far it agrees."""

    outcome: str
    agrees: bool | None
    peak_ratio: str
    nrmse: str
    score: Score


@dataclass(frozen=True)
class TestRow:
    """
    One test in the tables of all tests.

    Attributes
    ----------
    frequency, frequency_ratio, amplitude_ratio : float
        Of a sine test: Hz, Ω and A; NaN where not known. All else is text for the page.
    order_number : int, str or None
        Order of a sine test's response as the map takes it; `order` is its text.
    excluded : str
        By whom and why the manual review leaves the test out, empty where it does not.
    """

    __test__ = False  # pytest takes a class of this name for a test

    id: str
    kind: str
    specimen: str
    status: str
    failures: tuple[Message, ...]
    warnings: tuple[Message, ...]
    outcome: str
    observed: str
    peak_ratio: str
    peak_ground_acceleration: str
    models: dict[str, ModelRow]
    frequency: float
    frequency_ratio: float
    amplitude_ratio: float
    order: str
    order_number: int | str | None
    reviewed: bool
    excluded: str

    @property
    def has_results(self) -> bool:
        """Whether a measured or predicted outcome is there."""
        return bool(self.outcome or any(row.outcome for row in self.models.values()))

    @property
    def differing(self) -> tuple[str, ...]:
        """Models whose outcome is not the measured (or observed) one."""
        return tuple(model for model, row in self.models.items() if row.agrees is False)


def of_test(campaign: Campaign, test: Test, results: Results) -> TestRow:
    """Put a test's results into words."""
    measured = results.text("rocking", "outcome")
    order = results.text("compare", "response_order")
    frequency, frequency_ratio, amplitude_ratio = _excitation(test, results)
    return TestRow(
        id=test.id,
        kind=test.kind,
        specimen=test.specimen,
        status=results.status,
        failures=results.failures,
        warnings=results.warnings,
        outcome=measured,
        observed=test.observed_outcome or "",
        peak_ratio=wording.number(results.measured_peak(test).ratio),
        peak_ground_acceleration=wording.acceleration(results.value("rocking", "peak_ground_acceleration")),
        models={
            model: _model(test.id, results, model, measured or test.observed_outcome or "")
            for model in campaign.processing.predict.models
        },
        frequency=frequency,
        frequency_ratio=frequency_ratio,
        amplitude_ratio=amplitude_ratio,
        order=wording.order(order),
        order_number=int(order) if order.isdigit() else order or None,
        reviewed=bool(campaign.review(test.id).told),
        excluded=campaign.review(test.id).excluded,
    )


def _model(test: str, results: Results, model: str, measured: str) -> ModelRow:
    stage = f"predict {model}"
    outcome = results.text(stage, "outcome")

    def compared(name: str) -> float:
        return float(results.of("compare", name, "model").get(model, nan))

    agrees, nrmse = wording.agree(measured, outcome), compared("nrmse")
    score = Score(test, agrees, nrmse, is_within(compared("within_spread")))
    ratio = wording.number(results.value(stage, "peak_ratio"))
    return ModelRow(outcome, agrees, ratio, wording.number(nrmse, 2), score)


def _excitation(test: Test, results: Results) -> tuple[float, float, float]:
    """Frequency (Hz), Ω and A of a sine test; the frequency as meant, so that tests meant alike stand together."""
    if test.kind != "sine":
        return nan, nan, nan
    found = [results.value("compare", name) for name in ("forcing_frequency", "frequency_ratio", "amplitude_ratio")]
    frequency, frequency_ratio, amplitude_ratio = (nan if value is None else value for value in found)
    return test.frequency or frequency, frequency_ratio, amplitude_ratio
