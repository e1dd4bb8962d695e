"""Every public name says what it is, in which units, and shows it with an example that doctest runs."""

import dataclasses
import inspect
import re

import pytest

import colonnade

pytest.importorskip("numpydoc", reason="of the extra `docs`; `make test-all` installs it")
from numpydoc.docscrape import ClassDoc, FunctionDoc

from every import every

pytestmark = pytest.mark.whole

PUBLIC = sorted(set(colonnade.__all__) - {"__version__"})
CLASSES = [name for name in PUBLIC if inspect.isclass(getattr(colonnade, name))]
FUNCTIONS = [name for name in PUBLIC if name not in CLASSES]
OF_PYTHON = ("args", "with_traceback", "add_note")
NUMBERS = re.compile(r"\b(float|ndarray(?! of bool)|array_like|ArrayLike)\b")
UNITS = re.compile(
    r"(?<![\w/])(rad|m|s|kg|N|Hz|m/s²|rad/s|s/rad|kg m²|SI|NaN|dimensionless|relative|"
    r"[0-9] (to|and) [0-9π]|Ω|A|α|θ\|?/α|e|[Ss]hares?|[Ff]actors?|[Ff]raction|[Pp]robabilit(y|ies)|[Uu]nit|width|"
    r"as of|as for|\|H\|/N|[Rr]atio|friction|standard deviations|[Nn]umber)(?![\w/])"
)
"""A unit, or a word that says that there is none."""


def sections(name):
    found = getattr(colonnade, name)
    return ClassDoc(found) if inspect.isclass(found) else FunctionDoc(found)


def names_of(parameters):
    return {each.strip().lstrip("*") for one in parameters for each in one.name.split(",")}


def without_unit(parameters):
    """Numbers of which it is not said in which unit they are."""
    return [
        one.name for one in parameters if NUMBERS.search(one.type) and not UNITS.search(" ".join([one.type, *one.desc]))
    ]


def members_of(name):
    """Public methods and properties of a class, with those of its own bases."""
    found = getattr(colonnade, name)
    fields = {each.name for each in dataclasses.fields(found)} if dataclasses.is_dataclass(found) else set()
    listed = {member for member in dir(found) if not member.startswith("_")} - fields - set(OF_PYTHON)
    return {member: inspect.getattr_static(found, member) for member in sorted(listed)}


def expect_described(call):
    """What a function or method takes and gives is all described; give its sections."""
    described = FunctionDoc(call)
    assert set(inspect.signature(call).parameters) - {"self", "cls"} == names_of(described["Parameters"])
    assert described["Returns"]
    assert without_unit(described["Parameters"]) == []
    return described


@every("name", PUBLIC)
def test_it_has_a_summary_and_an_example(name):
    found = sections(name)
    assert found["Summary"]
    assert any(line.strip().startswith(">>>") for line in found["Examples"])


@every("name", FUNCTIONS)
def test_a_function_says_what_it_takes_gives_and_refuses(name):
    assert expect_described(getattr(colonnade, name))["Raises"]


@every("name", CLASSES)
def test_a_class_says_what_it_holds(name):
    found, given = getattr(colonnade, name), sections(name)
    documented = names_of(given["Attributes"]) | names_of(given["Parameters"])
    if dataclasses.is_dataclass(found):
        assert {each.name for each in dataclasses.fields(found)} <= documented
        assert without_unit(given["Attributes"]) == []
    assert without_unit(given["Parameters"]) == []


@every("name", CLASSES)
def test_every_method_and_property_is_described_and_shown(name):
    shown = inspect.getdoc(getattr(colonnade, name))
    for member, found in members_of(name).items():
        behind = getattr(found, "fget", None) or getattr(found, "func", None)  # of a property
        method = getattr(found, "__func__", found)
        text = inspect.getdoc(behind or method)
        assert text, member
        assert f".{member}" in shown or ">>>" in text, f"{name}.{member} has no example"
        if behind is None:
            expect_described(method)
