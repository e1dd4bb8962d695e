"""Where a single body starts on the table."""

from colonnade.dynamics.contact.start import standing
from colonnade.dynamics.contact.structure import Structure


def alone(body, law, gravity, **tilts):
    """The start of one body that stands on the table, tilted."""
    return standing(Structure.of_body(body, law, gravity), **tilts)[0]
