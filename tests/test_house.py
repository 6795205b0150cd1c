"""What holds for the whole tree: one statement does one thing, one name means one thing, few names for a user."""

import ast
import inspect
import pkgutil
import re
from collections import defaultdict
from collections.abc import Iterator
from dataclasses import fields, is_dataclass
from functools import cache
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path

import pytest

import lubfric
from lubfric.models.shared import Assumption

ROOT = Path(__file__).parents[1]
PACKAGES = ("lubfric", "verification")
# Words that say nothing of what a variable or a function is.
ODD_WORDS = frozenset(
    "found told foretold doubts told_doubts lacks lacking missed missed_share felt beyond grown divided odds enlarged "
    "half_again settled said Rubbing Foretold OneGap judged looks look".split()
)
FRAGMENT = re.compile(r"^(Of|Those|That of|The same|As)\b")
# Two verbs, of which the first was put before an imperative.
TWO_VERBS = re.compile(
    r"^(Return|Yield) (add|assemble|build|compare|compute|draw|factorise|give|make|measure|put|raise|read|run|solve|take|write)\b"
)
# A dotted name of lubfric in backquotes.
DOTTED = re.compile(r"`(lubfric(?:\.\w+)+)\b")
# Where a number comes from: a publication, a standard, a definition, a file, a command, a measurement, or an honest
# choice.
SOURCE = re.compile(
    r"doi|\b(18|19|20)\d\d\b|Eqs?\. ?\(|\b(ISO|DIN|ASTM|SI)\b|docs/|\.(toml|csv)\b|python -m|verification[./]|definition"
    r"|[Mm]easured(?! (map|surface|point|height|area))|[Ff]itted|[Hh]alved|[Hh]alf and twice|[Hh]alf (this value )?(changes|takes)|[Cc]hosen|[Cc]hoice|[Cc]onvention"
    r"|\b[Ff]ollows? from|\b[Aa]s in "
)
# What a module says whose constants have one source.
SOURCE_OF_MODULE = "Constants that name no other source are measured on"
# Numbers of a measurement that stands beside its constant: several of them.
NUMBERS = re.compile(r"(?<![\w.])\.?\d[\d.,]*")
# A statement of a test that imports names from lubfric.
IMPORT_OF_LUBFRIC = re.compile(r"^ *(from lubfric[\w.]* import (?:\([^)]*\)|[^(\n]+))$", re.MULTILINE)
# A docstring or a script inside a test.
LONG_TEXT = re.compile(r'""".*?"""', re.DOTALL)
# Names that tests import from inside a room, of all names that they import from lubfric.
PRIVATE_SHARE = 0.10


@cache
def trees(package: str) -> dict[str, ast.AST]:
    """Return the syntax tree of each module of ``package``, by its path from the root."""
    files = sorted((ROOT / package).rglob("*.py"))
    return {file.relative_to(ROOT).as_posix(): ast.parse(file.read_text(encoding="utf-8")) for file in files}


@cache
def nodes(package: str) -> list[tuple[str, ast.AST]]:
    """Return each node of the syntax trees of ``package`` with the path of its module."""
    return [(path, node) for path, tree in trees(package).items() for node in ast.walk(tree)]


def is_packed(node: ast.AST) -> bool:
    """Return whether a statement binds several names: to as many unrelated values, or one after the other to one value.

    In a swap, or a step of a recurrence, a value reads the name of another. The results of one call are no tuple in the
    source."""
    if not isinstance(node, ast.Assign):
        return False
    if len(node.targets) > 1:
        return True
    target = node.targets[0]
    values = node.value
    if not (isinstance(target, ast.Tuple) and isinstance(values, ast.Tuple) and len(target.elts) == len(values.elts)):
        return False
    names = [ast.unparse(name) for name in target.elts]
    for index, value in enumerate(values.elts):
        read = {ast.unparse(n) for n in ast.walk(value) if isinstance(n, (ast.Name, ast.Attribute))}
        if read & {name for other, name in enumerate(names) if other != index}:
            return False
    return len(names) > 1


def bound_names(node: ast.AST) -> Iterator[str]:
    """Yield the names that a node binds: of a variable, a function or a class."""
    if isinstance(node, (ast.ClassDef, ast.FunctionDef)):
        yield node.name
    elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
        yield node.id


