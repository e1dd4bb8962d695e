"""How probably several bodies overturn, or end too far from their places: histories on contact."""

from dataclasses import replace

import numpy as np
import pytest

from colonnade.assessment.cases import OnContact
from colonnade.assessment.measures import intensity_measures
from colonnade.assessment.study import fragility
from colonnade.dynamics.assembly import Assembly
from colonnade.dynamics.block import Block
from colonnade.dynamics.contact.body import ContactLaw
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.plane.run import OVERTURNS, ROCKS
from colonnade.dynamics.rock import rock

DRUM = Block.prism(width=0.2, depth=0.2, height=0.2, mass=20.0)
PILLAR = Block.prism(width=0.1, depth=0.1, height=0.5, mass=10.0)
LAW = ContactLaw(penetration=1e-4, damping_fraction=1.0)
TIME = np.arange(0.0, 1.2, 0.005)


def pulse(frequency):
    """One period of a sine."""
    inside = (TIME > 0.1) & (0.1 + 1 / frequency > TIME)
    return Motion(np.where(inside, np.sin(2 * np.pi * frequency * (TIME - 0.1)), 0.0), 0.005)


@pytest.mark.whole
def test_several_bodies_overturn_or_end_too_far_from_their_places():
    column, motions = Assembly.stack(a=DRUM, b=DRUM, c=DRUM), [pulse(1.7), pulse(2.0)]
    found = fragility(column, motions, levels=[0.6, 2.0], contact=LAW, displaced=1e-3, draws=1, resamples=100)
    assert found.outcomes.overturned[:, :, 0, 0].tolist() == [[False, True], [True, True]]
    factor = 0.6 / intensity_measures(motions[0], measures=["pgv"]).values["pgv"]
    history = rock(column, Motion(factor * motions[0].acceleration, 0.005), model="contact", contact=LAW)
    assert found.outcomes.peak[0, 0, 0, 0] == pytest.approx(history.peak_ratio, rel=1e-6)


@pytest.mark.whole
def test_friction_is_that_of_the_draw():
    column, strong = (
        OnContact(Assembly.stack(a=DRUM, b=DRUM), LAW, displaced=1e-3),
        Motion(3 * pulse(2.0).acceleration, 0.005),
    )
    assert [column.end(strong, friction)[0] for friction in (0.1, np.nan)] == [OVERTURNS, ROCKS]


def test_bodies_that_mirror_each_other_are_run_with_one_sign():
    portal = Assembly.frame(PILLAR, Block.prism(width=1.0, depth=0.1, height=0.1, mass=20.0), span=0.8)
    assert OnContact(portal, LAW).is_symmetric
    aside = {name: replace(body, position=(body.position[0] + 0.1, 0.0)) for name, body in portal.bodies.items()}
    assert not OnContact(Assembly(aside), LAW).is_symmetric


def test_what_is_for_several_bodies_is_refused_for_one_and_the_reverse():
    with pytest.raises(ValueError, match="are for an Assembly; a Block was found"):
        fragility(DRUM, [pulse(1.0)] * 2, displaced=0.01)
    with pytest.raises(ValueError, match="a ContactLaw was expected"):
        fragility(Assembly.stack(a=DRUM, b=DRUM), [pulse(1.0)] * 2, contact="soft")
    with pytest.raises(ValueError, match="levels are needed for several bodies"):
        fragility(Assembly.stack(a=DRUM, b=DRUM), [pulse(1.0)] * 2)
