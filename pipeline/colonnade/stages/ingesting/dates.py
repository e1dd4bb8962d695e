"""When a test was recorded, as its files say, and whether that is the day that the campaign file gives."""

from __future__ import annotations

from collections.abc import Mapping
from datetime import date, datetime, timedelta

from colonnade.findings import Finding, warning
from colonnade.readers.clock import moment_after
from colonnade.readers.recording import Recording

KIND = "date"
"""Kind of the finding that two dates contradict each other."""

ZONES = (timedelta(hours=-12), timedelta(0), timedelta(hours=14))
"""From UTC to the clocks on the wall anywhere: a file in UTC does not say in which of them the laboratory is."""

NO_ZONE = "no time zone recorded"


def recorded_at(recordings: Mapping[str, Recording], begin: float = 0.0) -> str:
    """
    Write when a test was recorded, by the first recorder whose file says so; empty if none does.

    Parameters
    ----------
    recordings : mapping of str to Recording
    begin : float, optional
        Of the test in its files, s.

    Returns
    -------
    text : str
        ``2013-04-26 10:15:00+02:00``, in the zone of the file; without one, that is said.
    """
    starts = (moment_after(recording.start, begin) for recording in recordings.values())
    return next((_written(start) for start in starts if start is not None), "")


def contradictions(recordings: Mapping[str, Recording], day: date | None, begin: float = 0.0) -> list[Finding]:
    """
    Compare the day of each file with that of the campaign file.

    Parameters
    ----------
    recordings : mapping of str to Recording
    day : date or None
        As campaign.toml gives it; None if it does not.
    begin : float, optional
        Of the test in its files, s.

    Returns
    -------
    findings : list of Finding
        A warning for each file of another day.
    """
    if day is None:
        return []
    found = []
    for recording in recordings.values():
        start = moment_after(recording.start, begin)
        if start is not None and day not in _days(start):
            text = (
                f"{recording.path.name} was recorded on {start.date()} by its own clock ({_written(start)}), but the "
                f"campaign file gives the date {day}. Correct the date, or check that this is the file of the test and "
                "that the recorder's clock was right."
            )
            found.append(warning(KIND, text))
    return found


def _days(start: datetime) -> set[date]:
    """Days that it may have been on the wall."""
    if start.utcoffset() is None or start.utcoffset() != timedelta(0):
        return {start.date()}
    shifted = (moment_after(start, zone.total_seconds()) for zone in ZONES)
    return {moment.date() for moment in shifted if moment is not None}


def _written(start: datetime) -> str:
    text = start.isoformat(" ", "milliseconds" if start.microsecond else "seconds")
    return text if start.tzinfo is not None else f"{text}, {NO_ZONE}"
