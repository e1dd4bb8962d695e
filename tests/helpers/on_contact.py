"""Runs of the contact model: where a single body starts on the table, and how high its arcs rise."""

import itertools

import numpy as np

from colonnade.dynamics.contact.start import standing
from colonnade.dynamics.contact.structure import Structure


def alone(body, law, gravity, **tilts):
    """The start of one body that stands on the table, tilted."""
    return standing(Structure.of_body(body, law, gravity), **tilts)[0]


def peaks(angle):
    """Largest |θ| of each arc between two impacts."""
    edges = np.flatnonzero(np.diff(np.sign(angle)))
    return np.array([np.abs(angle[first + 1 : last + 1]).max() for first, last in itertools.pairwise(edges)])
