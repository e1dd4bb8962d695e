"""The outline of a specimen."""

from __future__ import annotations

import numpy as np
from pydantic import TypeAdapter

from colonnade.campaign.specimen import AnySpecimen
from colonnade.figures.drawing.described import body_of
from colonnade.report.interactive.moving import outline


def corners(**given):
    specimen = TypeAdapter(AnySpecimen).validate_python({"mass": "26 kg", **given})
    return np.array(outline(body_of(specimen, specimen.block(9.81))))


def test_a_prism_is_a_rectangle_of_its_width_and_height():
    found = corners(shape="prism", width="86 mm", depth="50 mm", height="456 mm")
    np.testing.assert_allclose(found, [(-0.043, 0), (-0.043, 0.456), (0.043, 0.456), (0.043, 0)])


def test_a_cylinder_is_as_wide_as_its_diameter():
    found = corners(shape="cylinder", diameter="97 mm", height="455 mm")
    np.testing.assert_allclose(np.ptp(found, axis=0), [0.097, 0.455])


def test_a_cone_is_narrower_at_its_top():
    found = corners(shape="cone", base_diameter="97 mm", top_diameter="75.5 mm", height="480 mm")
    np.testing.assert_allclose(found[:, 0], [-0.0485, -0.03775, 0.03775, 0.0485])


def test_a_measured_specimen_reaches_from_pole_to_pole_with_its_centre_of_mass_in_the_middle():
    found = corners(
        shape="measured", pole_distance="610 mm", critical_angle=["0.21 rad", "0.23 rad"], inertia="41.2 kg m^2"
    )
    poles, heights = 0.61 * np.sin([0.21, 0.23]), 0.61 * np.cos([0.21, 0.23])
    np.testing.assert_allclose(np.ptp(found[:, 0]), poles.sum())
    np.testing.assert_allclose(found[1, 1] / 2, heights.mean())
