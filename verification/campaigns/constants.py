"""``python -m verification.campaigns.constants [NAME ...]``: what the constants of the solvers decide.

Every number of a module of `ROOMS` (or those whose name begins with NAME) is halved and doubled, alone, and the points
of `points` are solved again. A row of ``constants.csv`` says by how much f, the width of its 95 % interval and the
counted work change, at most. A constant that moves f by no more than its stated error is a matter of cost or of
caution; one that moves it by more needs a source of its own, beside it in the code. Rows that are there stay; remove
them to measure them again.
"""

import ast
import importlib
import inspect
import math
import pkgutil
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from types import ModuleType
from typing import Any

import lubfric
from lubfric._base import limited_work
from lubfric.scene import Harmonic, Ramp, Transient

from . import table_file

ROOMS = (
    "lubfric.film",
    "lubfric.contact",
    "lubfric.time",
    "lubfric.samples",
    "lubfric.estimate",
    "lubfric.models.shared",
    "lubfric.models.load_sharing",
    "lubfric.models.quick",
    "lubfric.models.deterministic",
)

# The rooms whose constants are tried on points of their own.
FILM = "lubfric.film"
CONTACT = "lubfric.contact"
TIME = "lubfric.time"
QUICK = "lubfric.models.quick"
DETERMINISTIC = "lubfric.models.deterministic"

# Modules of `DETERMINISTIC` that a point at rest does not reach.
MOVING = ("moving", "moving_strip", "time_and_place", "summits", "cells_in_motion", "rough_bodies")

# Modules whose numbers move no f: they estimate work, which `verification.campaigns.estimates` compares, or warn.
OTHERS = (
    *("estimated_work", "estimated", "expected_steps", "expected_friction", "counted_work"),
    *("checks", "checks_before", "violation", "wording"),
)

# Numbers that are names of kinds of cells, which have no half.
KINDS = ("FLUID", "RUPTURED", "TOUCHING")

# Factors on a constant.
FACTORS = (0.5, 2.0)

# The table, and the columns of it.
TABLE = Path(__file__).with_name("constants.csv")
COLUMNS = ("module", "constant", "value", "factor", "f", "at", "interval", "work", "error")

# Digits of the changes.
DIGITS = 2

# f, the width of its interval over f, and the counted work [s] of a point.
Numbers = tuple[float, float, float]


def points(module: str) -> dict[str, Callable[[], Numbers]]:
    """Return the points that are solved for a constant of ``module``, by name: light and heavy contact, strips and a
    patch, at rest and moving."""
    room, _, last = module.rpartition(".")
    paper = lubfric.load_scene("paper")
    load_sharing = paper.with_(numerics={"model": "paper"})
    patch = load_sharing.with_(numerics={"sampling": "patch"})
    mixed = {"mixed": _at(load_sharing, 0.03)}
    if room == FILM:
        heavy = {"radius": 10e-3, "load": 1500.0}
        heat = {"temperature_coefficient": 0.04, "temperature": 313.0}
        hot = load_sharing.with_(
            lubricant=heat | {"shear_modulus": 1e8, "eyring_stress": 5e6}, motion={"slide_roll_ratio": 0.1}
        )
        thin = {"viscosity": 0.05, "eyring_stress": 5e6}
        return {
            "light": _at(load_sharing, 1.0),
            "starved": _at(load_sharing.with_(lubricant={"inlet_length": 6e-5}), 0.5),
            "fed": _at(load_sharing.with_(lubricant={"inlet_film": 3e-7}), 1.0),
            "heavy": _at(load_sharing.with_(bodies=heavy, lubricant=thin), 3.0),
            "hot": _at(hot, 1.0),
            "Carreau": _at(load_sharing.with_(lubricant={"carreau": [1e5, 0.6]}), 0.5),
        }
    if room == CONTACT:
        flat = lubfric.load_scene("flat").with_(contact={"shape": (256, 256)})
        return mixed | {
            "contact": _at(load_sharing, 0.001),
            "patch": _at(patch, 0.03),
            "flat": _at(flat, 0.03),
            "flat, thin": _at(flat, 0.003),
        }
    if room == TIME:
        swing = Transient(duration=0.02, speed=Harmonic(amplitude=0.03, frequency=50.0))
        ramp = Transient(duration=1e-4, outputs=4, speed=Ramp(start=0.03, end=0.02, until=1e-4))
        loose = patch.with_(numerics={"tolerance": 0.05, "accept": True})
        small = {"shape": (64, 64), "spacing": 1.4e-6}
        reversing = loose.with_(transient=swing)
        slowed = loose.with_(numerics={"model": "deterministic"}, contact=small, transient=ramp)
        return {"reversing": _in_time(reversing), "slowed": _in_time(slowed)}
    if room == DETERMINISTIC and last in MOVING:
        rolling = paper.with_(
            bodies={"radius": 6e-3, "width": 10e-3, "load": 500.0, "boundary_film": 2e-8, "hardness": None},
            lubricant={
                "viscosity": 0.02,
                "pressure_viscosity_coefficient": 16e-9,
                "eyring_stress": [5e6, 3e6, 8e6],
            },
            motion={"slide_roll_ratio": 0.1},
            surface={"sq": 1.6e-7, "correlation_length": 20e-6, "acf": "gaussian"},
            contact={"shape": (64, 32), "spacing": 5e-6},
            numerics={"model": "deterministic", "sampling_tolerance": 0.05},
        )
        return {"rolling": _at(rolling, 1.0)}
    if room == DETERMINISTIC:
        alone = paper.with_(numerics={"model": "deterministic"})
        map_alone = alone.with_(numerics={"sampling": "patch"})
        return {"contact": _at(alone, 0.003), "mixed": _at(alone, 0.03), "patch": _at(map_alone, 0.03)}
    quick = paper.with_(numerics={"model": "quick"})
    if room == QUICK:
        rolling = quick.with_(motion={"slide_roll_ratio": 0.1})
        return {"calibrated": _at(quick, 0.03), "rolling": _at(rolling, 0.03)}
    lift_off = {"lift-off": _at(load_sharing, 0.1), "patch": _at(patch, 0.03)}
    return mixed | lift_off | {"contact": _at(load_sharing, 0.001)}


