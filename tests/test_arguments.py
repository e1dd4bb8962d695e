"""Every argument of every public call refuses what it is not made for, with a ValueError that names it."""

import inspect
import re
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
import pytest

import colonnade
from colonnade.dynamics.contact.body import ContactLaw
from prism import PRISM

TIME = np.arange(0.0, 4.0, 0.01)
MOTION = colonnade.Motion(3.0 * np.sin(10.0 * TIME), 0.01)
HISTORY = colonnade.rock(PRISM, MOTION)
LAW = colonnade.RestitutionLaw([0.0, 1.0], [1.0, 0.9])
SURE = colonnade.Uncertainty()
ENSEMBLE = colonnade.ensemble(PRISM, MOTION, uncertainty=SURE, count=2)
ASKED = {"block": PRISM, "motions": [MOTION, MOTION], "measure": "pga", "measures": ["pga"]}
ASKED |= {"levels": [1.0, 4.0, 9.0], "draws": 1, "resamples": 20}

DAY = np.datetime64("2024-01-01")
NUMBERS = {
    "text": "1.0",
    "not a number": np.nan,
    "infinite": np.inf,
    "complex": 1.0 + 0.0j,
    "a date": DAY,
    "masked": np.ma.masked,
    "an array": np.array([1.0, 2.0, 3.0]),
    "a list": [1.0],
    "true": True,
    "too large an integer": 10**400,
    "an object": object(),
}
"""What is no number."""

ARRAYS = {
    "masked": np.ma.masked_array([0.1, 0.2, 0.3, 0.4], mask=[False, True, False, False]),
    "complex": np.full(4, 0.1 + 0.1j),
    "dates": np.array([DAY, DAY + 1, DAY + 2, DAY + 3]),
    "text": np.array(["a", "b", "c", "d"]),
    "truth values": np.array([True, False, True, False]),
    "objects": np.array([0.1, None, 0.3, 0.4], dtype=object),
    "a ragged list": [[0.1], [0.2, 0.3]],
    "infinite": np.array([0.1, np.inf, 0.3, 0.4]),
    "four dimensions": np.zeros((1, 2, 1, 2)),
    "an object": object(),
}
"""What is no array of numbers."""

OBJECTS = {"text": "x", "a number": 1.0, "an array": np.zeros(3), "an object": object(), "none": None}
"""What is no object of ours, no path and no name."""

NAMES = {"a number": 1.0, "an array": np.zeros(3), "an object": object(), "true": True}
"""What is no text."""

FOR = {
    "number": NUMBERS,
    "positive": NUMBERS | {"zero": 0.0, "negative": -1.0},
    "deviation": NUMBERS | {"negative": -1.0},
    "share": NUMBERS | {"zero": 0.0, "one": 1.0, "two": 2.0, "negative": -1.0},
    "whole": NUMBERS | {"zero": 0, "negative": -1, "a broken number": 1.5, "endless": 10**300},
    "seed": NUMBERS | {"negative": -1, "a broken number": 1.5},
    "sided": NUMBERS | {"a pair with text": (0.1, "x"), "three": (0.1, 0.1, 0.1), "a negative pair": (-0.1, 0.1)},
    "e": NUMBERS | {"above one": 1.1, "a pair with NaN": (0.9, np.nan), "three": (0.9, 0.9, 0.9)},
    "array": ARRAYS,
    "object": OBJECTS,
    "object or none": {name: value for name, value in OBJECTS.items() if name != "none"},
    "name": NAMES,
    "path": NAMES,
    "flag": {"text": "yes", "a number": 1.0, "none": None, "an array": np.zeros(2)},
    "names": {"text alone": "p", "a number": 1.0, "another name": ("width",), "a list of numbers": [1.0]},
    "ids": {"a number": 1.0, "a list of numbers": [1.0], "an object": object()},
    "function": {"text": "x", "a number": 1.0, "an array": np.zeros(2)},
    "duration": NUMBERS | {"zero": 0.0, "negative": -1.0, "endless": 1e300, "none": None},
    "cycles": NUMBERS | {"endless": 1e12, "negative": -1.0},
    "columns": {"zero": 0, "negative": -1, "a broken number": 1.5, "true": True, "an array": np.zeros(2)},
    "limits": {name: value for name, value in NUMBERS.items() if name != "an array"} | {"falling": (0.9, 0.8)},
    "fine": NUMBERS | {"too fine to end": 1e-300, "negative": -1.0},
}
"""Hostile values by what an argument is."""


