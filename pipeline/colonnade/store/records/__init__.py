"""The record of a test and of a specimen, taken from the stored results once: all that shows them is a view of it."""