def _at(scene: lubfric.Scene, speed: float) -> Callable[[], Numbers]:
    """Return what solves a steady point."""

    def solved() -> Numbers:
        with limited_work(math.inf) as meter:
            result = lubfric.friction(scene, speed, raise_on_failure=False)
        low, high = result.uncertainty.interval
        return result.coefficient, (high - low) / result.coefficient, meter.spent

    return solved


def _in_time(scene: lubfric.Scene) -> Callable[[], Numbers]:
    """Return what solves a run in time, whose f is the mean."""

    def solved() -> Numbers:
        with limited_work(math.inf) as meter:
            run = lubfric.transient(scene)
        mean = run.average()
        low, high = mean.interval
        return mean.coefficient, (high - low) / mean.coefficient, meter.spent

    return solved


def constants(prefixes: tuple[str, ...]) -> Iterator[tuple[str, str, float | tuple[float, ...]]]:
    """Yield (module, name, value) of every number, or tuple of numbers, in capital letters of the modules of
    `ROOMS`."""
    for room in ROOMS:
        package = importlib.import_module(room)
        for info in pkgutil.iter_modules(package.__path__, f"{room}."):
            if info.name.rpartition(".")[2] in OTHERS:
                continue
            for name, value in numbers_of(importlib.import_module(info.name)):
                if f"{info.name}.{name}".startswith(prefixes) and name not in KINDS:
                    yield info.name, name, value


def numbers_of(module: ModuleType) -> Iterator[tuple[str, float | tuple[float, ...]]]:
    """Yield (name, value) of every number, or tuple of numbers, in capital letters that ``module`` itself defines."""
    for node in ast.parse(Path(str(module.__file__)).read_text(encoding="utf-8")).body:
        names = [node.target] if isinstance(node, ast.AnnAssign) else getattr(node, "targets", [])
        for target in names:
            name = getattr(target, "id", "")
            value = getattr(module, name, None) if name.isupper() else None
            numbers = value if isinstance(value, tuple) else (value,)
            real = all(isinstance(x, (int, float)) and not isinstance(x, bool) for x in numbers)
            if value is not None and numbers and real:
                yield name, value


def scaled(value: float | tuple[float, ...], factor: float) -> float | tuple[float, ...]:
    """Return ``value`` times ``factor``, whole numbers as whole numbers."""
    if isinstance(value, tuple):
        return tuple(type(x)(x * factor) for x in value)
    return type(value)(value * factor)


class Changed:
    """A constant that has another value inside, in its module, in all that import it by its name, and where it is the
    default of a parameter there."""

    def __init__(self, module: str, name: str, value: object) -> None:
        self.name = name
        self.value = value
        self.holders = [sys.modules[module]]
        for other, holder in list(sys.modules.items()):
            if other.startswith("lubfric") and other != module and _imports(holder, module, name):
                self.holders.append(holder)
        self.before: list[tuple[Any, str, Any]] = []

    def __enter__(self) -> None:
        for holder in self.holders:
            for function, parameters in _with_default(holder, self.name):
                self._change_defaults(function, parameters)
            self._set(holder, self.name, self.value)
        _forget()

    def __exit__(self, *exception: object) -> None:
        for thing, attribute, value in self.before:
            setattr(thing, attribute, value)
        _forget()

    def _set(self, thing: Any, attribute: str, value: object) -> None:
        self.before.append((thing, attribute, getattr(thing, attribute)))
        setattr(thing, attribute, value)

    def _change_defaults(self, function: Any, parameters: list[str]) -> None:
        keywords = dict(function.__kwdefaults__ or {})
        every = inspect.signature(function).parameters.values()
        positional = [one for one in every if one.default is not one.empty and one.name not in keywords]
        keywords |= {name: self.value for name in parameters if name in keywords}
        values = [self.value if one.name in parameters else one.default for one in positional]
        self._set(function, "__defaults__", tuple(values) or None)
        self._set(function, "__kwdefaults__", keywords or None)


