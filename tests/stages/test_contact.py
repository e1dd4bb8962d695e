"""The law of contact of a specimen, and the bands of its model."""

import numpy as np
import pytest
import xarray as xr

import chain
from colonnade.campaign.settings import ContactSettings
from colonnade.dynamics.block import Block
from colonnade.dynamics.contact.body import ContactLaw, rigid_body
from colonnade.dynamics.contact.calibration import TOLERANCE, VELOCITY_RATIO, free_restitution
from colonnade.dynamics.contact.simulate import simulate
from colonnade.errors import StageError
from colonnade.identification.restitution.identify import identify_restitution
from colonnade.report.specimens_page import law_facts
from colonnade.stages import contact as calibrating
from colonnade.stages import ensemble as running
from colonnade.store.records.stored import Stored
from prism import PRISM

pytestmark = pytest.mark.whole

STEP = 3e-5
SPECIMEN = xr.Dataset({"restitution": ((), 0.976)}, attrs={"restitution_source": "given"})
CYLINDER = Block.cylinder(diameter=0.097, height=0.455, mass=26.30)


def inputs(sizes=(), lowest_amplitude=0.02, **settings):
    settings = ContactSettings(**{"step": f"{STEP} s", **settings})
    given = {"block": PRISM, "shape": "prism", "settings": settings}
    return calibrating.ContactInputs(sizes=sizes, lowest_amplitude=lowest_amplitude, **given)


@pytest.fixture(scope="module")
def law():
    return calibrating.contact(SPECIMEN, inputs())


def free(law, duration):
    of_law = calibrating.law_of(law)
    release = 0.5 * PRISM.critical_angle
    return simulate(rigid_body(PRISM), law=of_law, theta0=release, duration=duration, step=float(law["contact_step"]))


@pytest.fixture(scope="module")
def history(law):
    """A free vibration with this law from the same release, as long: e of this contact falls with the amplitude."""
    return free(law, 5.4)


@pytest.mark.smoke
def test_a_laboratory_identifies_the_e_that_was_asked_for(law, history):
    assert float(law["contact_restitution"]) == pytest.approx(0.976, abs=TOLERANCE)
    every = round(1e-3 / history.time[1])
    time, angle = history.time[::every], history.angle[::every]
    noise = np.random.default_rng(3).normal(0.0, 1e-3 * PRISM.critical_angle, time.size)
    assert identify_restitution(time, angle + noise, PRISM).value == pytest.approx(0.976, abs=3e-4)


def test_the_mean_velocity_ratio_is_another_e_and_is_stored_with_it(law, history):
    ratio = float(law["contact_velocity_ratio"])
    assert ratio == pytest.approx(free_restitution(history), abs=3e-4)
    assert float(law["contact_restitution"]) - ratio > 4e-4


def test_a_law_says_which_e_it_gives(law):
    assert law.attrs["contact_restitution_source"] == calibrating.IDENTIFIED
    # Above so high an amplitude there are too few arcs.
    refused = calibrating.contact(SPECIMEN, inputs(damping_fraction=0.3, lowest_amplitude=0.45))
    assert refused.attrs["contact_restitution_source"] == VELOCITY_RATIO
    assert float(refused["contact_restitution"]) == float(refused["contact_velocity_ratio"])


def test_each_law_keeps_the_modes_that_the_step_follows_with_it():
    read = inputs((("depth", 0.086), ("height", 0.456), ("width", 0.086)), mesh=1224, step="5 us")
    laws = [ContactLaw(damping_fraction=each).bearing(rigid_body(PRISM), PRISM.gravity) for each in (0.1, 2.0)]
    slight, strong = (calibrating.body_of(read, law) for law in laws)
    assert slight.frequencies.size > strong.frequencies.size
    np.testing.assert_array_equal(strong.frequencies, slight.frequencies[: strong.frequencies.size])


def test_mass_weight_and_radius_of_each_ring_are_stored_and_shown():
    given = inputs(damping_fraction=0.3).model_copy(update={"block": CYLINDER, "shape": "cylinder"})
    stored = calibrating.contact(SPECIMEN, given)
    np.testing.assert_allclose(stored["ring_radius"], 0.0485 * np.arange(1, 5) / 4)
    assert float(stored["node_mass"].sum()) == pytest.approx(26.30)
    assert float(stored["node_weight"].sum()) == pytest.approx(26.30 * CYLINDER.gravity)
    shown = dict(law_facts(Stored({("contact", None): stored})))
    assert shown["body"] == "rigid, round base, 4 whole rings"
    assert shown["base nodes"].startswith("4 rings of radius 12.1 to 48.5 mm, ")


RUNS = 4


@pytest.fixture
def shaken_in_space(small_campaign, shaken):
    """Rocking of a shaken test, the law of contact of its specimen, and what the ensemble reads."""
    test = small_campaign.tests["shake-01"]
    settings = ContactSettings.model_validate({"step": "50 us", "damping_fraction": 0.3, "penetration": 1e-5})
    space = calibrating.ContactInputs.of(small_campaign, "prism").model_copy(update={"settings": settings})
    rocking = chain.measured(small_campaign, test, shaken[0])[1]
    read = running.EnsembleInputs.of(small_campaign, test, "contact")
    read = read.model_copy(update={"prediction": read.prediction.model_copy(update={"space": space})})
    return rocking, calibrating.contact(SPECIMEN, space), _set(read, members=RUNS)


def _set(read, **changes):
    """The same inputs with other settings."""
    return read.model_copy(update={"contact": read.contact.model_copy(update=changes)})


def test_only_inputs_that_have_a_range_vary(shaken_in_space):
    rocking, law, read = shaken_in_space
    wide = _set(read, friction=0.3, damping_fraction=0.0, out_of_plane=0.002, members=2)
    ranges = []

    def runs(plan, central):
        ranges.append({name for name, (low, high) in plan.ranges.items() if high > low})
        return running.all_at_once(plan, central)

    running.ensemble(rocking, wide, contact=law, run=runs)
    assert ranges == [{"friction", "out_of_plane"}]


def test_damping_that_the_step_does_not_follow_is_told(shaken_in_space):
    rocking, law, read = shaken_in_space
    stiff = law.assign(contact_stiffness=1e6 * law["contact_stiffness"])
    with pytest.raises(StageError, match=r"processing\.predict\.contact: step is .*; at most"):
        running.ensemble(rocking, read, contact=stiff)
