"""Nothing is decided by reading what is said for people."""

import ast
from collections.abc import Iterator
from functools import cache
from pathlib import Path

ROOT = Path(__file__).parents[1]
FILES = sorted((ROOT / "lubfric").rglob("*.py"))
PROSE = (
    "text",
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


def is_prose(node: ast.expr) -> bool:
    """Something said for people: an attribute of `PROSE`, but for ``numerics.heat``, which is an option."""
    return isinstance(node, ast.Attribute) and node.attr in PROSE and last_name(node.value) != "numerics"


def readings(tree: ast.AST) -> Iterator[int]:
    """Lines that look into a sentence: words in it, how it begins or ends, whether it is a certain one."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Compare):
            sides = [node.left, *node.comparators]
            into = {isinstance(op, (ast.In, ast.NotIn)) for op in node.ops}
            stated = [s for s in (sides[1:] if True in into else sides) if is_prose(s)]
            text = [s for s in sides if isinstance(s, (ast.Constant, ast.JoinedStr)) and getattr(s, "value", "") != ""]
            if text and stated:
                yield node.lineno
        elif isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and node.func.attr in READ:
            if is_prose(node.func.value):
                yield node.lineno


def test_nothing_is_decided_by_reading_prose():
    assert [(path, line) for path, tree in trees().items() for line in readings(tree)] == []
