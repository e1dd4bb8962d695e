"""Criteria of practice for rocking and overturning, and how often they agree with what is computed."""
