"""Tables in the documents are written by a command: the marks in the pages and the tables that can be measured
agree."""

import importlib
import json
import re
from pathlib import Path

import pytest

from verification.__main__ import main
from verification.campaigns import benchmarks
from verification.campaigns.tables import TABLES
from verification.campaigns.tables.pages import BENCHMARKS, BLOCK, CAMPAIGNS, body, replaced
from verification.campaigns.tables.studies import span
from verification.check import Table

CELLS = (["speed", "f"], [["0.1", "0.05"]])
TABLE = Table("one", "Friction", *CELLS)
TYPED = {  # limits and what drawings ask for, not results
    ("theory.md", "| checked | warning | no answer |"),
    ("inputs.md", "| process | Ra, µm |"),
    ("inputs.md", "| key, name | value (range) | published values |"),
    ("studies.md", "| for each point | |"),  # times of a busy machine, to the order of magnitude
    # checked against the table of solved cases by test_moving_effort.py
    ("measurements.md", "| | contacts | f: rms, largest | asperity load ratio: rms, largest | times faster |"),
    ("measurements.md", "| | f: rms, largest | asperity load ratio: largest | times faster |"),
}


def test_every_mark_in_a_page_names_a_table(root):
    marked = {m["name"] for page in (root / "docs").glob("*.md") for m in BLOCK.finditer(page.read_text())}
    known = [*TABLES, *BENCHMARKS, *(name for names in CAMPAIGNS.values() for name in names)]
    assert marked <= set(known) and len(known) == len(set(known))


def test_a_page_has_no_table_of_results_outside_the_marks(root):
    """A table whose cells are mostly measured numbers stands between marks; `TYPED` are no results."""
    for page in (root / "docs").glob("*.md"):
        for table in re.findall(r"(?:^\|.*\n)+", BLOCK.sub("", page.read_text(encoding="utf-8")), re.MULTILINE):
            cells = [cell for line in table.splitlines()[2:] for cell in line.strip("|").split("|")[1:]]
            measured = [cell for cell in cells if re.match(r"\s*[+-]?\d", cell)]
            assert len(measured) <= len(cells) / 2 or (page.name, table.splitlines()[0]) in TYPED, table


@pytest.mark.parametrize("script", sorted(Path(benchmarks.__path__[0]).glob("*.py")), ids=lambda path: path.stem)
def test_every_benchmark_finds_what_it_measures(script):
    assert importlib.import_module(f"{benchmarks.__name__}.{script.stem}").__doc__


def test_only_the_named_table_is_replaced_and_again_gives_the_same():
    one, two = (
        f"<!-- table: {name} -->\n{text}\n<!-- end of table -->\n" for name, text in (("one", "old"), ("two", "kept"))
    )
    page = f"before\n{one}between\n{two}"
    once = replaced(page, "one", body(TABLE, "c"))
    assert "old" not in once and "kept" in once and "| 0.1 | 0.05 |" in once
    assert once.startswith("before\n") and "\nbetween\n" in once
    assert replaced(once, "one", body(TABLE, "c")) == once


def marked(folder, *names):
    page = folder / "page.md"
    page.write_text("\n".join(f"<!-- table: {name} -->\n<!-- end of table -->\n" for name in names))
    return page


def test_the_command_measures_what_is_marked_and_reports_it(tmp_path, monkeypatch):
    monkeypatch.setitem(TABLES, "times", lambda: CELLS)
    page = marked(tmp_path, "times")
    assert main(["tables", "--only", "times", "--docs", str(tmp_path), "--out", str(tmp_path)]) == 0
    assert "| 0.1 | 0.05 |" in page.read_text() and "tables --only times`" in page.read_text()
    report = json.loads((tmp_path / "report.json").read_text())
    assert report["studies"][0]["tables"][0]["rows"] == [["0.1", "0.05"]]
    assert (tmp_path / "times.csv").read_text().splitlines() == ["speed,f", "0.1,0.05"]


def test_a_table_that_fails_costs_no_other_and_leaves_its_page_as_it_was(tmp_path, monkeypatch):
    monkeypatch.setitem(TABLES, "times", lambda: 1 / 0)
    monkeypatch.setitem(TABLES, "roughness", lambda: (["speed"], []))
    monkeypatch.setitem(TABLES, "stribeck", lambda: CELLS)
    page = marked(tmp_path, "times", "stribeck")
    requested = ["tables", "--only", "times", "roughness", "stribeck", "--docs", str(tmp_path), "--out", str(tmp_path)]
    assert main(requested) == 1
    assert page.read_text().startswith("<!-- table: times -->\n<!-- end of table -->\n")
    assert "| 0.1 | 0.05 |" in page.read_text()
    studies = json.loads((tmp_path / "report.json").read_text())["studies"]
    assert {s["name"]: s["passed"] for s in studies} == {"times": False, "roughness": False, "stribeck": True}


def test_a_span_is_one_word_in_percent():
    assert span([-0.045, 0.19, 0.01], "+") == "-4.5…+19"
    assert span([0.05, 0.05]) == "5" and span([0.00104, 0.004]) == "0.1…0.4"
