import numpy as np
import pytest

from colonnade.dynamics.kinematics import Outline
from colonnade.identification.fusion.sensors import Transducer
from colonnade.identification.fusion.separation import UnseenRotationError, separate
from every import every
from prism import PRISM

OUTLINE = Outline(0.043, 0.043)
X, Y, Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
TOP = Transducer("point", X, (0.043, 0.0, 0.44))
BOTTOM = Transducer("surface", X, (0.043, 0.0, 0.02), normal=X)
LEFT_EDGE, RIGHT_EDGE = Transducer("point", Z, (-0.043, 0.0, 0.0)), Transducer("point", Z, (0.043, 0.0, 0.0))
ACROSS_TOP, ACROSS_BOTTOM = Transducer("point", Y, (0.0, 0.043, 0.44)), Transducer("point", Y, (0.0, 0.043, 0.02))
ACROSS_SIDE = Transducer("point", Y, (0.04, 0.043, 0.44))
BESIDE = Transducer("point", X, (0.043, 0.04, 0.44))
INCLINOMETER = Transducer("angle", Y)


@every(
    ("transducers", "unknowns", "words"),
    [
        ([TOP], ["rocking_angle"], "angle only, from one displacement transducer; slide cannot be separated from it"),
        ([TOP, BOTTOM], ["rocking_angle", "slide"], "angle and slide, from 2 displacement transducers"),
        ([TOP, INCLINOMETER], ["rocking_angle", "slide"], "angle and slide, from 2 transducers"),
        ([TOP, LEFT_EDGE], ["rocking_angle"], "slide and uplift cannot be separated from it and are taken as zero"),
        ([LEFT_EDGE, RIGHT_EDGE], ["rocking_angle", "uplift"], "no transducer measures slide, out-of-plane angle"),
        ([TOP, LEFT_EDGE, RIGHT_EDGE], ["rocking_angle", "slide", "uplift"], "angle, slide and uplift, from 3"),
        ([TOP, ACROSS_TOP], ["rocking_angle", "out_of_plane_angle"], "slide and transverse slide cannot be separated"),
        (
            [TOP, ACROSS_TOP, ACROSS_BOTTOM],
            ["rocking_angle", "out_of_plane_angle", "transverse_slide"],
            "slide cannot be separated from these",
        ),
        ([TOP, ACROSS_TOP, ACROSS_SIDE], ["rocking_angle", "out_of_plane_angle", "yaw"], "transverse slide cannot"),
        ([TOP, BESIDE, BOTTOM], ["rocking_angle", "slide", "yaw"], "angle, slide and yaw"),
    ],
)
def test_what_a_set_up_separates_is_fitted_and_the_rest_is_said(transducers, unknowns, words):
    found = separate(transducers, np.full(len(transducers), 1e-5), PRISM, OUTLINE)
    assert list(found.unknowns) == unknowns
    assert words in found.text


def test_two_heights_that_are_too_close_do_not_separate_slide():
    near = Transducer("point", X, (0.043, 0.0, 0.42))
    found = separate([TOP, near], np.full(2, 1e-5), PRISM, OUTLINE)
    assert found.unknowns == ("rocking_angle",)


@pytest.mark.parametrize(
    ("transducers", "words"),
    [
        ([ACROSS_TOP], "No transducer measures the rotation: each is at the height of the base"),
        ([Transducer("point", X, (0.043, 0.0, 0.0))], "each is at the height of the base"),
        ([LEFT_EDGE], "No transducer measures the rotation at θ < 0"),
        ([RIGHT_EDGE], "No transducer measures the rotation at θ > 0"),
    ],
    ids=["across the plane", "at the base", "left edge alone", "right edge alone"],
)
def test_a_set_up_that_does_not_see_the_rotation_is_refused(transducers, words):
    with pytest.raises(UnseenRotationError, match=words):
        separate(transducers, np.ones(len(transducers)), PRISM, OUTLINE)
