"""Identification: what the recordings show of the specimen, on plain arrays."""
