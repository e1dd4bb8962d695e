"""Bands of the contact model over friction, damping and how straight the specimen stood."""

from __future__ import annotations

import numpy as np
import pytest
import xarray as xr

import chain
from colonnade.campaign.settings import ContactSettings
from colonnade.errors import StageError
from colonnade.stages import contact as calibrating
from colonnade.stages import contact_ensemble as running
from colonnade.stages import predict as predicting

RUNS = 4


SPECIMEN = xr.Dataset({"restitution": ((), 0.976)}, attrs={"restitution_source": "given"})


@pytest.fixture
def shaken_in_space(small_campaign, shaken):
    """Channels and rocking of a shaken test, the law of contact of its specimen, and what the ensemble reads."""
    test = small_campaign.tests["shake-01"]
    settings = ContactSettings.model_validate({"step": "50 us", "damping_fraction": 0.3, "penetration": 1e-5})
    space = calibrating.ContactInputs.of(small_campaign, "prism", settings)
    ready, rocking = chain.measured(small_campaign, test, shaken[0])
    read = running.ContactEnsembleInputs.of(small_campaign, test).model_copy(update={"space": space})
    return ready, rocking, calibrating.contact(SPECIMEN, space), _set(read, members=RUNS)


def _set(read, **changes):
    """The same inputs with other settings."""
    return read.model_copy(update={"settings": read.settings.model_copy(update=changes)})


def test_the_bands_lie_about_the_prediction_on_its_clock(shaken_in_space):
    conditioned, rocking, law, read = shaken_in_space
    bands = running.contact_ensemble(conditioned, rocking, law, read)
    prediction = read.prediction.model_copy(update={"space": read.space})
    predicted = predicting.predict(rocking, SPECIMEN, prediction, law)
    np.testing.assert_array_equal(bands["elapsed"], predicted["elapsed"])
    np.testing.assert_array_equal(bands["rocking_angle"], predicted["rocking_angle"])
    low, high = (bands["rocking_angle_band"].sel(quantile=level) for level in (0.025, 0.975))
    assert (low <= high).all()
    assert float((high - low).max()) > 1e-4
    assert bands.sizes["member"] == bands.attrs["members"] == RUNS
    assert float(bands["overturning_probability"]) == 0.0
    assert float(bands["elapsed"][0]) < float(bands["horizon"]) <= float(bands["elapsed"][-1])


def test_inputs_have_the_deviations_of_their_ranges(shaken_in_space):
    conditioned, rocking, law, read = shaken_in_space
    wide = _set(read, friction=0.3, damping_fraction=0.0, out_of_plane=0.002, members=2)
    bands = running.contact_ensemble(conditioned, rocking, law, wide)
    assert bands["input"].to_numpy().tolist() == ["friction", "out_of_plane"]
    np.testing.assert_allclose(bands["input_deviation"], np.array([0.3, 0.002]) / np.sqrt(3.0))


def test_damping_that_the_step_does_not_follow_is_told(shaken_in_space):
    conditioned, rocking, law, read = shaken_in_space
    stiff = law.assign(contact_stiffness=1e6 * law["contact_stiffness"])
    with pytest.raises(StageError, match=r"contact\.step: The step is"):
        running.contact_ensemble(conditioned, rocking, stiff, read)
