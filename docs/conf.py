"""
The documentation site: `make docs` builds it into docs/build/html.

Its source folder is the repository, so that a relative link leads to the same file on a code host and in the site.
Pages are those of `include_patterns`; a link to any other file gives the reader a copy of it.
"""

import sys
from importlib.metadata import version as version_of
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(REPOSITORY / "docs" / "extensions"))

project = "colonnade"
author = "the authors of colonnade"
version = release = version_of("colonnade")
html_title = f"colonnade {release}"

extensions = [
    "myst_parser",
    "numpydoc",
    "sphinx.ext.autodoc",
    "sphinx_click",
    "sphinx_gallery.gen_gallery",
    "pages",
    "reference",
]

root_doc = "docs/index"
source_suffix = {".md": "markdown", ".rst": "restructuredtext"}
include_patterns = [
    "docs/**.md",
    "docs/**.rst",
    "raw_schema/README.md",
    "reports/**.md",
    "CHANGELOG.md",
    "README.md",
    "CONTRIBUTING.md",
    "SECURITY.md",
]
exclude_patterns = [
    ".*",
    "build",
    "demo",
    "dist",
    "docs/build",
    "docs/extensions",
    "examples",
    "pipeline",
    "tests",
    "raw_schema/examples",
]

# A code host shows the same Markdown: only equations and anchors of headings go beyond it.
myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 4

autodoc_typehints = "none"
numpydoc_show_class_members = False
smartquotes = False
default_role = "code"

sphinx_gallery_conf = {
    "examples_dirs": "examples",
    "gallery_dirs": "docs/gallery",
    "within_subsection_order": "FileNameSortKey",
    "image_scrapers": ("pages.animations", "matplotlib"),
    "filename_pattern": r"\.py$",
    "parallel": 2,
    "show_memory": False,
    "write_computation_times": False,
    "remove_config_comments": True,
}

html_theme = "furo"
html_static_path = ["_static"]
html_css_files = ["site.css"]
html_copy_source = False
html_show_search_summary = False  # it would fetch pages, which a browser refuses from a folder
html_show_sphinx = False
html_show_copyright = False
html_theme_options = {"navigation_with_keys": True}
html_math_renderer = "mathml"