# What is not finite counts as missing, or as beyond all others.
FOR["ranked"] = {name: value for name, value in ARRAYS.items() if name != "infinite"}
FOR["a coefficient"] = {name: value for name, value in FOR["deviation"].items() if name != "infinite"}

ARGUMENTS = {
    argument: kind
    for kind, arguments in {
        "positive": "mass gravity width depth height diameter base_diameter top_diameter dt cutoff "
        "span spacing drift restitution_freedom lowpass largest overturned",
        "deviation": "p gain angle_gain clock noise filter lowest_amplitude beam_mass beam_ratio",
        "number": "theta0 omega0 phase",
        "sided": "critical_angle pole_distance inertia",
        "share": "level probability share",
        "whole": "columns filter_order count draws resamples workers",
        "seed": "seed",
        "e": "restitution",
        "array": "correlations acceleration vertical transverse speeds values speed levels time "
        "frequency_ratio amplitude_ratio at direction period position",
        "ranked": "angle base_acceleration out_of_plane slide displacements",
        "object": "beam blocks bodies other block motion motions negative positive side uncertainty history",
        "object or none": "solid hazard contact",
        "name": "model pulse measure baseline unit layout until start_from scheduler",
        "names": "measures",
        "ids": "only on",
        "path": "path campaign results",
        "flag": "at_rest verify awaiting",
        "function": "progress",
        "duration": "duration",
        "cycles": "cycles ramp",
        "columns": "column",
        "limits": "restitution_range critical_angle_range p_range friction_range",
        "fine": "edge rest_angle",
        "a coefficient": "displaced",
    }.items()
    for argument in arguments.split()
}
"""What an argument is, by its name."""

UNLIKE = {
    "Assembly.colonnade": {"column": "object"},
    "Assembly.frame": {"column": "object"},
    "AssemblyHistory.horizon": {"share": "positive"},
    "Block.frame": {"column": "object", "columns": "whole"},
    "Uncertainty": dict.fromkeys(("restitution", "critical_angle", "theta0"), "deviation"),
    "intensity_measures": {"block": "object or none"},
    "overturning_spectrum": {"width": "fine"},
    "rock": {"motion": "object or none", "out_of_plane": "number"},
    "rocking_spectrum": {"critical_angle": "array"},
    "stability_map": {"width": "fine"},
}
"""What it is in these calls."""


class Call(NamedTuple):
    """A public call: the function, and arguments with which it succeeds."""

    function: Callable[..., Any]
    sound: dict[str, Any]

    @property
    def arguments(self):
        return inspect.signature(self.function).parameters


SIZES = {"height": 0.5, "mass": 20.0}
ANGLES = {"angle": [-0.1, 0.1]}
TABLE = {"speeds": np.array([0.0, 0.5, 1.0, 2.0]), "values": np.full(4, 0.9)}
SIDES = {"negative": PRISM.negative, "positive": PRISM.positive}

DRUM = colonnade.Block.cylinder(diameter=0.3, height=0.2, mass=34.0)
BEAM = colonnade.Block.prism(width=1.3, depth=0.3, height=0.2, mass=190.0)
STOOD = colonnade.rock(colonnade.Assembly.stack(drum=DRUM), model="contact", duration=0.001)

