"""The size of the house: functions that fit on a screen, few parameters, one idea a module."""

import ast
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from statistics import median

ROOT = Path(__file__).parents[1]
FILES = sorted((ROOT / "lubfric").rglob("*.py"))
LINES, PARAMETERS = 60, 8  # of a function
LONGEST, TYPICAL = 300, 165  # lines of a module
PUBLIC = ("lubfric", "lubfric.time", "lubfric.paper")


def functions(text: str) -> Iterator[tuple[str, int, int]]:
    """(name, lines, parameters without self) of every function, methods and inner ones too."""
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef)):
            a = node.args
            names = [p.arg for p in (*a.posonlyargs, *a.args, *a.kwonlyargs, *filter(None, (a.vararg, a.kwarg)))]
            yield node.name, node.end_lineno - node.lineno + 1, len([n for n in names if n not in ("self", "cls")])


def found() -> list[tuple[str, str, int, int]]:
    return [(str(f.relative_to(ROOT)), *function) for f in FILES for function in functions(f.read_text("utf-8"))]


def test_every_function_fits_on_a_screen():
    assert [(path, name, lines) for path, name, lines, _ in found() if lines > LINES] == []


def test_only_public_solvers_take_many_keywords():
    public = {name for module in PUBLIC for name in dir(import_module(module))}
    many = {(path, name) for path, name, _, count in found() if count > PARAMETERS}
    assert [(path, name) for path, name in sorted(many) if name not in public] == []
    assert len(many) <= 9  # all that there are


def test_a_module_holds_one_idea():
    lengths = {str(f.relative_to(ROOT)): len(f.read_text("utf-8").splitlines()) for f in FILES}
    assert [(path, n) for path, n in lengths.items() if n > LONGEST] == []
    assert median(lengths.values()) <= TYPICAL


def test_what_a_user_imports_is_fifty_names():
    assert len(import_module("lubfric").__all__) <= 50


def test_every_slow_test_exists():
    for name in (ROOT / "tests" / "slow_tests.txt").read_text(encoding="utf-8").split():
        path, test = name.split("::")
        assert f"def {test}(" in (ROOT / "tests" / path).read_text(encoding="utf-8"), name


def test_no_two_test_files_have_one_name(root):
    """pytest takes the second for the first, and collects neither."""
    names = [path.name for path in (root / "tests").rglob("test_*.py")]
    assert sorted(names) == sorted(set(names))
