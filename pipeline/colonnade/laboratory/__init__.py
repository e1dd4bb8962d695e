"""A virtual shake table: raw campaigns of known truth, in the file formats of real recorders."""

from colonnade.laboratory.programme import write_campaign

__all__ = ["write_campaign"]