@pytest.mark.parametrize("package", PACKAGES)
def test_one_statement_binds_one_thing(package):
    assert [f"{path}:{node.lineno}" for path, node in nodes(package) if is_packed(node)] == []


@pytest.mark.parametrize(
    "text, packed",
    [("a, b = 1, 2", True), ("a, b = b, a", False), ("a, b = f()", False)]
    + [("a, b = 1 if a else 2, 3", True), ("a, b = b, a + b", False), ("a = b = f()", True), ("(a,) = (1,)", False)],
)
def test_a_packed_statement_is_seen(text, packed):
    assert is_packed(ast.parse(text).body[0]) == packed


@pytest.mark.parametrize("package", PACKAGES)
def test_no_conditional_stands_in_another(package):
    """a if b else c if d else e: statements say the same, one condition after the other."""
    conditionals = [(path, node) for path, node in nodes(package) if isinstance(node, ast.IfExp)]
    nested = [
        f"{p}:{n.lineno}" for p, n in conditionals if isinstance(n.body, ast.IfExp) or isinstance(n.orelse, ast.IfExp)
    ]
    assert len(conditionals) > 0 and nested == []


@pytest.mark.parametrize("package", PACKAGES)
def test_no_two_classes_have_one_name(package):
    homes = defaultdict(set)
    for path, node in nodes(package):
        if isinstance(node, ast.ClassDef):
            homes[node.name].add(path)
    twice = {name: sorted(paths) for name, paths in homes.items() if len(paths) > 1}
    assert twice == {}


def test_no_two_constants_have_one_name():
    """In lubfric a constant means one thing: its value is written once, and imported elsewhere. Type variables
    aside."""
    homes = defaultdict(set)
    for path, tree in trees("lubfric").items():
        for node in tree.body:
            targets = node.targets if isinstance(node, ast.Assign) else [getattr(node, "target", None)]
            names = {getattr(part, "id", "") for target in targets if target is not None for part in ast.walk(target)}
            for name in names:
                if name.isupper() and len(name) > 1:
                    homes[name].add(path)
    assert len(homes) > 0
    assert {name: sorted(paths) for name, paths in homes.items() if len(paths) > 1} == {}


def has_number(node: ast.AST) -> bool:
    """Return whether a value is made of numbers of its own: an index, or what a function or a loop in it has, is
    none."""
    if isinstance(node, ast.Constant):
        return isinstance(node.value, (int, float)) and not isinstance(node.value, bool)
    if isinstance(node, ast.Subscript):
        return has_number(node.value)
    loops = (ast.Lambda, ast.ListComp, ast.DictComp, ast.GeneratorExp)
    return not isinstance(node, loops) and any(map(has_number, ast.iter_child_nodes(node)))


def constants_without_source(tree: ast.Module, text: str) -> list[str]:
    """Return the numeric constants of a module whose comment, beside them or above them and the constants before them,
    neither matches `SOURCE` nor has three numbers, as those of a measurement; none where the module names one for
    all."""
    if SOURCE_OF_MODULE in (ast.get_docstring(tree) or ""):
        return []
    lines = text.splitlines()
    unnamed = []
    for node in tree.body:
        if not isinstance(node, (ast.Assign, ast.AnnAssign)):
            continue
        target = node.targets[0] if isinstance(node, ast.Assign) else node.target
        if not (isinstance(target, ast.Name) and target.id.isupper() and node.value and has_number(node.value)):
            continue
        comments = [line.partition("#")[2] for line in lines[node.lineno - 1 : node.end_lineno]]
        above = lines[: node.lineno - 1]
        while above and above[-1] and not above[-1].startswith("#"):
            above.pop()
        while above and above[-1].startswith("#"):
            comments.append(above.pop().strip("# "))
        comment = " ".join(reversed(comments))
        if not SOURCE.search(comment) and len(NUMBERS.findall(comment)) < 3:
            unnamed.append(target.id)
    return unnamed


def test_every_constant_says_where_it_comes_from():
    without = {
        path: constants_without_source(tree, (ROOT / path).read_text(encoding="utf-8"))
        for path, tree in trees("lubfric").items()
    }
    assert {path: names for path, names in without.items() if names} == {}


