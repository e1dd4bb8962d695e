from pathlib import Path

import matplotlib

from colonnade.figures.style import styled

PROJECT = Path(__file__).resolve().parents[2]


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