CALLS = {
    "Assembly": Call(colonnade.Assembly, {"bodies": {"drum": colonnade.Placed(DRUM)}}),
    "Assembly.stack": Call(colonnade.Assembly.stack, {"blocks": DRUM}),
    "Assembly.frame": Call(colonnade.Assembly.frame, {"column": DRUM, "beam": BEAM, "span": 1.0}),
    "Assembly.colonnade": Call(
        colonnade.Assembly.colonnade, {"column": DRUM, "beam": BEAM, "columns": 3, "spacing": 1.3}
    ),
    "AssemblyHistory.horizon": Call(STOOD.horizon, {"other": STOOD}),
    "Placed": Call(colonnade.Placed, {"block": DRUM}),
    "Block": Call(colonnade.Block, {"mass": 1.0, "gravity": 9.81} | SIDES),
    "Block.prism": Call(colonnade.Block.prism, {"width": 0.1, "depth": 0.1} | SIZES),
    "Block.cylinder": Call(colonnade.Block.cylinder, {"diameter": 0.1} | SIZES),
    "Block.cone": Call(colonnade.Block.cone, {"base_diameter": 0.1, "top_diameter": 0.05} | SIZES),
    "Block.measured": Call(
        colonnade.Block.measured, {"mass": 20.0, "pole_distance": 0.5, "critical_angle": 0.2, "inertia": 7.0}
    ),
    "Block.frame": Call(colonnade.Block.frame, {"column": PRISM, "beam_mass": 10.0, "columns": 2}),
    "Block.override": Call(PRISM.override, {}),
    "Block.critical_angle_at": Call(PRISM.critical_angle_at, ANGLES),
    "Block.p_at": Call(PRISM.p_at, ANGLES),
    "Block.side_p": Call(PRISM.side_p, {"side": PRISM.negative}),
    "Motion": Call(colonnade.Motion, {"acceleration": [0.0, 1.0, 2.0, 0.0], "dt": 0.01}),
    "RestitutionLaw": Call(colonnade.RestitutionLaw, TABLE),
    "RestitutionLaw.__call__": Call(LAW, {"speed": 0.5}),
    "Uncertainty": Call(colonnade.Uncertainty, {"cutoff": 10.0}),
    "ensemble": Call(colonnade.ensemble, {"block": PRISM, "motion": MOTION, "uncertainty": SURE, "count": 1}),
    "Ensemble.horizon": Call(ENSEMBLE.horizon, {"width": 0.1}),
    "identify_restitution": Call(
        colonnade.identify_restitution, {"time": TIME[:4], "angle": np.zeros(4), "block": PRISM}
    ),
    "intensity_measures": Call(colonnade.intensity_measures, {"motion": MOTION}),
    "overturning_spectrum": Call(
        colonnade.overturning_spectrum, {"block": PRISM, "pulse": "sine", "frequency_ratio": [2.0, 3.0], "largest": 2.0}
    ),
    "fragility": Call(colonnade.fragility, ASKED),
    "Fragility.reaches": Call(colonnade.fragility(**ASKED).reaches, {"probability": 0.5}),
    "rocking_spectrum": Call(
        colonnade.rocking_spectrum, {"motion": MOTION, "critical_angle": [0.2, 0.3], "period": [1.0, 2.0]}
    ),
    "reactions": Call(colonnade.reactions, {"history": HISTORY, "motion": MOTION}),
    "read_motion": Call(colonnade.read_motion, {"path": "motion.txt"}),
    "rock": Call(colonnade.rock, {"block": PRISM, "duration": 0.1}),
    "rocking_angle": Call(
        colonnade.rocking_angle,
        {"displacements": [0.0, 0.001], "at": [0.04, 0.0, 0.4], "direction": [1.0, 0.0, 0.0], "block": PRISM},
    ),
    "run": Call(colonnade.run, {"campaign": "nowhere"}),
    "stability_map": Call(
        colonnade.stability_map,
        {"block": PRISM, "frequency_ratio": [2.0, 3.0, 4.0, 5.0], "amplitude_ratio": [0.5, 0.6, 0.7, 0.8]},
    ),
}

GIVEN_BACK = {
    "AssemblyHistory",
    "Ensemble",
    "Fragility",
    "History",
    "IntensityMeasures",
    "OverturningSpectrum",
    "Reactions",
}
GIVEN_BACK |= {"Restitution", "RockingSpectrum", "StabilityMap"}
"""Results: nobody makes them from arguments; what their methods take is checked."""

