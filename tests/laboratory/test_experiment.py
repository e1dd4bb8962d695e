"""A plan of a virtual campaign: whose specimen a trial is of, and where its raw files are."""

from __future__ import annotations

import pytest

from colonnade.laboratory.experiment import MAIN, Plan, Recorder, Setup, Specimen, Trial, raw_path
from colonnade.laboratory.files import Flavour, Tdms
from prism import PRISM

SPECIMEN = Specimen({"shape": "prism"}, PRISM, 0.93)


def plan(*specimens):
    return Plan("one", "One", dict.fromkeys(specimens, SPECIMEN), {"frame": Setup({})}, ())


def test_the_only_specimen_needs_no_name():
    assert plan("prism").specimen_of(Trial("free-01", "free-vibration", "frame", 9.0)) == "prism"


def test_of_several_specimens_one_is_named():
    trial = Trial("free-01", "free-vibration", "frame", 9.0)
    with pytest.raises(ValueError, match="free-01: one of prism, statue was expected"):
        plan("prism", "statue").specimen_of(trial)
    named = Trial("free-01", "free-vibration", "frame", 9.0, specimen="statue")
    assert plan("prism", "statue").specimen_of(named) == "statue"


def test_a_trial_stands_on_a_table_at_rest_unless_it_is_shaken():
    table = Trial("free-01", "free-vibration", "frame", 9.0).table
    assert table.acceleration([0.0, 1.0, 8.5]).tolist() == [0.0, 0.0, 0.0]


@pytest.mark.parametrize(
    ("recorder", "flavour", "path"),
    [
        (MAIN, Flavour(), "raw/free-01.csv"),
        (MAIN, Tdms(), "raw/free-01.tdms"),
        ("daq2", Tdms(), "raw/free-01-daq2.tdms"),
    ],
)
def test_each_recorder_writes_a_file_of_its_own(recorder, flavour, path):
    assert raw_path(Trial("free-01", "sine", "frame", 9.0), recorder, Recorder((), 200.0, flavour)) == path
