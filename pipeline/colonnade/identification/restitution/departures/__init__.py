"""Departures of a free vibration from plane rocking with one e."""
