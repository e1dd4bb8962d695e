"""The report of the small campaign, and packed samples read back."""

import shutil
import zlib
from base64 import b64decode

import numpy as np
import pytest

from colonnade.report.interactive.panels import PLANES
from colonnade.store.layout import Layout
from read_pages import built


@pytest.fixture(scope="session")
def report_folder(filled_campaign, made_once):
    """Folder of the report of the small campaign, of which one test was not run; look only."""
    campaign, layout = filled_campaign

    def report(folder):
        shutil.copytree(layout.processed, Layout(folder).processed)
        built(campaign, Layout(folder), {"later"})

    return Layout(made_once("reported", report)).report.parent


@pytest.fixture(scope="session")
def unpacked():
    """Undo the packing by its own description, as the script of a page does, in another way."""
    return _unpacked


def _unpacked(described, text):
    data = np.frombuffer(zlib.decompress(b64decode(text)), np.uint8).astype(np.int64)
    series, start = [], 0
    for one in described:
        planes = data[start : start + PLANES * one["count"]].reshape(PLANES, one["count"])
        start += planes.size
        folded = sum(plane << (8 * place) for place, plane in enumerate(planes))
        values = np.where(folded % 2, -(folded + 1) // 2, folded // 2)
        for _ in range(one["order"]):
            values = np.cumsum(values)
        values = (values * one["step"]).astype(np.float32).astype(float)
        for first, last in one["gaps"]:
            values[first:last] = np.nan
        series.append(values)
    assert start == data.size
    return series
