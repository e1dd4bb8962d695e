"""Forecasts of tests: made before a test, kept as they were made, scored after it."""
