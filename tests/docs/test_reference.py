"""The API reference has every public name, and every public function says what it takes, gives and raises."""

import inspect
import pydoc
import re
import sys

import pytest
from pages import ROOT

import lubfric

sys.path.insert(0, str(ROOT / "docs"))
from docstrings import numpydoc  # noqa: E402

GONE = {"start"}  # taken only to say that it is not taken any more
FUNCTIONS = [name for name in lubfric.__all__ if inspect.isfunction(getattr(lubfric, name))]


def test_every_public_name_is_in_the_reference():
    page = (ROOT / "docs" / "api.md").read_text(encoding="utf-8")
    shown = set(re.findall(r"auto\w+:: lubfric\.(\w+)$", page, re.MULTILINE))
    assert set(lubfric.__all__) <= shown


def test_every_name_of_the_reference_exists():
    page = (ROOT / "docs" / "api.md").read_text(encoding="utf-8")
    shown = re.findall(r"auto\w+:: (lubfric[.\w]*)", page)
    assert shown and not [name for name in shown if pydoc.locate(name) is None]


@pytest.mark.parametrize("name", FUNCTIONS)
def test_every_parameter_is_reported(name):
    function = getattr(lubfric, name)
    lines = numpydoc(inspect.getdoc(function).splitlines())
    begin = lines.index("Parameters")
    stated = [line for line in lines[begin:] if line and not line.startswith((" ", "-"))]
    assert set(inspect.signature(function).parameters) - GONE <= set(stated)
    assert "Returns" in "".join(lines) and "Raises" in "".join(lines)
