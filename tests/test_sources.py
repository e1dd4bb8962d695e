"""What a result's code is: the modules that it is made by, whatever their docstrings and comments say."""

import shutil

import pytest

from colonnade import sources
from colonnade.sources import code_hash, package_hash

pytestmark = pytest.mark.whole


@pytest.fixture
def package(tmp_path, monkeypatch):
    """A copy of the package whose sources may be edited."""
    copy = shutil.copytree(sources.PACKAGE, tmp_path / "colonnade", ignore=shutil.ignore_patterns("__pycache__"))
    monkeypatch.setattr(sources, "PACKAGE", copy)
    forget()
    yield copy
    forget()


def forget():
    package_hash.cache_clear()
    sources._modules.cache_clear()
    sources._module.cache_clear()


def edit(package, name, before, after):
    path = package / name
    text = path.read_text(encoding="utf-8")
    assert before in text
    path.write_text(text.replace(before, after, 1), encoding="utf-8")
    forget()


def of(stage, **given):
    return code_hash([f"colonnade.stages.{stage}"], alone=("colonnade.campaign", "colonnade.store"), **given)


def of_text(package, text):
    """Code of a module with this text."""
    (package / "stages/extra.py").write_text(text, encoding="utf-8")
    forget()
    return code_hash(["colonnade.stages.extra"])


@pytest.mark.smoke
def test_a_docstring_or_a_comment_changes_no_code(package):
    before, whole = of("rocking"), package_hash()
    edit(package, "stages/rocking.py", '"""', '"""Now in other words. ')
    edit(package, "stages/rocking.py", "\n\n\n", "\n\n\n# a comment\n\n")
    assert of("rocking") == before
    assert package_hash() != whole


@pytest.mark.parametrize(
    ("text", "is_same"),
    [
        ("if 1:\n    # why\n    a = 1\n    b = 2\n", True),
        ("if 1:\n    a = 1\n\n    # why\n    b = 2\n", True),
        ("if 1:\n    'as a docstring'\n    a = 1\n    b = 2\n", True),
        ("if 1:\n    a = 1\nelse:\n    b = 2\n", False),
        ("if 1:\n    a = 1\nb = 2\n", False),
        ("if 2:\n    a = 1\n    b = 2\n", False),
    ],
)
def test_code_is_what_is_stated_and_where(package, text, is_same):
    assert (of_text(package, text) == of_text(package, "if 1:\n    a = 1\n    b = 2\n")) is is_same


def test_a_line_of_a_text_is_no_comment(package):
    text = "a = '''\n# {}\n'''\n"
    assert of_text(package, text.format("one")) != of_text(package, text.format("two"))


def test_a_statement_changes_the_code_of_those_who_import_it_and_of_no_others(package):
    stages = ("ingest", "condition", "rocking", "restitution", "predict", "compare")
    before = {stage: of(stage) for stage in stages}
    (package / "stages/rocking.py").open("a", encoding="utf-8").write("\nONE_MORE = 1\n")
    forget()
    assert {stage for stage in stages if of(stage) != before[stage]} == {"rocking"}


def test_a_change_in_a_reader_makes_no_prediction_anew(package):
    before = {stage: of(stage) for stage in ("rocking", "restitution", "contact", "predict", "ensemble")}
    for path in (package / "readers").rglob("*.py"):
        path.open("a", encoding="utf-8").write("\nONE_MORE = 1\n")
    forget()
    assert {stage: of(stage) for stage in before} == before


def test_a_template_a_script_or_a_style_changes_the_code_of_the_pages_alone(package):
    def of_pages():
        forget()
        return code_hash(["colonnade.report"], alone=["colonnade.report"])

    pages, rocking = [of_pages()], of("rocking")
    for name in ("templates/page.css", "templates/test.html.jinja", "scripts/page.js"):
        (package / "report" / name).open("a", encoding="utf-8").write("\n")
        pages.append(of_pages())
    assert len({*pages}) == 4
    assert of("rocking") == rocking
