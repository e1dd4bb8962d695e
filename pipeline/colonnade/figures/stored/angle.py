"""Picture of the rocking angle alone, with what was done in its title."""

from __future__ import annotations

from colonnade.campaign import Test
from colonnade.campaign.forms.summary import TestSummary
from colonnade.dynamics.block import Block
from colonnade.figures.angle import rocking_angle
from colonnade.figures.files.output import Picture
from colonnade.figures.stored.curves import measured_ratio, predicted_ratios
from colonnade.figures.stored.record import seen
from colonnade.store.records.stored import Stored


def angle(test: Test, record: TestSummary, stored: Stored, block: Block) -> Picture | None:
    """Draw the measured and the predicted angle of a test; None without any."""
    measured, predicted = measured_ratio(stored, block), predicted_ratios(stored, block)
    if measured is None and not predicted:
        return None
    figure = rocking_angle(measured, predicted, title=_title(test, record))
    return Picture(figure, f"angle-{test.id}", f"{test.id}: rocking angle over time", seen(record, stored))


def _title(test: Test, record: TestSummary) -> str:
    """Say what was done as a paper does: Ω and A of a sine, Span of an earthquake."""
    if record.frequency_ratio is not None and record.amplitude_ratio is not None:
        return f"{test.specimen}, Ω = {record.frequency_ratio:.2f}, A = {record.amplitude_ratio:.2f}"
    done = test.id if test.span is None else f"{test.motion or 'earthquake'}, Span {test.span}"
    return f"{test.specimen}, {done}"
