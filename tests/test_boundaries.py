"""Who may import whom: the two sides of the verification do not lean on each other; imports stay light."""

import ast
import importlib
import re
import subprocess
import sys
import tomllib
from functools import cache
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
HEAVY = ("skfem", "pyamg", "meshio", "verification")


@cache
def tree_of(path: Path) -> ast.Module:
    """Return the syntax tree of a file."""
    return ast.parse(path.read_text(encoding="utf-8"))


@cache
def imported(path: Path) -> set[str]:
    """Names of all a file imports, at any depth, also by importlib.import_module("...")."""
    package = path.relative_to(ROOT).parts[:-1]
    result = set()
    for node in ast.walk(tree_of(path)):
        if isinstance(node, ast.Import):
            result |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.level == 0:
            result.add(node.module)
        elif isinstance(node, ast.ImportFrom):
            base = package[: len(package) - node.level + 1]
            result.add(".".join((*base, node.module or "")).rstrip("."))
            result |= {".".join((*base, *filter(None, [node.module]), a.name)) for a in node.names}
        elif isinstance(node, ast.Call) and getattr(node.func, "attr", getattr(node.func, "id", "")) in (
            "import_module",
            "__import__",
        ):
            result |= {a.value for a in node.args if isinstance(a, ast.Constant) and isinstance(a.value, str)}
    return result


def offenders(folder: str, forbidden) -> list[str]:
    """'file imports package' for each import of a forbidden package below ``folder``."""
    files = sorted((ROOT / folder).rglob("*.py"))
    assert files
    return [
        f"{f.relative_to(ROOT)} imports {name}"
        for f in files
        for name in imported(f)
        if any(name == bad or name.startswith(bad + ".") for bad in forbidden)
    ]


def test_lubfric_never_imports_the_verification_nor_its_tools():
    assert offenders("lubfric", HEAVY) == []


def test_finite_elements_never_import_lubfric():
    assert (
        offenders("verification/fem/solvers", ["lubfric", "verification.fem.studies", "verification.fem.published"])
        == []
    )


@pytest.mark.parametrize(
    "name", ["fem/exact", "fem/convergence", "check", "run", "report", "page", "wording", "meshes", "plotting"]
)
def test_closed_forms_and_the_framework_never_import_lubfric(name):
    assert not any(n.split(".")[0] == "lubfric" for n in imported(ROOT / "verification" / f"{name}.py"))


def test_published_numbers_are_a_leaf_that_no_solver_knows():
    """Whoever is held against them has numbers of its own."""
    leaf = "verification.fem.references"
    folder = ROOT / "verification"
    users = {f.relative_to(folder).as_posix() for f in folder.rglob("*.py") if leaf in imported(f)}
    assert {u for u in users if not u.startswith("fem/published/")} == {
        "campaigns/model/boundary_film.py",
        "campaigns/model/rolling.py",
        "campaigns/tables/studies.py",
    }
    own = imported(folder / "fem" / "references.py")
    assert not [name for name in own if name.startswith(("lubfric", "verification", "."))]


def test_load_sharing_is_compared_with_a_kernel_of_its_own():
    names = imported(ROOT / "verification" / "fem" / "studies" / "load_sharing.py")
    assert not {n for n in names if n.endswith(("semiperiodic_coefficients", "even_transform"))}
    assert not {n for n in names if n.startswith("lubfric.contact.")} - {"lubfric.contact.HalfSpace"}


