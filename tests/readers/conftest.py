"""Where the tests of readers write a file, and small ones in the formats of other laboratories' instruments."""

import numpy as np
import pytest

from raw_files import COLUMNS, WRITERS, Column


@pytest.fixture
def path(tmp_path):
    """Where a test writes its raw file, whose bytes say what it is, not its name."""
    return tmp_path / "record.raw"


@pytest.fixture
def written(tmp_path):
    """Writes a small file: two channels of 40 samples at 200 Hz, or those that are given."""

    def write(name, *columns, samples=40, **options):
        chosen = [Column(*column) for column in columns] or COLUMNS
        return WRITERS[name](tmp_path / f"record.{name}", np.arange(samples) / 200, chosen, **options)

    return write