NOT_CALLED = {"__version__", "ColonnadeError", "animate", "plot"}
"""`animate` and `plot` take results alone: tests/figures/test_plot.py."""


def public():
    """Everything that a user calls: functions, classes and their methods that take arguments."""
    for name in set(colonnade.__all__) - NOT_CALLED:
        thing = getattr(colonnade, name)
        if not inspect.isclass(thing):
            yield name, thing
            continue
        if name not in GIVEN_BACK:
            yield name, thing
        for method, function in inspect.getmembers(thing, callable):
            is_public = not method.startswith("_") or (method == "__call__" and "__call__" in vars(thing))
            if is_public and len(inspect.signature(function).parameters) > (not inspect.ismethod(function)):
                yield f"{name}.{method}", function


def fault(call, argument, told, value):
    """Give what is wrong with how a call takes a hostile value; None if it refuses it by its name."""
    try:
        call.function(**(call.sound | {argument: value}))
    except ValueError as refusal:
        named = re.search(rf"\b{argument}\b", str(refusal))
        return None if named else f"{argument}, {told}: the refusal does not name it: {refusal}"
    except Exception as error:
        return f"{argument}, {told}: {type(error).__name__} in place of a ValueError: {error}"
    return f"{argument}, {told}: not refused"


@pytest.mark.parametrize("name", sorted(CALLS))
def test_hostile_arguments_are_refused_by_their_names(name):
    call = CALLS[name]
    faults = [
        fault(call, argument, told, value)
        for argument in call.arguments
        for told, value in FOR[UNLIKE.get(name, {}).get(argument, ARGUMENTS[argument])].items()
    ]
    assert not [each for each in faults if each]


def test_no_public_call_and_none_of_its_arguments_is_left_out():
    found = dict(public())
    assert found.keys() == CALLS.keys()
    for name, function in found.items():
        assert CALLS[name].arguments.keys() == inspect.signature(function).parameters.keys() - {"self"}, name
    assert {argument for call in CALLS.values() for argument in call.arguments} == ARGUMENTS.keys()


@pytest.mark.parametrize("name", sorted(CALLS.keys() - {"read_motion", "run"}))
def test_the_same_call_succeeds_with_sound_arguments(name):
    CALLS[name].function(**CALLS[name].sound)


def test_times_are_no_accelerations():
    acceleration = 3.0 * np.sin(10.0 * TIME)
    with pytest.raises(ValueError, match=r"dt is an array of shape \(400,\).*Motion\(acceleration, dt\)"):
        colonnade.Motion(TIME, acceleration)


@pytest.mark.parametrize("at", [[0.04, 0.0], np.zeros((2, 2))], ids=["two components", "a table of two columns"])
def test_points_have_three_components(at):
    with pytest.raises(ValueError, match="at has shape"):
        colonnade.rocking_angle([0.0, 0.001], at, [1.0, 0.0, 0.0], PRISM)


def test_directions_are_unit_vectors():
    with pytest.raises(ValueError, match="direction has a vector of length 2"):
        colonnade.rocking_angle([0.0, 0.001], [0.04, 0.0, 0.4], [2.0, 0.0, 0.0], PRISM)


def test_a_run_of_the_contact_model_that_would_not_end_is_refused():
    slow = colonnade.Motion([0.0, 1.0, 0.0], 1e9)
    with pytest.raises(ValueError, match="dt"):
        colonnade.rock(PRISM, slow, model="contact")
    with pytest.raises(ValueError, match="stiffness is"):
        ContactLaw(np.inf)


def test_a_duration_beside_a_motion_is_refused():
    with pytest.raises(ValueError, match="duration"):
        colonnade.rock(PRISM, MOTION, duration=1.0)


def test_a_masked_array_without_a_gap_is_plain():
    whole = np.ma.masked_array([0.0, 1.0, 0.0])
    np.testing.assert_array_equal(colonnade.Motion(whole, 0.01).acceleration, [0.0, 1.0, 0.0])