def test_the_estimate_knows_the_contract_of_a_model_and_no_model():
    """Models come from their registry; only a type checker sees what two of them keep of a solve."""
    models = ["lubfric.models.load_sharing", "lubfric.models.deterministic"]
    assert offenders("lubfric/estimate", models) == []
    contract = {
        "ALL_TOUCH",
        "AUTO",
        "NONE_TOUCHES",
        "prepare",
        "ContactFields",
        "MeasuredTime",
        "Model",
        "ModelAnswer",
        "ModelDetails",
        "SampleSolution",
        "SharedWork",
        "WorkEstimate",
        "time_at",
        "with_boundary_friction_at",
        "prepared_with",
        "models_cheaper_than",
        "models_that_may_answer",
        "models_up_to",
        "model_named",
        "title_of",
        "title_to_quote",
    }
    names = set()
    for file in sorted((ROOT / "lubfric" / "estimate").rglob("*.py")):
        typed = set()
        tree = tree_of(file)
        for node in ast.walk(tree):
            if isinstance(node, ast.If) and getattr(node.test, "id", "") == "TYPE_CHECKING":
                typed |= {*ast.walk(node)}
        nodes = [node for node in ast.walk(tree) if isinstance(node, ast.ImportFrom) and node.module == "models"]
        names |= {alias.name for node in nodes if node not in typed for alias in node.names}
    assert "Model" in names and names <= contract


def test_the_registry_of_models_has_the_names_that_a_scene_may_give():
    from lubfric.models import AUTO, MODELS

    keys = tomllib.loads((ROOT / "lubfric" / "keys.toml").read_text(encoding="utf-8"))
    assert {AUTO, *(model.name for model in MODELS)} == set(keys["numerics"]["model"]["one_of"])


def test_only_one_file_knows_meshio():
    files = sorted((ROOT / "verification").rglob("*.py"))
    users = [str(f.relative_to(ROOT)) for f in files if any(n.split(".")[0] == "meshio" for n in imported(f))]
    assert users == ["verification/meshes.py"]


@cache
def questions(package: str) -> list[tuple[str, set[str]]]:
    """Return the file and the names of each question of ``package`` of what kind an object is."""
    asked = []
    for file in sorted((ROOT / package).rglob("*.py")):
        for node in ast.walk(tree_of(file)):
            if isinstance(node, ast.Call) and getattr(node.func, "id", "") in ("isinstance", "issubclass", "type"):
                named = {getattr(part, "id", getattr(part, "attr", "")) for part in ast.walk(node)}
                asked.append((file.name, named))
    return asked


def test_no_solver_asks_a_contact_of_what_kind_it_is():
    """A contact from outside is treated like those of this package."""
    kinds = {
        node.name
        for f in (ROOT / "lubfric" / "contact").rglob("*.py")
        for node in tree_of(f).body
        if isinstance(node, ast.ClassDef) and any(getattr(base, "id", "") == "RoughContact" for base in node.bases)
    }
    requested = [file for file, named in questions("lubfric") if named & kinds]
    assert len(kinds) >= 3 and not requested


def test_a_room_imports_only_rooms_above_it():
    """In the order of the table of docs/architecture.md, which names all of them."""
    table = (ROOT / "docs" / "architecture.md").read_text(encoding="utf-8").partition("\n## ")[0]
    cells = [line.split("|")[1] for line in table.splitlines() if line.startswith("| `")]
    order = list(dict.fromkeys(name.split("/")[0] for cell in cells for name in re.findall(r"`([^`]+)`", cell)))
    folders = {path.parent.name for path in (ROOT / "lubfric").glob("*/__init__.py")}
    assert folders <= set(order)
    wrong = [
        f"{file.relative_to(ROOT)} imports {name}"
        for room in order
        for file in sorted([*(ROOT / "lubfric" / room).rglob("*.py"), *(ROOT / "lubfric").glob(f"{room}.py")])
        for name in imported(file)
        if name.startswith("lubfric.") and name.split(".")[1] in order[order.index(room) + 1 :]
    ]
    assert wrong == []


def kinds_asked(kinds: set[str]) -> set[str]:
    """Return the modules of lubfric and verification that ask an object whether it is one of ``kinds``."""
    asked = [*questions("lubfric"), *questions("verification")]
    return {file for file, named in asked if named & kinds}


