"""``python -m verification.campaigns.constants [NAME ...]``: what the constants of the estimate decide.

Every number of a module of `ROOMS` (or those whose name begins with NAME) is halved and doubled, alone, and the points
of `points` are solved again. A row says by how much f, the width of its 95 % interval and the processor time change, at
most. A constant that moves f by no more than its stated error is a matter of cost or of caution; one that moves it by
more needs a source of its own, beside it in the code.
"""

import ast
import importlib
import math
import pkgutil
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType

import lubfric

ROOMS = (
    "lubfric.samples",
    "lubfric.estimate",
    "lubfric.models.shared",
    "lubfric.models.load_sharing",
    "lubfric.models.deterministic",
)

# The room whose constants are tried on points of its own.
DETERMINISTIC = "lubfric.models.deterministic"

# Its modules that a point at rest does not reach.
MOVING = ("moving", "moving_strip", "time_and_place", "summits")

# Factors on a constant.
FACTORS = (0.5, 2.0)


def points(module: str = "") -> dict[str, tuple[lubfric.Scene, float]]:
    """Return the points that are solved for a constant of ``module``, by name: light and heavy contact, strips and a
    patch, at rest and moving."""
    paper = lubfric.load_scene("paper")
    if module.rpartition(".")[2] in MOVING:
        rolling = paper.with_(
            bodies={"radius": 6e-3, "width": 10e-3, "load": 500.0, "boundary_film": 2e-8, "hardness": None},
            lubricant={"viscosity": 0.02, "pressure_viscosity_coefficient": 16e-9, "eyring_stress": 5e6},
            motion={"slide_roll_ratio": 0.1},
            surface={"sq": 1.6e-7, "correlation_length": 20e-6, "acf": "gaussian"},
            contact={"shape": (64, 32), "spacing": 5e-6},
            numerics={"model": "deterministic", "sampling_tolerance": 0.05},
        )
        ends = rolling.with_(lubricant={"eyring_stress": [5e6, 3e6, 8e6]})
        return {"rolling": (ends, 1.0)}
    if module.startswith(DETERMINISTIC):
        alone = paper.with_(numerics={"model": "deterministic"})
        patch = alone.with_(numerics={"sampling": "patch"})
        return {"contact": (alone, 0.003), "mixed": (alone, 0.03), "patch": (patch, 0.03)}
    strips = paper.with_(numerics={"model": "paper"})
    return {
        "contact": (strips, 0.001),
        "mixed": (strips, 0.03),
        "lift-off": (strips, 0.1),
        "calibrated": (paper.with_(numerics={"model": "quick"}), 0.03),
        "rolling": (paper.with_(numerics={"model": "quick"}, motion={"slide_roll_ratio": 0.1}), 0.03),
        "patch": (strips.with_(numerics={"sampling": "patch"}), 0.03),
    }


def constants(prefixes: tuple[str, ...]) -> Iterator[tuple[str, str, float | tuple[float, ...]]]:
    """Yield (module, name, value) of every number, or tuple of numbers, in capital letters of the modules of `ROOMS`."""
    for room in ROOMS:
        package = importlib.import_module(room)
        for info in pkgutil.iter_modules(package.__path__, f"{room}."):
            for name, value in numbers_of(importlib.import_module(info.name)):
                if f"{info.name}.{name}".startswith(prefixes):
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
    """A constant that has another value inside, in its module and in all that import it by its name."""

    def __init__(self, module: str, name: str, value: object) -> None:
        self.name = name
        self.value = value
        self.holders = [sys.modules[module]]
        for other, holder in list(sys.modules.items()):
            if other.startswith("lubfric") and other != module and _imports(holder, module, name):
                self.holders.append(holder)
        self.before = [getattr(holder, name) for holder in self.holders]

    def __enter__(self) -> None:
        for holder in self.holders:
            setattr(holder, self.name, self.value)

    def __exit__(self, *exception: object) -> None:
        for holder, value in zip(self.holders, self.before, strict=True):
            setattr(holder, self.name, value)


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


def solve(module: str = "") -> dict[str, tuple[float, float, float]]:
    """Return f, the width of its interval over f, and the processor time [s] of all `points` of ``module``."""
    results = {}
    for name, (scene, speed) in points(module).items():
        begun = time.process_time()
        try:
            result = lubfric.friction(scene, speed, raise_on_failure=False)
            low, high = result.uncertainty.interval
            numbers = (result.coefficient, (high - low) / result.coefficient)
        except lubfric.LubfricError:
            numbers = (math.nan, math.nan)
        results[name] = (*numbers, time.process_time() - begun)
    return results


def main() -> None:
    """Print a row for every constant and factor."""
    prefixes = tuple(sys.argv[1:]) or ("",)
    bases: dict[tuple[str, ...], dict[str, tuple[float, float, float]]] = {}
    print("constant, factor: largest change of f [%] and where, of the width of the interval [%], processor time [%]")
    for module, name, value in constants(prefixes):
        room = tuple(points(module))
        if room not in bases:
            solve(module)  # imports and caches
            bases[room] = solve(module)
        base = bases[room]
        work = sum(row[2] for row in base.values())
        for factor in FACTORS:
            try:
                with Changed(module, name, scaled(value, factor)):
                    rows = solve(module)
            except Exception as error:  # noqa: BLE001  # a value that nothing allows is a result here
                print(f"{module}.{name} = {value} x {factor}: {type(error).__name__}: {str(error)[:60]}", flush=True)
                continue
            changes = {at: row[0] / base[at][0] - 1 for at, row in rows.items()}
            at = max(changes, key=lambda point: math.inf if math.isnan(changes[point]) else abs(changes[point]))
            width = max((rows[point][1] / base[point][1] - 1 for point in rows), key=abs)
            spent = sum(row[2] for row in rows.values()) / work - 1
            words = f"f {100 * changes[at]:+.2g} % ({at}), interval {100 * width:+.2g} %, time {100 * spent:+.0f} %"
            print(f"{module}.{name} = {value} x {factor}: {words}", flush=True)


if __name__ == "__main__":
    main()
