"""Nothing is decided by reading what is said for people."""

import ast
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
FILES = sorted((ROOT / "lubfric").rglob("*.py"))
PROSE = (
    "text",
    "status",
    "notes",
    "words",
    "film_words",
    "deflection",
    "heat",
    "consequence",
    "recommendation",
    "source",
    "validity",
)
READ = ("startswith", "endswith", "split", "partition", "rpartition", "find", "index", "count")


@cache
def trees() -> dict[str, ast.AST]:
    """Every module of the library, by its path in it."""
    return {f.relative_to(ROOT / "lubfric").as_posix(): ast.parse(f.read_text("utf-8")) for f in FILES}


def last_name(node: ast.expr) -> str:
    """Of ``a.b.c``: c."""
    return node.attr if isinstance(node, ast.Attribute) else node.id if isinstance(node, ast.Name) else ""


def is_prose(node: ast.expr, names: frozenset[str] = frozenset()) -> bool:
    """Something said for people: an attribute of `PROSE`, but for ``numerics.heat``, which is an option; or one of the
    ``names`` of such texts."""
    if isinstance(node, ast.Name):
        return node.id in names
    return isinstance(node, ast.Attribute) and node.attr in PROSE and last_name(node.value) != "numerics"


def names_of_prose(node: ast.AST) -> frozenset[str]:
    """Names that a loop or a comprehension binds to each of the texts of an attribute of `PROSE`."""
    loops = [node] if isinstance(node, ast.For) else getattr(node, "generators", [])
    return frozenset(last_name(loop.target) for loop in loops if is_prose(loop.iter)) - {""}


def is_text(node: ast.expr) -> bool:
    """A text that is not empty, with or without values in it."""
    return isinstance(node, ast.JoinedStr) or (
        isinstance(node, ast.Constant) and isinstance(node.value, str) and node.value != ""
    )


def readings(node: ast.AST, names: frozenset[str] = frozenset()) -> Iterator[int]:
    """Lines that look into a sentence: words in it, how it begins or ends, whether it is a certain one."""
    names |= names_of_prose(node)
    if isinstance(node, ast.Compare):
        sides = [node.left, *node.comparators]
        into = any(isinstance(op, (ast.In, ast.NotIn)) for op in node.ops)
        stated = [side for side in (sides[1:] if into else sides) if is_prose(side, names)]
        if stated and any(map(is_text, sides)):
            yield node.lineno
    elif isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and node.func.attr in READ:
        if is_prose(node.func.value, names):
            yield node.lineno
    for part in ast.iter_child_nodes(node):
        yield from readings(part, names)


def test_nothing_is_decided_by_reading_prose():
    assert [(path, line) for path, tree in trees().items() for line in readings(tree)] == []


@pytest.mark.parametrize(
    "text, reads",
    [
        ("result.status.startswith('Converged')", True),
        ("[note for note in surface.notes if 'used' in note]", True),
        ("for note in report.notes:\n    note.split()", True),
        ("result.status == CONVERGED", False),
        ("end.status <= 0", False),
        ("[f'{note}.' for note in surface.notes if note]", False),
        ("[note for note in fields if 'used' in note]", False),
    ],
)
def test_a_reading_is_seen(text, reads):
    assert bool([*readings(ast.parse(text))]) == reads