def _with_default(module: ModuleType, constant: str) -> Iterator[tuple[Any, list[str]]]:
    """Yield the functions, methods and records of ``module`` with a ``constant`` as default, and the names of these
    parameters."""
    tree = ast.parse(Path(str(module.__file__)).read_text(encoding="utf-8"))
    holders: list[tuple[Any, ast.Module | ast.ClassDef]] = [(module, tree)]
    holders += [(getattr(module, node.name), node) for node in tree.body if isinstance(node, ast.ClassDef)]
    for holder, body in holders:
        for node in body.body:
            if isinstance(node, ast.FunctionDef):
                every = node.args.args
                pairs: list[tuple[ast.arg, ast.expr | None]] = []
                pairs += zip(every[len(every) - len(node.args.defaults) :], node.args.defaults, strict=True)
                pairs += zip(node.args.kwonlyargs, node.args.kw_defaults, strict=True)
                names = [
                    argument.arg for argument, value in pairs if isinstance(value, ast.Name) and value.id == constant
                ]
                if names:
                    function = inspect.unwrap(getattr(holder, node.name))
                    yield getattr(function, "__func__", function), names
            elif isinstance(node, ast.AnnAssign) and getattr(node.value, "id", "") == constant:
                yield holder.__init__, [ast.unparse(node.target)]  # the field of a record


def _forget() -> None:
    """Clear the caches of all functions of lubfric: what they remember was made with another constant."""
    for name, module in list(sys.modules.items()):
        if name.startswith("lubfric"):
            for function in vars(module).values():
                clear = getattr(function, "cache_clear", None)
                if clear is not None:
                    clear()


def _imports(holder: object, module: str, name: str) -> bool:
    """Return whether the module ``holder`` has ``name`` from ``module`` or its package."""
    if not hasattr(holder, name) or getattr(holder, "__file__", None) is None:
        return False
    room = module.rpartition(".")[0].rpartition(".")[2]
    last = module.rpartition(".")[2]
    for node in ast.walk(ast.parse(Path(str(holder.__file__)).read_text(encoding="utf-8"))):  # type: ignore[attr-defined]
        if isinstance(node, ast.ImportFrom) and (node.module or "").rpartition(".")[2] in (room, last):
            if any(alias.name == name for alias in node.names):
                return True
    return False


def solve(module: str) -> dict[str, Numbers]:
    """Return the numbers of all `points` of ``module``; NaN where one has no solution."""
    results = {}
    for name, solved in points(module).items():
        try:
            results[name] = solved()
        except lubfric.LubfricError:
            results[name] = (math.nan, math.nan, math.nan)
    return results


def row_of(base: dict[str, Numbers], module: str, name: str, changed: Any) -> dict[str, Any]:
    """Return the columns of the changes from ``base`` where the constant ``name`` has the value ``changed``; an
    ``error`` where nothing allows that value."""
    try:
        with Changed(module, name, changed):
            rows = solve(module)
    except Exception as error:  # noqa: BLE001  # a value that nothing allows is a result here
        return {"error": f"{type(error).__name__}: {str(error)[:60]}"}
    changes = {at: row[0] / base[at][0] - 1 for at, row in rows.items()}
    at = max(changes, key=lambda point: math.inf if math.isnan(changes[point]) else abs(changes[point]))
    widths = [rows[point][1] / base[point][1] - 1 for point in rows if not math.isnan(base[point][1])]
    return {
        "f": changes[at],
        "at": at,
        "interval": max(widths, key=abs) if widths else None,
        "work": sum(row[2] for row in rows.values()) / sum(row[2] for row in base.values()) - 1,
    }


def main() -> None:
    """Append a row for every constant and factor that the table lacks."""
    prefixes = tuple(sys.argv[1:]) or ("",)
    known = {("lubfric." + row["module"], row["constant"], float(row["factor"])) for row in table_file.rows(TABLE)}
    bases: dict[tuple[str, ...], dict[str, Numbers]] = {}
    for module, name, value in constants(prefixes):
        room = tuple(points(module))
        for factor in FACTORS:
            if (module, name, factor) in known:
                continue
            if room not in bases:
                solve(module)  # imports and caches
                bases[room] = solve(module)
            row = {"module": module.removeprefix("lubfric."), "constant": name, "value": str(value), "factor": factor}
            row |= row_of(bases[room], module, name, scaled(value, factor))
            table_file.append(TABLE, COLUMNS, row, DIGITS)
            print(row, flush=True)


if __name__ == "__main__":
    main()
