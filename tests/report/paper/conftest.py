"""A report of two tests whose pages are written by hand, with a photo."""

from html import escape
from io import BytesIO

import pytest
from matplotlib.figure import Figure
from PIL import Image

from colonnade.campaign import load
from colonnade.figures.files.output import to_svg

HOSTILE = '#read("/etc/passwd") $x^2$ @all *bold* <label> \\ _emph_ `raw` // no comment'
"""A title that Typst would act on if it were markup."""

CAMPAIGN = f"""
schema = 1
campaign = "two"
title = '{HOSTILE}'
facility = "Ευστάθεια & Söhne"

[specimens]
prism = {{shape = "prism", width = "86 mm", depth = "86 mm", height = "456 mm", mass = "26.10 kg"}}

[setups.frame.channels]
top = {{column = 1, quantity = "other"}}
"""
TEST = """
[[tests]]
id = "{name}"
kind = "other"
specimen = "prism"
setup = "frame"
file = "{name}.csv"
date = {day}
operator = "{operator}"
"""
TESTS = {"free-01": ("2013-04-26", "M. Rossi"), "free-02": ("2013-04-29", "K. #Papas")}


def page(title, inside):
    return f"<html><body><header><h1>{title}</h1></header><main>{inside}</main></body></html>"


@pytest.fixture
def campaign(tmp_path):
    tests = (TEST.format(name=name, day=day, operator=who) for name, (day, who) in TESTS.items())
    (tmp_path / "campaign.toml").write_text(CAMPAIGN + "".join(tests), encoding="utf-8")
    return load(tmp_path)


@pytest.fixture
def folder(tmp_path):
    """The pages of the report."""
    figure = Figure(figsize=(4, 2))
    figure.add_subplot().plot([0, 1], [1, 0], label="θ/α")
    svg = to_svg(figure, identity="f", title="t", description="falls")
    folder = tmp_path / "report"
    for name in ("tests", "specimens", "photos"):
        (folder / name).mkdir(parents=True)
    image = BytesIO()
    Image.new("RGB", (40, 30), "navy").save(image, "JPEG")
    (folder / "photos" / "free-02-1.jpg").write_bytes(image.getvalue())
    photo = '<section id="photos"><figure><img src="../photos/free-02-1.jpg" alt="it lies"></figure></section>'
    for name in TESTS:
        found = f'<section id="found"><h2>What was found</h2><p>{escape(HOSTILE)}</p><figure>{svg}</figure></section>'
        setup = f'<section id="setup" data-paper="no"><p>not on paper</p><figure>{svg}</figure></section>'
        inside = found + setup + (photo if name == "free-02" else "")
        (folder / "tests" / f"{name}.html").write_text(page(name, inside), encoding="utf-8")
    spans = '<section id="spans"><h2>Spans</h2><h3>El Centro</h3><p>first</p><h3>Kobe</h3><p>second</p></section>'
    listed = '<section id="tests" data-paper="no"><table><tr><td>long</td></tr></table></section>'
    told = (
        '<section id="summary"><h2>Summary</h2><p>See <a href="tests/free-01.html">it</a>, <a href="x.html">x</a>.</p>'
    )
    (folder / "index.html").write_text(page("Overview", f"{told}</section>{listed}{spans}"), encoding="utf-8")
    for address in ("specimens/prism.html", "methods.html"):
        table = '<table><thead><tr><th>a</th></tr></thead><tbody><tr><td class="number">1</td></tr></tbody></table>'
        (folder / address).write_text(page(address, f'<section id="text">{table}</section>'), encoding="utf-8")
    return folder
