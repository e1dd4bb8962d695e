"""
Bodies of a column that MuJoCo moved, as our pipeline measures and predicts them.

MuJoCo is an independent engine. Its stiff boxes do not bounce, so that the contact model has a strong damping here.
"""

from functools import partial
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import drums
from colonnade.laboratory import assemblies
from colonnade.store import files
from colonnade.store.layout import Layout
from colonnade.workflow import run

pytest.importorskip("mujoco")
pytestmark = pytest.mark.slow

HALF = 0.1


def moved_by_mujoco(motion):
    """What MuJoCo gives, in the form that the cameras of the drums take."""
    base = partial(np.interp, xp=motion.time, fp=motion.acceleration)
    moved = assemblies.move(drums.COLUMN, base, motion.time)
    bodies = {}
    for place, name in enumerate(drums.COLUMN.bodies):
        turned = moved.turned[:, place]
        orientation = Rotation.from_matrix(turned).as_quat(scalar_first=True)
        bodies[name] = SimpleNamespace(position=moved.place[:, place], orientation=orientation, upwards=turned[:, :, 2])
    return SimpleNamespace(assembly=drums.COLUMN, time=motion.time, bodies=bodies)


@pytest.fixture(scope="module", params=[3.6, 4.0, 6.0])
def shaken(request, tmp_path_factory):
    folder = tmp_path_factory.mktemp("drums")
    history = moved_by_mujoco(drums.pulse(request.param))
    drums.write_campaign(folder, history, request.param)
    file = folder / "campaign.toml"
    file.write_text(file.read_text().replace('penetration = 1e-6\nstep = "20 us"', "damping_fraction = 2.0"))
    assert not run(folder, until="compare", workers=1).failed
    results = [files.read(Layout(folder).stage("quake", *stage)) for stage in (("rocking",), ("predict", "contact"))]
    return history, *results


def true_angles(body):
    """Rotation about y of the axis, rad."""
    return np.arctan2(body.upwards[:, 0], body.upwards[:, 2])


def test_what_mujoco_moved_is_measured_as_it_moved(shaken):
    history, measured, _ = shaken
    if measured.attrs["outcome"] == "overturned":
        pytest.skip("the bodies lie on each other, where no transducer follows them")
    for place, body in enumerate(history.bodies.values()):
        off = measured["body_angle"].to_numpy()[place] - true_angles(body)
        assert np.sqrt(np.nanmean(off**2)) < 1e-3
        left = [float(measured[f"body_residual_{axis}"][place]) for axis in "xy"]
        base = body.position - HALF * body.upwards
        true = base[-100:, :2].mean(axis=0) - base[:90, :2].mean(axis=0)
        assert left == pytest.approx(true.tolist(), abs=4e-4)


def test_the_contact_model_predicts_the_first_second(shaken):
    """Then they part: at 4 m/s² MuJoCo's column comes back from 0.9 α, and ours falls."""
    history, _, predicted = shaken
    first = history.time < 1.0
    for place, body in enumerate(history.bodies.values()):
        off = predicted["body_angle"].to_numpy()[place] - true_angles(body)
        assert np.abs(off[first]).max() < 0.03 * 0.32
