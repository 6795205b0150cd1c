"""The glossary holds every symbol that results, tables and axes use, and names of the code that exist."""

import re

from pages import ROOT

from lubfric.quantities import COLUMNS
from lubfric.scene import SECTIONS

PAGE = (ROOT / "docs" / "glossary.md").read_text(encoding="utf-8")
ROWS = [
    [cell.strip() for cell in line.strip("|").split("|")]
    for line in PAGE.splitlines()
    if line.startswith("| ") and not line.startswith("| term")
]
SYMBOLS = {symbol for row in ROWS for symbol in re.findall(r"[\w/]+(?: [\w/]+)?", row[1])} | {
    symbol for row in ROWS for symbol in re.findall(r"\b\w_\w+/\w\b", row[2])
}


def test_every_symbol_of_a_quantity_has_an_entry():
    used = {quantity.symbol for quantity in COLUMNS.values() if quantity.symbol}
    assert used and used - SYMBOLS == set()


def test_it_has_enough_entries_and_each_is_defined():
    assert len(ROWS) >= 25
    assert len({row[0] for row in ROWS}) == len(ROWS)
    for row in ROWS:
        assert len(row[-2]) > 20, row


def test_the_scene_keys_that_it_names_exist():
    for section, key in re.findall(r"`(bodies|motion|lubricant|surface)\.(\w+)`", PAGE):
        assert hasattr(SECTIONS[section], key) or key in SECTIONS[section].__dataclass_fields__ or key in ("ra",), key
