"""The pages together stay a short book, and each begins with its readers and leads to the glossary."""

import re

import pytest
from pages import ROOT

# Words of README and docs, tables included; bars and rules of tables are no words. A limit set from outside.
MOST_WORDS = 26_000
RULE = re.compile(r"[|:-]+")
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").glob("**/*.md"))]
INCLUDED = ("changelog.md", "contributing.md")  # pages that include a file of the top folder


def test_all_pages_together_are_a_short_book():
    words = [word for page in PAGES for word in page.read_text(encoding="utf-8").split() if not RULE.fullmatch(word)]
    assert len(words) <= MOST_WORDS


@pytest.mark.parametrize("page", [p for p in PAGES if p.name not in INCLUDED], ids=lambda p: p.name)
def test_every_page_begins_with_what_it_is_and_links_the_glossary(page):
    text = page.read_text(encoding="utf-8")
    title, introduction, _ = text.split("\n\n", 2)
    assert title.startswith("# ")
    assert introduction.startswith("`lubfric`" if page.name == "README.md" else "This page ")
    assert "glossary" in (text if page.name in ("README.md", "index.md") else introduction.lower())