@pytest.mark.parametrize(
    "kinds, homes",
    [
        ({"GeneratedStrips", "MeasuredStrips", "OnlyMap", "SinglePatch", "UnresolvedSample"}, set()),
        ({"StripSolution", "MovingStripSolution"}, {"moving_strip.py"}),
        ({"PaperModel", "QuickModel", "DeterministicModel"}, set()),
    ],
)
def test_what_has_a_contract_is_not_asked_of_what_kind_it_is(kinds, homes):
    """Samples, strips and models answer by their contract; a motion on longer cells may have been followed or not."""
    assert kinds_asked(kinds) == homes


def python(code: str) -> str:
    """Output of a fresh interpreter."""
    return subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, cwd=ROOT).stdout


def test_lubfric_works_where_the_verification_tools_are_not_installed():
    blocked = "import sys\n" + "".join(f"sys.modules[{name!r}] = None\n" for name in HEAVY)
    everything = (
        "import importlib, pkgutil, lubfric\n"
        "for m in pkgutil.walk_packages(lubfric.__path__, 'lubfric.'):\n"
        "    if not m.name.endswith('__main__'): importlib.import_module(m.name)\n"
        "print('imported')"
    )
    assert python(blocked + everything).strip() == "imported"


def test_import_lubfric_loads_nothing_beside_itself():
    """Not even `typing`, which takes five times as long as all the rest of it."""
    code = "import sys; before = set(sys.modules); import lubfric; print(*sorted(set(sys.modules) - before))"
    assert [name for name in python(code).split() if not name.startswith("importlib")] == ["lubfric"]


def test_what_a_type_checker_sees_is_what_loads():
    """Every import of the stub loads lazily, from where the stub says; a room keeps no public name to itself."""
    import lubfric

    tree = ast.parse((ROOT / "lubfric" / "__init__.pyi").read_text(encoding="utf-8"))
    imports = {alias.name: node for node in tree.body if isinstance(node, ast.ImportFrom) for alias in node.names}
    assert set(imports) <= set(dir(lubfric)) and set(lubfric.__all__) <= set(imports)
    for name, node in imports.items():
        room = sys.modules["lubfric"] if node.module is None else importlib.import_module(f"lubfric.{node.module}")
        assert node.level == 1 and getattr(lubfric, name) is getattr(room, name)


def arrows_of_imports() -> dict[str, set[str]]:
    """{module: modules it imports} of all modules of lubfric, whenever they import."""
    files = {".".join(f.relative_to(ROOT).with_suffix("").parts): f for f in (ROOT / "lubfric").rglob("*.py")}
    files = {name.removesuffix(".__init__"): f for name, f in files.items() if name != "lubfric.__init__"}
    arrows = {name: {i for i in imported(f) if i in files and i != name} for name, f in files.items()}
    for name, others in arrows.items():  # a module of a package, not the package, where both are named
        arrows[name] = {o for o in others if not any(other.startswith(f"{o}.") for other in others)}
    return arrows


def test_no_circle_of_imports_between_modules():
    assert circles(arrows_of_imports()) == []


def test_no_circle_of_imports_between_packages():
    """Nor between a package and what stands beside it, at any depth: what is above imports what is below."""
    arrows = arrows_of_imports()
    assert len(arrows) > 100
    for depth in (2, 3):
        rooms: dict[str, set[str]] = {}
        for name, others in arrows.items():
            here = ".".join(name.split(".")[:depth])
            rooms.setdefault(here, set()).update({".".join(o.split(".")[:depth]) for o in others} - {here})
        for here, others in rooms.items():
            rooms[here] = {o for o in others if not here.startswith(f"{o}.") and not o.startswith(f"{here}.")}
        assert circles(rooms) == []


def circles(arrows: dict[str, set[str]]) -> list[str]:
    """What is left when everything that imports only what is gone already has been taken away."""
    left = dict(arrows)
    while ground := [name for name, others in left.items() if not others & set(left)]:
        for name in ground:
            del left[name]
    return sorted(left)


def test_listing_the_studies_needs_none_of_the_tools():
    code = (
        "import sys\nfor name in ('skfem', 'meshio', 'pyamg', 'lubfric'): sys.modules[name] = None\n"
        "from verification.__main__ import main\nmain(['--list'])"
    )
    assert "reynolds" in python(code)
