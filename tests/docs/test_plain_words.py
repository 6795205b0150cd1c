"""The pages stay short and plain: what they have together, whom each is for, and words that no field has."""

import pytest
from pages import ROOT

TAUGHT = [ROOT / "README.md", *sorted((ROOT / "docs").glob("**/*.md"))]
INCLUDED = {"changelog.md", "contributing.md"}  # a line each, which takes another file in


def test_all_pages_together_are_a_short_book():
    assert sum(len(page.read_text(encoding="utf-8").split()) for page in TAUGHT) <= 20_000


@pytest.mark.parametrize("page", [p for p in TAUGHT if p.name not in INCLUDED], ids=lambda p: p.name)
def test_a_page_says_first_whom_it_is_for(page):
    lines = [line for line in page.read_text(encoding="utf-8").splitlines() if line and not line.startswith("![")]
    assert lines[0].startswith("# ") and lines[1].startswith("For ")
