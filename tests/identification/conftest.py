"""A block that moves, and what its transducers read: written for the tests alone, with nothing of the package in it."""

import numpy as np
import pytest
from scipy.optimize import brentq

HALF_WIDTH = 0.0485
"""Distance of the poles from the centre of the base, m."""


def about(axis, angle):
    """Rotation matrix about x, y or z."""
    cosine, sine = np.cos(angle), np.sin(angle)
    one, two = {"x": (1, 2), "y": (2, 0), "z": (0, 1)}[axis]
    matrix = np.eye(3)
    matrix[one, one] = matrix[two, two] = cosine
    matrix[one, two], matrix[two, one] = -sine, sine
    return matrix


class MovedBlock:
    """
    A block that was turned about its pole by θ, leant about x, turned about z, and shifted.

    The shift is that of the pole along x and z, and of the middle of the base along y.
    """

    def __init__(self, angle, *, lean=0.0, yaw=0.0, slide=0.0, rise=0.0, across=0.0):
        self.matrix = about("z", yaw) @ about("x", lean) @ about("y", angle)
        self.pole = np.array([HALF_WIDTH * (1.0 if angle >= 0 else -1.0), 0.0, 0.0])
        self.shift = np.array([slide, 0.0, rise])
        self.shift[1] = across - (self.matrix @ -self.pole)[1]

    def place(self, point):
        return self.pole + self.shift + self.matrix @ (np.asarray(point) - self.pole)

    def material(self, place):
        return self.pole + self.matrix.T @ (np.asarray(place) - self.pole - self.shift)

    def point(self, at, direction):
        return float(np.dot(direction, self.place(at) - at))

    def wire(self, at, direction, anchor):
        longer = np.linalg.norm(self.place(at) - anchor) - np.linalg.norm(np.subtract(at, anchor))
        return float(longer if np.dot(np.subtract(at, anchor), direction) > 0 else -longer)

    def laser(self, at, direction, surface):
        """Way along the line to where a function of material points is zero, next to where the line was at rest."""

        def outside(way):
            return surface(self.material(np.asarray(at) + way * np.asarray(direction)))

        ways = np.linspace(-1.0, 1.0, 2002)
        signs = np.sign([outside(way) for way in ways])
        outward = np.sign(surface(np.asarray(at) + 1e-4 * np.asarray(direction)))
        crossings = np.flatnonzero((signs[:-1] != outward) & (signs[1:] == outward))
        first = crossings[np.argmin(np.abs(ways[crossings]))]
        return brentq(outside, ways[first], ways[first + 1], xtol=1e-15)

    def laser_on_face(self, at, direction, normal):
        return self.laser(at, direction, lambda point: float(np.dot(normal, point - np.asarray(at))))

    def laser_on_side(self, at, direction, radius, taper=0.0):
        return self.laser(at, direction, lambda point: float(np.hypot(point[0], point[1]) - radius - taper * point[2]))


@pytest.fixture(scope="session")
def moved_block():
    """The class of a block that was turned and shifted; its poles are `HALF_WIDTH` from the centre of its base."""
    return MovedBlock
