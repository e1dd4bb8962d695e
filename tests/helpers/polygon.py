"""A round base on nodes in place of whole rings, to compare the rings with."""

from dataclasses import replace

import numpy as np


def polygon(body, around):
    """Spread each ring of a body over so many nodes on its circle."""
    turned = 2.0 * np.pi * np.arange(around) / around
    radii, heights = (np.repeat(values, around) for values in (body.ring_radii, body.nodes[:, 2]))
    angles = np.tile(turned, len(body.nodes))
    return replace(
        body,
        nodes=np.column_stack((radii * np.cos(angles), radii * np.sin(angles), heights)),
        node_mass=np.repeat(body.node_mass, around) / around,
        node_area=np.repeat(body.node_area, around) / around,
        ring_radii=np.zeros(len(radii)),
    )
