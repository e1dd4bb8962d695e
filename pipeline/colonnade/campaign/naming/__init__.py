"""Tests found by the names of their raw files."""
