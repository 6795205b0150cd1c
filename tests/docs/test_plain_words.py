"""The pages together stay a short book."""

import re

from pages import ROOT

# Words of README and docs without the tables that a command writes. Such a table is data, and grows with what is checked.
MOST_WORDS = 23_200
WRITTEN_TABLE = re.compile(r"<!-- table:.*?<!-- end of table -->", re.DOTALL)
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").glob("**/*.md"))]


def test_all_pages_together_are_a_short_book():
    prose = [WRITTEN_TABLE.sub("", page.read_text(encoding="utf-8")) for page in PAGES]
    assert sum(len(text.split()) for text in prose) <= MOST_WORDS
