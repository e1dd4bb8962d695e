"""Pages of the documentation: what they tell readers to type runs as printed; files and figures they name are so."""

import re
from xml.etree import ElementTree

import pytest

import colonnade
import verification
from every import every
from faults.sound import PRISM, earthquake
from page_blocks import PROJECT, Reader, blocks_of

SECTIONS = ("tutorial", "how-to", "explanation", "faults")
PAGES = sorted(page for section in SECTIONS for page in (PROJECT / "docs" / section).rglob("*.md"))


@pytest.mark.whole
@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(PROJECT / "docs")))
def test_what_a_page_tells_readers_to_type_runs(page, instead, tmp_path):
    Reader(tmp_path, instead).follow(page)


def page_with(folder, text):
    page = folder / "page.md"
    page.write_text(text, encoding="utf-8")
    return page


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("```sh\nfalse\n```\n", "page.md, line 1: `false` ended with 1"),
        ("```sh\ncolonnade shwo\n```\n", "`colonnade shwo` ended with 2"),
        ("```sh\nmake tea\n```\n", "not a target"),
        ("<!-- exit code: 1 -->\n```sh\ntrue\n```\n", "`true` ended with 0"),
        ("```python\n>>> 1 + 1\n3\n```\n", "Expected:\n    3"),
        ("```sh\necho a\n```\n<!-- output -->\n```text\nb\n```\n", "not in the output"),
        ("```toml\n[procesing]\n```\n", "procesing"),
        ("```toml\n[[exclude]]\ntest = 3\n```\n", "exclude"),
    ],
)
def test_a_page_that_is_not_true_fails(text, reason, tmp_path):
    with pytest.raises(AssertionError) as failed:
        Reader(tmp_path).follow(page_with(tmp_path, text))
    assert reason in str(failed.value)


@pytest.mark.parametrize("remark", ["not run", "not runn: it is slow"])
def test_a_remark_is_known_and_gives_its_reason(remark, tmp_path):
    with pytest.raises(ValueError, match="line 2"):
        blocks_of(page_with(tmp_path, f"<!-- {remark} -->\n```sh\nfalse\n```\n"))


DECISIONS = PROJECT / "docs" / "decisions"
DECIDED = {path.name: path.read_text(encoding="utf-8") for path in DECISIONS.glob("0*.md")}


def test_each_number_is_given_once_and_a_missing_one_is_accounted_for():
    numbers = sorted(int(name[:4]) for name in DECIDED)
    assert len(numbers) == len(set(numbers))
    missing = [number for number in range(1, numbers[-1]) if number not in numbers]
    said = re.findall(r"no decision (\d+)", (DECISIONS / "README.md").read_text(encoding="utf-8"))
    assert missing == [int(number) for number in said]
    assert [name for name, text in DECIDED.items() if not text.startswith(f"# {int(name[:4])} · ")] == []


TUTORIAL = PROJECT / "docs" / "tutorial"
LARGEST = 150_000
"""Bytes of a picture."""


@pytest.mark.parametrize("picture", sorted(path.name for path in TUTORIAL.iterdir() if path.suffix in (".svg", ".png")))
def test_a_picture_is_small_and_shown(picture):
    assert (TUTORIAL / picture).stat().st_size <= LARGEST
    assert any(f"]({picture})" in page.read_text(encoding="utf-8") for page in TUTORIAL.glob("*.md"))


EXPLANATIONS = sorted((PROJECT / "docs" / "explanation").glob("*.md"))
STRENGTH = 0.55
"""Of the earthquake on the page: the block is sensitive to it."""

PLACES = (PROJECT, PROJECT / "pipeline" / "colonnade")


@every("page", EXPLANATIONS, ids=lambda page: page.stem)
def test_the_files_that_a_page_names_exist(page):
    named = re.findall(r"`((?:\w+/)+[\w.-]*)`", page.read_text(encoding="utf-8"))
    assert [name for name in named if not any((place / name).exists() for place in PLACES)] == []


def test_the_figures_of_the_verification_page_are_those_of_the_studies():
    document = verification.DOCUMENT.read_text(encoding="utf-8")
    assert verification.renewed(document, verification.MARKS, verification.measured()) == document
    changed = document.replace("93.9", "99.9")
    assert verification.renewed(changed, verification.MARKS, verification.measured()) == document


@pytest.mark.parametrize("page", ["docs/index.md", "docs/explanation/paper.md"])
def test_a_page_counts_the_papers_statements_as_their_page_does(page):
    counted = r"(\d+) statements\D+(\d+) agree, (\d+) differ,? and (\d+) cannot be decided"
    [due] = re.findall(counted, (PROJECT / "reports" / "manos" / "index.md").read_text(encoding="utf-8"))
    assert re.findall(counted, (PROJECT / page).read_text(encoding="utf-8")) == [due]


@pytest.mark.parametrize(("change", "outcome"), [(0.0, "overturned"), (1e-3, "rocking")])
def test_a_motion_that_is_stronger_by_a_thousandth_does_not_overturn_the_block(change, outcome):
    motion = earthquake(1)
    shaken = colonnade.Motion(STRENGTH * (1 + change) * motion.acceleration, 0.25 * motion.dt)
    assert colonnade.rock(PRISM, shaken, restitution=0.976).outcome == outcome


@pytest.mark.whole
def test_no_command_of_latex_is_left_in_the_equations_of_the_site():
    pytest.importorskip("latex2mathml", reason="the extra `docs` is not installed")
    from docutils import nodes

    from pages import markup

    for page in (PROJECT / "docs").rglob("*.md"):
        text = re.sub(r"```.*?```|`[^`\n]*`", "", page.read_text(encoding="utf-8"), flags=re.DOTALL)
        for block, inline in re.findall(r"\$\$(.+?)\$\$|\$([^$\n]+?)\$", text, flags=re.DOTALL):
            equation = block or inline
            texts = ElementTree.fromstring(markup(nodes.math(equation, equation), "inline")).itertext()
            assert not [each for each in texts if "\\" in each], (page.name, equation)
