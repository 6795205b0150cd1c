"""The pages stay short and plain: what they have together, whom each is for, and words that no field has."""

import pytest
from pages import PAGES, ROOT

TAUGHT = [ROOT / "README.md", *sorted((ROOT / "docs").glob("**/*.md"))]
INCLUDED = {"changelog.md", "contributing.md"}  # a line each, which takes another file in
OF_NO_FIELD = ("participation", "foretold", "come off one by one", "would carry is estimated", "xsweep")  # once here


def test_all_pages_together_are_a_short_book():
    assert sum(len(page.read_text(encoding="utf-8").split()) for page in TAUGHT) <= 20_000


@pytest.mark.parametrize("page", [p for p in TAUGHT if p.name not in INCLUDED], ids=lambda p: p.name)
def test_a_page_says_first_whom_it_is_for(page):
    lines = [line for line in page.read_text(encoding="utf-8").splitlines() if line and not line.startswith("![")]
    assert lines[0].startswith("# ") and lines[1].startswith("For ")


@pytest.mark.parametrize("page", [p for p in PAGES if p.name != "CHANGELOG.md"], ids=lambda p: p.name)
def test_no_words_that_no_field_has(page):
    text = page.read_text(encoding="utf-8").lower()
    assert not [word for word in OF_NO_FIELD if word in text]