@pytest.mark.parametrize(
    "text, without",
    [("A = 1.0  # m: a length", ["A"]), ("A = 1.0  # m: a choice", []), ("# Chosen.\nA = 1\nB = (2, 3)", [])]
    + [("# Chosen.\nA = 1\n\nB = -2", ["B"]), ("# Chosen.\nA = 1\n# A length.\nB = [2]", ["B"]), ("A = NAMES[1]", [])],
)
def test_a_constant_without_a_source_is_seen(text, without):
    assert constants_without_source(ast.parse(text), text) == without


@pytest.mark.parametrize("package", PACKAGES)
def test_names_say_what_a_thing_is(package):
    names = [f"{path} {name}" for path, node in nodes(package) for name in bound_names(node) if name in ODD_WORDS]
    assert names == []


@pytest.mark.parametrize("package", PACKAGES)
def test_a_docstring_is_no_fragment(package):
    kinds = (ast.ClassDef, ast.FunctionDef)
    documented = [(path, node) for path, node in nodes(package) if isinstance(node, kinds) and ast.get_docstring(node)]
    fragments = [f"{path}:{node.lineno}" for path, node in documented if FRAGMENT.match(ast.get_docstring(node))]
    assert fragments == []
    assert [f"{path}:{node.lineno}" for path, node in documented if TWO_VERBS.match(ast.get_docstring(node))] == []


def yields(function: ast.FunctionDef) -> bool:
    """Return whether a function is a generator: it, and no function inside it, yields."""
    waiting = list(function.body)
    while waiting:
        node = waiting.pop()
        if isinstance(node, (ast.Yield, ast.YieldFrom)):
            return True
        if not isinstance(node, (ast.FunctionDef, ast.ClassDef, ast.Lambda)):
            waiting += ast.iter_child_nodes(node)
    return False


@pytest.mark.parametrize("package", PACKAGES)
def test_a_generator_does_not_return(package):
    functions = [(path, node) for path, node in nodes(package) if isinstance(node, ast.FunctionDef)]
    wrong = [
        f"{path}:{node.lineno}"
        for path, node in functions
        if (ast.get_docstring(node) or "").startswith("Return ") and yields(node)
    ]
    assert wrong == []


@pytest.mark.parametrize(
    "text, generator",
    [("yield 1", True), ("for a in b:\n  yield from a", True), ("def g():\n  yield 1", False), ("return 1", False)],
)
def test_a_generator_is_seen(text, generator):
    body = text.replace("\n", "\n  ")
    assert yields(ast.parse(f"def f():\n  {body}").body[0]) == generator


def is_private(module: str, name: str) -> bool:
    """Return whether ``from module import name`` reaches into a room of lubfric: the room does not offer the name."""
    home = import_module(module)
    if name.startswith("_") or any(part.startswith("_") for part in module.split(".")):
        return True
    if hasattr(home, "__path__") or module.count(".") < 2:
        return False
    room = import_module(module.rpartition(".")[0])
    return getattr(room, name, None) is not getattr(home, name)


def test_tests_speak_public_names():
    imports = []
    for file in (ROOT / "tests").rglob("*.py"):
        code = LONG_TEXT.sub("", file.read_text(encoding="utf-8"))
        for text in IMPORT_OF_LUBFRIC.findall(code):
            (node,) = ast.parse(text).body
            imports += [(node.module, alias.name) for alias in node.names]
    private = sorted({f"{module}.{name}" for module, name in imports if is_private(module, name)})
    count = sum(is_private(module, name) for module, name in imports)
    assert count <= PRIVATE_SHARE * len(imports), private


def public_functions() -> Iterator[tuple[str, object]]:
    """Yield the functions, and the methods of the classes, that lubfric and its rooms offer, each once with its
    name."""
    rooms = [lubfric]
    rooms += [import_module(m.name) for m in pkgutil.iter_modules(lubfric.__path__, "lubfric.") if m.ispkg]
    offered = {}
    for room in rooms:
        for name in getattr(room, "__all__", None) or [name for name in vars(room) if not name.startswith("_")]:
            thing = getattr(room, name)
            if str(getattr(thing, "__module__", "")).startswith("lubfric"):
                offered[f"{thing.__module__}.{getattr(thing, '__qualname__', name)}"] = thing
    for name, thing in offered.items():
        if inspect.isfunction(thing):
            yield name, thing
        elif inspect.isclass(thing):
            methods = {
                key: value for key, value in vars(thing).items() if inspect.isfunction(value) and value.__name__ == key
            }
            yield from ((f"{name}.{key}", value) for key, value in methods.items() if not key.startswith("_"))


