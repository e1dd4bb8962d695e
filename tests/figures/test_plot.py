"""Each kind of result is drawn into axes that are given back; a history can be animated; results show themselves."""

from pathlib import Path

import numpy as np
import pytest
from matplotlib import pyplot

import colonnade
from colonnade.figures.files.table import columns_of
from prism import PRISM


@pytest.fixture(scope="module")
def history():
    return colonnade.rock(PRISM, theta0=0.5 * PRISM.critical_angle, restitution=0.93, duration=6.0)


@pytest.fixture(scope="module")
def results(history):
    pulse, steps = np.sin(2 * np.pi * np.arange(100) / 100), (0.006, 0.008, 0.01, 0.012, 0.014)
    motions = [colonnade.Motion(np.append(pulse, 0.0), step) for step in steps]
    strong = colonnade.Motion(np.concatenate([2.5 * pulse, np.zeros(200)]), 0.02)
    known = {"restitution": 0.93, "frequency_ratio": [2.0, 4.0]}
    return {
        "history": history,
        "restitution": colonnade.identify_restitution(history.time, history.angle, PRISM),
        "chart": colonnade.stability_map(PRISM, amplitude_ratio=np.linspace(0.8, 4.0, 5), cycles=3, **known),
        "spread": colonnade.ensemble(PRISM, strong, uncertainty=colonnade.Uncertainty(), restitution=0.93, count=8),
        "limits": colonnade.overturning_spectrum(PRISM, "sine", **known),
        "spectrum": colonnade.rocking_spectrum(strong, critical_angle=[0.2, 0.4], period=[0.8, 6.0]),
        "fragility": colonnade.fragility(PRISM, motions, levels=np.geomspace(0.1, 3.0, 8), draws=1, resamples=100),
    }


@pytest.fixture(params=["history", "restitution", "chart", "spread", "limits", "spectrum", "fragility"])
def result(request, results):
    return results[request.param]


@pytest.fixture(autouse=True)
def closed():
    yield
    pyplot.close("all")


def test_a_result_is_drawn_into_the_axes_that_are_given(result):
    _, axes = pyplot.subplots()
    assert colonnade.plot(result, axes) is axes
    assert axes.get_xlabel()
    assert columns_of(axes.figure)


def test_what_is_drawn_is_the_history(history):
    table = columns_of(colonnade.plot(history).figure)
    np.testing.assert_array_equal(table["time (s)"], history.time)
    np.testing.assert_allclose(table["θ / α, linear model"], history.angle / PRISM.critical_angle)


def test_two_histories_share_axes_that_hold_both(history):
    higher = colonnade.rock(PRISM, theta0=0.9 * PRISM.critical_angle, restitution=0.93, duration=6.0, model="nonlinear")
    axes = colonnade.plot(history, colonnade.plot(higher))
    assert axes.get_ylim()[1] > 0.9
    assert [text.get_text() for text in axes.get_legend().get_texts()] == ["nonlinear model", "linear model"]


@pytest.mark.parametrize("wrong", [None, 3.0, "history", PRISM])
def test_what_is_no_result_is_refused(wrong):
    with pytest.raises(
        ValueError,
        match=r"result is .*a History, an AssemblyHistory, a Restitution, a StabilityMap, .*a spectrum or a Fragility",
    ):
        colonnade.plot(wrong)
    with pytest.raises(ValueError, match="history"):
        colonnade.animate(wrong)


def test_what_are_no_axes_is_refused(history):
    with pytest.raises(ValueError, match="ax is"):
        colonnade.plot(history, ax="here")


@pytest.mark.whole
def test_a_history_is_animated_and_can_be_written(history, tmp_path):
    moving = colonnade.animate(history)
    moving.save(tmp_path / "rocking.gif", writer="pillow", dpi=30)
    assert (tmp_path / "rocking.gif").read_bytes().startswith(b"GIF89a")
    assert moving._fig is pyplot.gcf()


def test_a_result_shows_itself_in_a_line(result):
    assert len(repr(result)) < 200
    assert repr(result).startswith(f"<{type(result).__name__}: ")


def test_pyplot_with_its_state_is_used_only_for_a_figure_that_a_person_shows():
    project = Path(__file__).resolve().parents[2]
    sources = [*(project / "pipeline").rglob("*.py"), *(project / "reports").rglob("*.py")]
    users = [path for path in sources if "pyplot" in path.read_text(encoding="utf-8")]
    assert users == [project / "pipeline/colonnade/figures/plot.py"]


def test_an_assembly_is_drawn_joint_by_joint_and_moves_body_by_body():
    pillar = colonnade.Block.prism(width=0.4, depth=0.4, height=1.6, mass=640.0)
    beam = colonnade.Block.prism(width=2.4, depth=0.4, height=0.3, mass=720.0)
    portal = colonnade.Assembly.frame(pillar, beam, span=2.0)
    history = colonnade.rock(portal, model="contact", theta0=0.05, duration=0.01)
    axes = colonnade.plot(history)
    assert [line.get_label() for line in axes.lines] == ["left", "right", "beam"]
    corners = {name: outline[0] for name, outline in history.outlines().items()}
    assert corners["left"][1] == pytest.approx([-0.8, 0.0], abs=1e-6)
    assert corners["beam"][0, 1] == pytest.approx(1.6 * np.cos(0.05) + 0.4 * np.sin(0.05), abs=1e-6)
    moving = colonnade.animate(history)
    moving._func(0)
    assert len(moving._fig.axes[0].patches) == 3
