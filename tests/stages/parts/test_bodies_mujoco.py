"""
Bodies of a column that MuJoCo moved, as our pipeline measures and predicts them.

MuJoCo is an independent engine. Its stiff boxes do not bounce, so that the contact model has a strong damping here.
"""

import numpy as np
import pytest

import drums
from colonnade.store import files
from colonnade.store.layout import Layout
from colonnade.workflow import run

mujoco = pytest.importorskip("mujoco")
pytestmark = pytest.mark.slow

STEP = 5e-5
HALF = 0.1
BODY = '<body pos="0 0 {z}"><freejoint/><geom type="box" size="0.1 0.1 0.1" mass="20" friction="0.6 0 0"/></body>'
MODEL = f"""
<mujoco>
  <option timestep="{STEP}" integrator="implicitfast" cone="elliptic" impratio="100"
    iterations="100" tolerance="1e-12"/>
  <default><geom solref="0.0001 1" solimp="0.99 0.999 1e-5"/></default>
  <worldbody>
    <geom type="plane" size="5 5 1" friction="0.6 0 0"/>
    {"".join(BODY.format(z=HALF + 2 * HALF * k) for k in range(3))}
  </worldbody>
</mujoco>
"""


class Body:
    """Where a body was, as the histories of our engine have it."""

    def __init__(self, samples):
        self.position, self.orientation = samples[:, :3], samples[:, 3:]


class History:
    """What MuJoCo gives, in the form that the cameras of the drums take."""

    assembly = drums.COLUMN

    def __init__(self, motion):
        model = mujoco.MjModel.from_xml_string(MODEL)
        data = mujoco.MjData(model)
        parts = round(motion.dt / STEP)
        self.time = motion.time
        samples = np.zeros((self.time.size, 21))
        fine = np.arange((self.time.size - 1) * parts) * STEP + 0.5 * STEP
        for index, base in enumerate(np.interp(fine, motion.time, motion.acceleration)):
            if index % parts == 0:
                samples[index // parts] = data.qpos
            model.opt.gravity[:] = [-base, 0.0, -9.81]
            mujoco.mj_step(model, data)
        samples[-1] = data.qpos
        self.bodies = {str(k + 1): Body(samples[:, 7 * k : 7 * k + 7]) for k in range(3)}


@pytest.fixture(scope="module", params=[3.6, 4.0, 6.0])
def shaken(request, tmp_path_factory):
    folder = tmp_path_factory.mktemp("drums")
    history = History(drums.pulse(request.param))
    drums.write_campaign(folder, history, request.param)
    file = folder / "campaign.toml"
    file.write_text(file.read_text().replace('penetration = 1e-6\nstep = "20 us"', "damping_fraction = 2.0"))
    assert not run(folder, until="compare", workers=1).failed
    results = [files.read(Layout(folder).stage("quake", *stage)) for stage in (("rocking",), ("predict", "contact"))]
    return history, *results


def true_angles(body):
    """Rotation about y of the axis, rad."""
    w, x, y, z = body.orientation.T
    return np.arctan2(2 * (x * z + w * y), 1 - 2 * (x * x + y * y))


def axes(body):
    """The body's own z in the frame of the table, shape (n, 3)."""
    w, x, y, z = body.orientation.T
    return np.column_stack((2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)))


def test_what_mujoco_moved_is_measured_as_it_moved(shaken):
    history, measured, _ = shaken
    if measured.attrs["outcome"] == "overturned":
        pytest.skip("the bodies lie on each other, where no transducer follows them")
    for place, body in enumerate(history.bodies.values()):
        off = measured["body_angle"].to_numpy()[place] - true_angles(body)
        assert np.sqrt(np.nanmean(off**2)) < 1e-3
        left = [float(measured[f"body_residual_{axis}"][place]) for axis in "xy"]
        base = body.position - HALF * axes(body)
        true = base[-100:, :2].mean(axis=0) - base[:90, :2].mean(axis=0)
        assert left == pytest.approx(true.tolist(), abs=4e-4)


def test_the_contact_model_predicts_the_first_second(shaken):
    """Then they part: at 4 m/s² MuJoCo's column comes back from 0.9 α, and ours falls."""
    history, _, predicted = shaken
    first = history.time < 1.0
    for place, body in enumerate(history.bodies.values()):
        off = predicted["body_angle"].to_numpy()[place] - true_angles(body)
        assert np.abs(off[first]).max() < 0.03 * 0.32
