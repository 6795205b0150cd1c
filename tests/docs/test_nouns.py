"""The nouns of the code have one type each, as docs/architecture.md lists them; and its modules and functions exist."""

import ast
import re

import pytest
from pages import ROOT

PAGE = (ROOT / "docs" / "architecture.md").read_text(encoding="utf-8")
ROOMS = ("estimate", "models", "samples")
# Types that are one kind of the listed one.
KINDS = {
    "RoughContact": ("HalfSpaceContact",),
    "StripSolution": ("MovingStripSolution",),
    "tuple[int, int]": ("MapCoarsening", "NativeCoarsening", "SampleCoarsening"),
}


def nouns() -> dict[str, str]:
    """Return the type of each noun of the table."""
    table = PAGE.partition("## Nouns of the code")[2].partition("\n## ")[0]
    types = {}
    for line in table.splitlines():
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        if line.startswith("| `"):
            names, kinds = (re.findall(r"`([^`]+)`", cell) for cell in cells[:2])
            types |= dict(zip(names, kinds * len(names) if len(kinds) == 1 else kinds, strict=True))
    return types


def annotations() -> list[tuple[str, str, str]]:
    """Return name, annotation and place of every parameter and field of the rooms."""
    rows = []
    for room in ROOMS:
        for path in sorted((ROOT / "lubfric" / room).rglob("*.py")):
            for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
                place = f"{path.relative_to(ROOT)}:{getattr(node, 'lineno', 0)}"
                if isinstance(node, ast.arg) and node.annotation is not None:
                    rows.append((node.arg, ast.unparse(node.annotation), place))
                if isinstance(node, ast.AnnAssign) and isinstance(node.target, ast.Name):
                    rows.append((node.target.id, ast.unparse(node.annotation), place))
    return rows


def bare(annotation: str) -> str:
    """Return the type in an ``annotation``, without None and the collection that holds several."""
    several = re.compile(r"^(?:tuple|list|Iterable|Sequence|Iterator)\[(\w+)(?:, \.\.\.)?\]$")
    return several.sub(r"\1", annotation.removesuffix(" | None"))


def test_a_noun_has_one_type():
    known = nouns()
    assert len(known) >= 14
    rows = [(name, annotation, place) for name, annotation, place in annotations() if name in known]
    assert [row for row in rows if bare(row[1]) not in (known[row[0]], *KINDS.get(known[row[0]], ()))] == []
    assert {name for name, _, _ in rows} == set(known)


@pytest.mark.parametrize("name", sorted(set(re.findall(r"`?((?:[a-z_]+/)*[a-z_0-9]+\.py)`?", PAGE))))
def test_the_modules_of_the_page_exist(name):
    assert list((ROOT / "lubfric").rglob(name)) or (ROOT / name).exists()
