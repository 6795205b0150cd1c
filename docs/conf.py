"""How the site is built: `sphinx-build -W docs site` (extra ``docs``), without network."""

import os
import sys
from pathlib import Path

import lubfric

sys.path.insert(0, str(Path(__file__).parent))

import docstrings  # noqa: E402  beside this file

project = "lubfric"
author = "the lubfric developers"
version = release = lubfric.__version__

extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.autosummary",
    "sphinx.ext.napoleon",
    "sphinx.ext.mathjax",
    "sphinx_gallery.gen_gallery",
]
source_suffix = {".md": "markdown", ".rst": "restructuredtext"}
exclude_patterns = ["examples", "gallery", "images"]
myst_enable_extensions = ["dollarmath", "colon_fence"]
myst_heading_anchors = 3
suppress_warnings = ["config.cache"]

default_role = "code"  # docstrings quote names with single backticks
autodoc_member_order = "bysource"
autodoc_typehints = "signature"
autodoc_preserve_defaults = True
autosummary_generate = True
napoleon_numpy_docstring = True
napoleon_use_ivar = True  # attributes as a list, beside the documented members of the same name

sphinx_gallery_conf = {
    "plot_gallery": os.environ.get("GALLERY") != "0",  # GALLERY=0: pages without running the scripts
    "examples_dirs": "gallery",
    "gallery_dirs": "auto_gallery",
    "filename_pattern": r"[\\/]plot_",
    "within_subsection_order": "FileNameSortKey",
    "download_all_examples": False,
    "show_memory": False,
    "abort_on_example_error": True,
}

html_theme = "furo"
html_title = f"lubfric {version}"
html_static_path: list[str] = []


def setup(app) -> None:
    """Called by Sphinx."""
    app.connect("autodoc-process-docstring", docstrings.docstring, priority=100)  # before napoleon
    app.connect("autodoc-process-signature", docstrings.signature)
