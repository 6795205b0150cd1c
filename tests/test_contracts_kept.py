"""Films and contacts answer by their contracts: nobody outside their packages asks of what kind they are, and nothing
is decided by reading what is said for people."""

import ast
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
FILES = sorted((ROOT / "lubfric").rglob("*.py"))
AT_HOME = ("film", "rough", "ehl", "contact", "halfspace", "paper")  # the packages of films and contacts
CONTRACTS = ("Film", "FilmLevel", "RoughContact", "ContactState")
KEPT_BY = ("EHLResult", "RigidFilm", "ContactResult")  # films and fields by themselves
HELD = ("film", "contact", "fields", "closure", "level", "balance")  # names under which one is held
PROSE = ("text", "notes", "words", "film_words", "deflection", "heat", "consequence", "remedy", "source", "validity")
READ = ("startswith", "endswith", "split", "partition", "rpartition", "find", "index", "count")


@cache
def trees() -> dict[str, ast.AST]:
    """Every module of the library, by its path in it."""
    return {f.relative_to(ROOT / "lubfric").as_posix(): ast.parse(f.read_text("utf-8")) for f in FILES}


@cache
def kinds() -> set[str]:
    """The contracts and every class of the library that inherits one, by name."""
    found = {*CONTRACTS, *KEPT_BY}
    classes = {
        node.name: {base.id for base in node.bases if isinstance(base, ast.Name)}
        for tree in trees().values()
        for node in ast.walk(tree)
        if isinstance(node, ast.ClassDef)
    }
    while more := {name for name, bases in classes.items() if bases & found} - found:
        found |= more
    return found


def last_name(node: ast.expr) -> str:
    """Of ``a.b.c``: c."""
    return node.attr if isinstance(node, ast.Attribute) else node.id if isinstance(node, ast.Name) else ""


def probes(tree: ast.AST, classes: set[str]) -> Iterator[int]:
    """Lines that ask a film or contact of what kind it is or what it has."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Call) and len(node.args) > 1:
            asked, about = last_name(node.func), node.args
            of_kind = asked in ("isinstance", "issubclass", "type") and any(
                last_name(n) in classes for n in ast.walk(about[1]) if isinstance(n, ast.expr)
            )
            if of_kind or asked in ("hasattr", "getattr") and last_name(about[0]) in HELD:
                yield node.lineno


def is_prose(node: ast.expr) -> bool:
    """Something said for people: an attribute of `PROSE`, but for ``numerics.heat``, which is an option."""
    return isinstance(node, ast.Attribute) and node.attr in PROSE and last_name(node.value) != "numerics"


def readings(tree: ast.AST) -> Iterator[int]:
    """Lines that look into a sentence: words in it, how it begins or ends, whether it is a certain one."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Compare):
            sides = [node.left, *node.comparators]
            into = {isinstance(op, (ast.In, ast.NotIn)) for op in node.ops}
            told = [s for s in (sides[1:] if True in into else sides) if is_prose(s)]
            text = [s for s in sides if isinstance(s, (ast.Constant, ast.JoinedStr)) and getattr(s, "value", "") != ""]
            if text and told:
                yield node.lineno
        elif isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and node.func.attr in READ:
            if is_prose(node.func.value):
                yield node.lineno


def test_nobody_else_asks_films_and_contacts_of_what_kind_they_are():
    classes = kinds()
    assert {"HalfSpaceContact", "FlatContact", "AsperityContact"} <= classes
    others = {path: tree for path, tree in trees().items() if path.split("/")[0] not in AT_HOME}
    assert [(path, line) for path, tree in others.items() for line in probes(tree, classes)] == []


def test_nothing_is_decided_by_reading_prose():
    assert [(path, line) for path, tree in trees().items() for line in readings(tree)] == []


@pytest.mark.parametrize(
    "line",
    [
        "isinstance(a.b, FlatContact)",
        "isinstance(start, (int, EHLResult))",
        "hasattr(point.balance.contact, 'heights')",
        "getattr(film, name)",
    ],
)
def test_a_probe_is_seen(line):
    assert list(probes(ast.parse(line), kinds())) == [1]


@pytest.mark.parametrize(
    "line",
    [
        "'whole load' in decision.deflection",
        "found.text.startswith('caution')",
        "entry.text.split('; ')[0]",
        "alpha.source == 'the scene'",
        "'x' not in report.notes",
    ],
)
def test_a_reading_is_seen(line):
    assert list(readings(ast.parse(line))) == [1]


def test_what_is_no_probe_and_no_reading():
    for line in ("isinstance(value, float)", "getattr(scene, name)", "heat == 'on'", "scene.numerics.heat == 'on'"):
        tree = ast.parse(line)
        assert list(probes(tree, kinds())) == [] and list(readings(tree)) == []