def test_parameters_of_public_functions_have_types():
    untyped = [
        f"{name}({key})"
        for name, function in public_functions()
        for key, parameter in inspect.signature(function).parameters.items()
        if key not in ("self", "cls") and parameter.annotation is parameter.empty
    ]
    assert untyped == []


def test_parameters_of_the_verification_have_types():
    functions = [(path, node) for path, node in nodes("verification") if isinstance(node, ast.FunctionDef)]
    untyped = [
        f"{path}: {node.name}({argument.arg})"
        for path, node in functions
        for argument in (*node.args.args, *node.args.kwonlyargs, node.args.vararg, node.args.kwarg)
        if argument is not None and argument.annotation is None and argument.arg not in ("self", "cls")
    ]
    assert untyped == []


def records(package: str) -> Iterator[tuple[str, type]]:
    """Yield the dataclasses of a package with their names."""
    for info in pkgutil.walk_packages(import_module(package).__path__, f"{package}."):
        if not info.name.endswith("__main__"):
            members = inspect.getmembers(import_module(info.name), is_dataclass)
            yield from ((name, kind) for name, kind in members if getattr(kind, "__module__", "") == info.name)


@pytest.mark.parametrize("package", PACKAGES)
def test_records_of_more_than_four_fields_are_filled_by_keyword(package):
    """All their fields, or all but the first few, which a user fills; mypy holds the calls to this."""
    by_position = [
        name
        for name, kind in records(package)
        if inspect.isclass(kind) and sum(field.init and not field.kw_only for field in fields(kind)) > 4
    ]
    assert by_position == []


def resolves(name: str) -> bool:
    """Return whether a dotted ``name`` is that of a module, or of an attribute or a field of what is in one."""
    first, *others = name.split(".")
    thing = import_module(first)
    path = first
    for part in others:
        path = f"{path}.{part}"
        if hasattr(thing, part):
            thing = getattr(thing, part)
        elif inspect.isclass(thing) and part in getattr(thing, "__dataclass_fields__", {}):
            thing = None
        elif hasattr(thing, "__path__") and find_spec(path):
            thing = import_module(path)
        else:
            return False
    return True


def test_names_in_docstrings_and_pages_exist():
    files = [path for folder in (*PACKAGES, "docs", "tests") for path in (ROOT / folder).rglob("*.*")]
    files = [path for path in (*files, *ROOT.glob("*.md")) if path.suffix in (".py", ".md", ".toml")]
    quoted = {name: path for path in files for name in DOTTED.findall(path.read_text(encoding="utf-8"))}
    assert len(quoted) > 0
    assert {name: str(path) for name, path in quoted.items() if not resolves(name)} == {}


@pytest.mark.parametrize("name, there", [("lubfric.models.Model.solve", True), ("lubfric.estimate.response", False)])
def test_a_name_that_does_not_exist_is_seen(name, there):
    assert resolves(name) == there


def test_what_a_user_imports_is_fifty_names():
    assert len(import_module("lubfric").__all__) <= 50


def test_every_slow_test_exists():
    for name in (ROOT / "tests" / "slow_tests.txt").read_text(encoding="utf-8").split():
        (path, *_, test) = name.split("::")
        assert f"def {test}(" in (ROOT / "tests" / path).read_text(encoding="utf-8"), name


def test_no_two_test_files_have_one_name():
    """pytest takes the second for the first, and collects neither."""
    names = [path.name for path in (ROOT / "tests").rglob("test_*.py")]
    assert sorted(names) == sorted(set(names))


def test_every_violation_says_which_assumption_it_is_of():
    """By a member of `Assumption`, and each member is that of one place or of two in one module."""
    used = defaultdict(set)
    unnamed = []
    for path, node in nodes("lubfric"):
        if isinstance(node, ast.Call) and getattr(node.func, "id", "") == "Violation" and node.keywords[0].arg:
            named = [
                k.value.attr for k in node.keywords if k.arg == "assumption" and isinstance(k.value, ast.Attribute)
            ]
            unnamed += [] if named else [f"{path}:{node.lineno}"]
            used.update({name: {*used[name], path} for name in named})
    assert unnamed == []
    assert all(len(paths) == 1 for paths in used.values())
    assert {*used, "STRESS_OF_OILS_UNDER_TOTAL_LOAD"} == set(Assumption.__members__)
