"""Nothing is decided by reading what is said for people."""

import ast
import re
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
    "message",
    "statement",
    "what",
    "summary",
    "advice",
    "warning",
)
READ = ("startswith", "endswith", "split", "partition", "rpartition", "find", "index", "count")
EDITED = ("replace", "removeprefix", "removesuffix")
# Two words of a sentence.
WORDS = re.compile(r"[A-Za-z]{2,}[,:]? [A-Za-z]{2,}")
# Constants of several words that name a thing, as a key does: a part of a table, an enumeration, the progress, an
# option (WITHOUT_ADDED), or the head of a note (UNKNOWN), which a list of such notes omits.
NAMES = frozenset(
    "ASPERITY_LOAD_RATIO BEFORE_STEPS CONVERGED_COLUMN FEW_TOUCH MISSING OF_RUNS_IN_TIME RECORDED UNKNOWN UNUSED WITHOUT_ADDED".split()
)
NAMED_PARTS = ("not given",)
# The readers of files of instruments, which read the words of these.
READERS = "surface/"


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


def is_sentence(node: ast.expr | None) -> bool:
    """A text of several words, which names no part of a table."""
    is_constant = isinstance(node, ast.Constant) and isinstance(node.value, str)
    return is_constant and node.value not in NAMED_PARTS and bool(WORDS.search(node.value))


@cache
def constants() -> frozenset[str]:
    """Names of the constants of the library that are sentences, but for `NAMES`; no two constants have one name."""
    nodes = [node for tree in trees().values() for node in tree.body if isinstance(node, ast.Assign)]
    return frozenset(last_name(node.targets[0]) for node in nodes if is_sentence(node.value)) - NAMES


def is_words(node: ast.expr) -> bool:
    """A sentence, a constant that is one, or a collection with one of them."""
    if isinstance(node, (ast.Tuple, ast.List, ast.Set)):
        return any(map(is_words, node.elts))
    return node.id in constants() if isinstance(node, ast.Name) else is_sentence(node)


def readings(node: ast.AST, names: frozenset[str] = frozenset()) -> Iterator[int]:
    """Lines that look into a sentence: words in it, how it begins or ends, whether it is a certain one; or put words in
    place of others."""
    left = [(node, names)]
    while left:
        (node, outer) = left.pop()
        names = outer | names_of_prose(node)
        left += [(part, names) for part in ast.iter_child_nodes(node)]
        if reads_prose(node, names):
            yield node.lineno


def reads_prose(node: ast.AST, names: frozenset[str]) -> bool:
    """Whether a node itself does so."""
    if isinstance(node, ast.Compare):
        sides = [node.left, *node.comparators]
        into = any(isinstance(op, (ast.In, ast.NotIn)) for op in node.ops)
        stated = [side for side in (sides[1:] if into else sides) if is_prose(side, names)]
        return bool(stated and any(map(is_text, sides))) or any(map(is_words, sides))
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute):
        of_prose = node.func.attr in READ and is_prose(node.func.value, names)
        by_words = node.func.attr in (*READ, *EDITED) and any(
            is_words(part) or isinstance(part, ast.Starred) for part in node.args[:1]
        )
        return of_prose or by_words
    return False


def test_nothing_is_decided_by_reading_prose():
    read = [(path, line) for path, tree in trees().items() for line in readings(tree)]
    assert [place for place in read if not place[0].startswith(READERS)] == []


@pytest.mark.parametrize(
    "text, reads",
    [
        ("result.status.startswith('Converged')", True),
        ("[note for note in surface.notes if 'used' in note]", True),
        ("for note in report.notes:\n    note.split()", True),
        ("result.status == CONVERGED", False),
        ("end.status <= 0", False),
        ("line.startswith('At point')", True),
        ("statement.replace(*words)", True),
        ("self.report.message.partition(': ')", True),
        ("text.replace('sets this limit', 'set this limit')", True),
        ("what == 'lambda ratio of the film'", True),
        ("name == BEFORE_STEPS", False),
        ("name == NO_WARNINGS", True),
        ("key.startswith('surface.')", False),
        ("[f'{note}.' for note in surface.notes if note]", False),
        ("[note for note in fields if 'used' in note]", False),
    ],
)
def test_a_reading_is_seen(text, reads):
    assert bool([*readings(ast.parse(text))]) == reads
