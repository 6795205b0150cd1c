"""The pages together stay a short book."""

from pages import ROOT

MOST_WORDS = 26_000
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").glob("**/*.md"))]


def test_all_pages_together_are_a_short_book():
    assert sum(len(page.read_text(encoding="utf-8").split()) for page in PAGES) <= MOST_WORDS
