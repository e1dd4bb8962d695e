import re
from pathlib import Path

import matplotlib
import pytest

from colonnade.figures.style import styled

PROJECT = Path(__file__).resolve().parents[2]
OUTPUT = {"savefig": "figures/files/output.py", "rcParams": "figures/style.py", "rc_context": "figures/style.py"}


@pytest.mark.parametrize("name", OUTPUT)
def test_figures_are_written_and_styled_in_one_place(name):
    sources = [*(PROJECT / "pipeline").rglob("*.py"), *(PROJECT / "reports").rglob("*.py")]
    found = [path.as_posix() for path in sources if re.search(rf"\b{name}\b", path.read_text(encoding="utf-8"))]
    assert [path.endswith(OUTPUT[name]) for path in found] == [True]


def test_pyplot_with_its_state_is_used_only_for_a_figure_that_a_person_shows():
    sources = [*(PROJECT / "pipeline").rglob("*.py"), *(PROJECT / "reports").rglob("*.py")]
    users = [path for path in sources if "pyplot" in path.read_text(encoding="utf-8")]
    assert users == [PROJECT / "pipeline/colonnade/figures/plot.py"]


def test_the_style_holds_while_drawing_and_not_after():
    before = matplotlib.rcParams["font.size"]
    with matplotlib.rc_context({"font.size": 20}):
        with styled():
            assert matplotlib.rcParams["font.size"] == 9
        assert matplotlib.rcParams["font.size"] == 20
    assert matplotlib.rcParams["font.size"] == before
