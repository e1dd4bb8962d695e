"""Assessments of real columns: what they need of a campaign, their histories in blocks, their results."""
