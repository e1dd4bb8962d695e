"""Steady responses of a campaign: those of the library, made once, drawn, with what they depend on."""

import json

import numpy as np
import pytest

from colonnade.dynamics.steady import steady_response
from colonnade.store import files
from colonnade.workflow.map_plans import Wanted
from colonnade.workflow.maps import SETTLING, as_response, make_maps
from prism import PRISM

pytestmark = pytest.mark.whole

FEW = Wanted(models=("linear",), omega=(2.0, 5.0), amplitude=(0.8, 2.0), points=(6, 10), cycles=5.0, responses=True)


def made(small, **changes):
    (only,) = make_maps(small.folder, Wanted(**(FEW.model_dump() | changes)), workers=1)
    return only


def test_they_are_those_of_the_library_and_made_once(small):
    result = made(small)
    stored = as_response(files.read(result.responses))
    e = tuple(float(value) for value in files.read(small.layout.stage("prism", "specimen"))["side_restitution"])
    expected = steady_response(PRISM, restitution=e, frequency_ratio=np.linspace(2.0, 5.0, 6),
                               amplitude_ratio=np.linspace(0.8, 2.0, 10))  # fmt: skip
    assert set(np.unique(expected.order)) >= {-2, 0, 1}
    for name in ("order", "period", "amplitude"):
        np.testing.assert_array_equal(getattr(stored, name), getattr(expected, name), err_msg=name)
    assert "every cycle" in result.responses_figure.read_text(encoding="utf-8")
    assert made(small).action == "up-to-date"
    assert made(small, phase=1.0).action == "done"
    result.responses.unlink()
    assert made(small, phase=1.0).action == "done"


def test_they_depend_on_the_sine_and_on_their_own_settling_and_not_on_the_cycles_of_the_map(small):
    few = {"points": (2, 3)}
    settings = json.loads(files.read(made(small, **few).responses).attrs["settings"])
    assert settings["settling"] == SETTLING
    assert settings["model"] == "linear"
    assert settings.keys().isdisjoint({"cycles", "width", "edge"})
    before = made(small, **few).responses.stat().st_mtime_ns
    longer = made(small, cycles=6.0, **few)
    assert longer.because == "settings changed"
    assert longer.responses.stat().st_mtime_ns == before
