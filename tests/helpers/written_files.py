"""The files that a virtual test wrote, as campaign file and readers find them."""

import numpy as np

from colonnade.campaign import Campaign, Channel
from colonnade.readers.recording import RecordedChannel
from colonnade.readers.registry import read


def columns(campaign: Campaign, name: str) -> dict[str, tuple[Channel, RecordedChannel]]:
    """Channels of a test with their columns, which are read without a warning."""
    test = campaign.tests[name]
    setup, found = campaign.setups[test.setup], {}
    for recorder, path in test.files.items():
        file = setup.recorders[recorder].file
        recording = read(path, file.format, file.options)
        assert recording.warnings == ()
        assert path.suffix != ".tdms" or recording.start.date() == test.date
        for channel_name, channel in setup.channels.items():
            if channel.recorder == recorder:
                column = recording.channel(channel.column)
                found[channel_name] = channel, column
    return found


def assert_sound(found: dict[str, tuple[Channel, RecordedChannel]]) -> None:
    """Each is on the even clock of its recorder and within its range of 10 V; every value is finite."""
    for channel, column in found.values():
        np.testing.assert_allclose(np.diff(column.time), 1 / (500 if channel.recorder == "main" else 400), atol=1e-9)
        assert np.abs(column.values).max() < 9.99
