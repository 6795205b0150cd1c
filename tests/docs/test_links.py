"""No dead link: every file and every heading that a page points to exists; links to the outside are listed."""

import re
from pkgutil import resolve_name

import pytest
from pages import PAGES, ROOT, anchors, links

LISTED = (ROOT / "tests" / "docs" / "external_links.txt").read_text(encoding="utf-8").split()
TO_BE_WRITTEN = {"verification/fem/studies/thinner_oil.py"}  # by who follows CONTRIBUTING
MADE = ("auto_gallery/",)  # written by the build of the site from docs/gallery


def inside(page):
    return [target for target in links(page) if not target.startswith(("http://", "https://", "mailto:"))]


@pytest.mark.parametrize("page", PAGES, ids=lambda p: p.name)
def test_links_within_the_project_lead_somewhere(page):
    for target in inside(page):
        path, _, anchor = target.partition("#")
        if path.startswith(MADE):
            continue
        result = page.parent / path if path else page
        assert result.exists(), f"{page.name}: {target} does not exist"
        assert not anchor or anchor in anchors(result), f"{page.name}: {target}: no such heading"


def test_links_to_the_outside_are_listed():
    """The list is what somebody with a network follows by hand."""
    used = {target.rstrip(".,;") for page in PAGES for target in links(page) if target.startswith("http")}
    assert used == set(LISTED)


def test_pictures_of_the_pages_are_used():
    pictures = {p.name for p in (ROOT / "docs" / "images").iterdir()}
    used = {target.rpartition("/")[2] for page in PAGES for target in inside(page)}
    assert not pictures - used


@pytest.mark.parametrize("page", [p for p in PAGES if p.name != "CHANGELOG.md"], ids=lambda p: p.name)
def test_files_and_names_of_the_code_exist(page):
    """``room/file.py`` in or below the project, and dotted names of lubfric."""
    text = page.read_text(encoding="utf-8")
    for path in set(re.findall(r"(?<![\w/.])[\w]+/[\w/]*\.py\b", text)) - TO_BE_WRITTEN:
        assert any((ROOT / folder / path).exists() for folder in ("", "lubfric", "verification", "tests")), path
    for name in set(re.findall(r"`(lubfric\.[\w.]+)`", text)):
        resolve_name(name)
