"""Quality of channels: of one by itself, and of accelerometers on the specimen against the table's."""

from __future__ import annotations

import numpy as np

from colonnade.campaign.review import Flagged, Review
from colonnade.campaign.settings import QualitySettings
from colonnade.signals.quality import Flag
from colonnade.stages.ingesting.quality import ChannelInputs, channel_verdicts, reviewed

TIME = np.arange(0.0, 10.0, 0.01)
WAVE = np.sin(2 * np.pi * 2.0 * TIME)


def _channel(on, direction=(1.0, 0.0, 0.0), **changed):
    given = {
        "column": "a",
        "recorder": "main",
        "time": None,
        "quantity": "acceleration",
        "unit": "g",
        "gain": None,
        "factor": 9.80665,
    }
    return ChannelInputs(
        **given
        | {"offset": 0.0, "full_scale": None, "range_recorded": None, "on": on, "direction": direction}
        | changed
    )


def test_clipping_is_judged_by_the_recorded_range_if_it_is_given_so():
    recorded = np.clip(WAVE, -0.5, 0.5)
    channel = _channel("table", range_recorded=0.5, full_scale=100.0)
    verdicts = channel_verdicts(TIME, recorded, 9.80665 * recorded, channel, QualitySettings())
    assert [verdict.finding.kind for verdict in verdicts if verdict.reason] == ["end of the range"]


def test_people_flag_a_stretch_or_a_whole_channel():
    flags = (
        Flagged(channel="top", window=(1.0, 2.0), flag="suspect", reason="knocked"),
        Flagged(channel="top", window=None, flag="fail", reason="loose"),
        Flagged(channel="other", window=None, flag="fail", reason="loose"),
    )
    stretch, whole = reviewed("top", TIME, Review(flags=flags))
    assert (stretch.flag, int(stretch.where.sum())) == (Flag.SUSPECT, 101)
    assert (whole.flag, bool(whole.where.all())) == (Flag.FAIL, True)
