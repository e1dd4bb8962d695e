"""The report: pages from the store."""

from __future__ import annotations

from colonnade.report.build import build

__all__ = ["build"]
