"""The studies as they are kept."""

import json

import pytest

from study import HERE


@pytest.fixture(scope="module")
def found(request):
    """Numbers of the study that a module is named after."""
    name = request.path.stem.removeprefix("test_").replace("_", "-")
    return json.loads((HERE / f"{name}.json").read_text(encoding="utf-8"))
