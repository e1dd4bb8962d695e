"""Hazard curves: of the fragility's own measure, positive and falling, or refused with what was found."""

import re

import numpy as np
import pytest

from colonnade.errors import ReadError
from colonnade.readers.hazard import read_hazard
from every import every


def read(tmp_path, text, measure="pgv"):
    path = tmp_path / "hazard.csv"
    path.write_text(text)
    return read_hazard(path, measure)


@every(
    ("text", "measure", "factor"),
    [
        ("pgv [cm/s],rate [1/year]\n1,0.1\n2,0.01\n", "pgv", 0.01),
        ("pgv (cm/s),rate (1/year)\n1,0.1\n2,0.01\n", "pgv", 0.01),
        ("PGV [m/s];Rate\n1;0,1\n2;0,01\n", "pgv", 1.0),
        ("Sa(0.5 s) [g],rate\n1,0.1\n2,0.01\n", "sa(0.5 s)", 9.80665),
        ("# site 1\npga [m/s²],rate [1/year]\n\n1,0.1\n2,0.01\n", "pga", 1.0),
    ],
)
def test_intensity_comes_in_si(tmp_path, text, measure, factor):
    hazard = read(tmp_path, text, measure)
    np.testing.assert_allclose(hazard.intensity, [factor, 2 * factor])
    np.testing.assert_allclose(hazard.rate, [0.1, 0.01])


@every(
    ("text", "message"),
    [
        ("pga [g],rate\n1,2\n2,1\n", 'given for "pga" and the fragility for "pgv"'),
        ("pgv [g],rate\n1,2\n2,1\n", 'its heads are "pgv [g], rate"; "pgv [m/s], rate [1/year]" was expected'),
        ("pgv,rate\n1,2\n2,1\n", 'its heads are "pgv, rate"'),
        ("pgv [m/s],probability\n1,2\n2,1\n", 'its heads are "pgv [m/s], probability"'),
        ("pgv [m/s],rate [1/day]\n1,2\n2,1\n", 'its heads are "pgv [m/s], rate [1/day]"'),
        ("pgv [m/s],annual rate\n1,2\n2,1\n", 'its heads are "pgv [m/s], annual rate"'),
        ("pgv [furlong],rate\n1,2\n2,1\n", 'Unknown unit "furlong"'),
        ("pgv [m/s]\n1\n2\n", 'its heads are "pgv [m/s]"'),
        ("pgv [m/s],rate\n1,2\n", "at least 2"),
        ("pgv [m/s],rate\n1,2\n1,1\n", "rising intensities were expected"),
        ("pgv [m/s],rate\n1,2\n2,3\n", "rate is not positive and falling"),
        ("pgv [m/s],rate\n1,2\n2,0\n", 'line 3: "0" is not a positive number'),
        ("pgv [m/s],rate\n1,2\n2,\n", 'line 3: "" is not a positive number'),
        ("pgv [m/s],rate\n1,2\n2,nan\n", 'line 3: "nan" is not a positive number'),
        ("pgv [m/s],rate\n1,2\n2,1,0\n", "row 3: 3 cells are below 2 heads"),
        ("", "the file is empty"),
    ],
)
def test_what_is_no_hazard_of_this_measure_is_refused(tmp_path, text, message):
    with pytest.raises(ReadError, match=re.escape(message)):
        read(tmp_path, text)
