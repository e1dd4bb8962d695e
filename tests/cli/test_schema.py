"""`colonnade schema` writes what lies in raw_schema/, to the byte."""

from __future__ import annotations

from pathlib import Path

import pytest

RAW_SCHEMA = Path(__file__).parents[2] / "raw_schema"


@pytest.mark.parametrize("contract", ["campaign", "summary"])
def test_the_command_writes_the_file_that_lies_in_raw_schema(colonnade, contract):
    told = colonnade("schema", contract)
    assert told.returncode == 0
    assert told.stdout == (RAW_SCHEMA / f"{contract}.schema.json").read_text(encoding="utf-8")


def test_an_unknown_contract_is_a_usage_error(colonnade):
    assert colonnade("schema", "report").returncode == 2
