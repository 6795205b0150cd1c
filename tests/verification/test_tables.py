"""Tables in the documents are written by a command: the marks in the pages and the tables that can be measured
agree."""

import pytest

from verification.tables import BLOCK, TABLES, body, main, replaced
from verification.tables.measured import Table

TABLE = Table(["speed", "f"], [["0.1", "0.05"]])


def test_every_mark_in_a_page_names_a_table(root):
    marked = {m["name"] for page in (root / "docs").glob("*.md") for m in BLOCK.finditer(page.read_text())}
    assert marked <= set(TABLES)


def test_only_the_named_table_is_replaced_and_again_gives_the_same():
    one, two = (
        f"<!-- table: {name} -->\n{text}\n<!-- end of table -->\n" for name, text in (("one", "old"), ("two", "kept"))
    )
    page = f"before\n{one}between\n{two}"
    once = replaced(page, "one", body("one", TABLE))
    assert "old" not in once and "kept" in once and "| 0.1 | 0.05 |" in once
    assert once.startswith("before\n") and "\nbetween\n" in once
    assert replaced(once, "one", body("one", TABLE)) == once


def test_the_command_measures_what_is_marked(tmp_path, monkeypatch):
    monkeypatch.setitem(TABLES, "times", lambda: TABLE)
    page = tmp_path / "page.md"
    page.write_text("<!-- table: times -->\n<!-- end of table -->\n")
    assert main(["--only", "times", "--docs", str(tmp_path)]) == 0
    assert "| 0.1 | 0.05 |" in page.read_text()


def test_an_unknown_table_is_refused():
    with pytest.raises(SystemExit) as ended:
        main(["--only", "nothing"])
    assert ended.value.code == 2
