"""The report: one page from the store."""

from __future__ import annotations

from colonnade.report.build import build

__all__ = ["build"]
