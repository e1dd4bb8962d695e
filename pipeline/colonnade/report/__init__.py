"""The report: pages from the store."""
