"""A virtual shake table: raw campaigns of known truth, in the file formats of real recorders."""

from colonnade.laboratory.programme import paper_programme, prism_programme
from colonnade.laboratory.runs import write_campaign

__all__ = ["paper_programme", "prism_programme", "write_campaign"]
