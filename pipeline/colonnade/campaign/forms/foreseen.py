"""What the summary says of forecasts: of each test the one that counts, and of all together."""

from __future__ import annotations

from colonnade.campaign.syntax.table import Known, Record


class ForecastScores(Record):
    """Scores of a forecast, the smaller the better; of several tests their means."""

    crps: Known = None
    """Continuous ranked probability score of min(max |θ|, α)/α, in units of α: the main one."""
    ranked_probability: Known = None
    """Of the outcome, 0 to 2."""
    brier: Known = None
    """Of overturning, 0 to 1."""
    logarithmic: Known = None
    """Of overturning, in nats."""


class ForecastOfModel(Record):
    """What one model foresaw, and its scores."""

    no_rocking: float
    """Probability."""
    rocking: float
    """Probability."""
    overturned: float
    """Probability."""
    low: float
    """Lower end of the band that holds 95 % of min(max |θ|, α)/α; 0 does not rock, 1 overturns."""
    high: float
    """Upper end."""
    pit: Known = None
    """Probability integral transform of the measured amplitude, randomised where runs are equal: even if the forecasts
    are right."""
    on_target: ForecastScores | None = None
    """As it was forecast; null before the test, or if it is not scored."""
    on_recorded: ForecastScores | None = None
    """Of the model alone: with its frozen inputs on the base motion that was recorded."""
    rigid_body: ForecastScores | None = None
    """Of the same forecast with the e of a rigid body."""


class TestForecast(Record):
    """The forecast of a test that counts: the last one that is blind, else the last one."""

    file: str
    """In forecasts/."""
    made: str
    """When, UTC."""
    level: str
    """As it was asked for."""
    blind: bool
    """Whether the raw file of the test was not there yet. No other forecast is scored."""
    reason: str | None = None
    """Why it has no scores, or none on the recorded motion."""
    models: dict[str, ForecastOfModel]
    """By model."""


class ForecastCoverage(Record):
    """How often the measured amplitude was in a central band of its forecast."""

    probability: float
    """Of the band."""
    share: float
    """Of the tests."""
    low: float
    """95 % of such shares are between this and `high` if the forecasts are right."""
    high: float
    """See `low`."""


class JudgedForecasts(Record):
    """The scored forecasts of one model together."""

    tests: int
    """Scored tests."""
    on_target: ForecastScores
    """Mean scores as they were forecast."""
    on_recorded: ForecastScores
    """Mean scores of the model alone, of the tests whose base motion was recorded."""
    skill_rigid_body: ForecastScores | None = None
    """1 − score / score with the e of a rigid body: 1 is perfect, 0 no better; null of fewer than 10 tests."""
    skill_base_rate: ForecastScores | None = None
    """The same against the base rate: what was measured in all other scored tests."""
    coverage: tuple[ForecastCoverage, ...] | None = None
    """Of the bands of 50, 80 and 95 %; null of fewer than 10 tests."""


class ForecastEntry(Record):
    """A file in forecasts/."""

    file: str
    """Its name."""
    sha256: str | None = None
    """Hash of its content."""
    test: str | None = None
    """The test that it is for."""
    blind: bool | None = None
    """Whether the raw file of that test was not there when it was made; null if it is for no test of the campaign."""
    scored: bool = False
    """Whether it is the one that is scored."""
    refused: str | None = None
    """Why the file cannot be taken: altered, damaged, a link."""


class ForecastsSummary(Record):
    """All forecasts."""

    count: int
    """Files that can be taken."""
    blind: int
    """Of these, made for a test before its raw file was there."""
    models: dict[str, JudgedForecasts]
    """Scores by model, of one forecast a test."""
    files: tuple[ForecastEntry, ...]
    """In the order in which they were made; those that are refused come last."""
