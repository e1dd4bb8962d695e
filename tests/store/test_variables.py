"""The table of variables: units that UDUNITS reads."""

from __future__ import annotations

from compliance_checker.cfunits import Unit

from colonnade.store.variables import VARIABLES


def test_every_unit_of_the_table_is_one_that_udunits_reads():
    for name, variable in VARIABLES.items():
        if variable.units is not None:
            assert Unit(variable.units) is not None, name
