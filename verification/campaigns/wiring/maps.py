"""Wiring of the height map: every key of a surface from a file, and of a generated one."""

import itertools
import tempfile
from collections.abc import Iterator
from pathlib import Path

import numpy as np

import lubfric
from lubfric.contact import HalfSpaceContact
from lubfric.models import prepare
from lubfric.scene.roughness import Roughness

from ...check import ABSOLUTE, AT_LEAST, AT_MOST, Check, Item
from ...fem.parts import half_space
from ...types import Keywords

DX = 0.8e-6  # m, spacing of the file along its first axis
DY = 1.3e-6  # m, along its second axis
OWN = "the file, read and changed by plain NumPy"
SIZE = (56, 40)
PATCH = lubfric.load_scene("paper").with_(numerics={"model": "paper", "sampling": "patch", "grid": "given"})


def wiring_maps(level: str) -> Iterator[Item]:
    """What becomes of a file: its axes, cells, unit, form, height and edges, each done again by plain NumPy.

    Of a generated map, its height and its lengths.
    """
    with tempfile.TemporaryDirectory() as folder:
        yield from measured(Path(folder))
    yield from generated()


def ground() -> np.ndarray:
    """Return heights (56, 40) m, grooved along the first axis."""
    rng = np.random.default_rng(8)
    x = np.arange(SIZE[0])[:, None] / SIZE[0]
    y = np.arange(SIZE[1]) / SIZE[1]
    z = np.zeros(SIZE)
    for m, n in itertools.product((0, 1), range(1, 9)):
        z += rng.standard_normal() * np.cos(2 * np.pi * (m * x + n * y) + m) / n
    return 1e-7 * (z - 0.2 * z**2)


def planed(z: np.ndarray, order: int = 1) -> np.ndarray:
    """Return the map less its polynomial of least squares, of first or second order."""
    i, j = (a.ravel() / a.max() for a in np.indices(z.shape))
    terms = np.stack([i**p * j**q for p in range(order + 1) for q in range(order + 1 - p)], axis=1)
    return z - (terms @ np.linalg.lstsq(terms, z.ravel(), rcond=None)[0]).reshape(z.shape)


def measured(folder: Path) -> Iterator[Item]:
    """The map that the contact gets, case by case: the largest height error over Sq, and both cell lengths."""
    z = ground()
    np.save(folder / "z.npy", z)
    np.save(folder / "um.npy", 1e6 * z)
    tilted = z + 1e-8 * np.arange(SIZE[0])[:, None] + 3e-10 * (np.arange(SIZE[1]) - 9) ** 2
    np.save(folder / "tilted.npy", tilted)
    flat = planed(z)
    along = planed(z).T
    blocks = flat.reshape(28, 2, 20, 2).mean(axis=(1, 3))
    cases: dict[str, tuple[Keywords, Keywords, np.ndarray, tuple[float, float]]] = {
        "as it is": ({}, {}, flat, (DX, DY)),
        "unit": ({"file": "um.npy", "unit": "um"}, {}, flat, (DX, DY)),
        "form": ({"file": "tilted.npy", "form": "quadratic"}, {}, planed(tilted, 2), (DX, DY)),
        "motion_axis": ({"motion_axis": "y"}, {}, along, (DY, DX)),
        "sq": ({"sq": 50e-9}, {}, flat * 50e-9 / flat.std(), (DX, DY)),
        "spacing": ({}, {"spacing": (2 * DX, 2 * DY)}, blocks, (2 * DX, 2 * DY)),
        "shape": ({}, {"shape": (40, 30)}, flat[8:48, 5:35], (DX, DY)),
    }
    for name, (surface, contact, expected, cells) in cases.items():
        keys: Keywords = {"file": "z.npy", "spacing": (DX, DY)} | surface
        result = made(Roughness(**keys | {"file": str(folder / keys["file"])}), contact)
        heights = expected - expected.mean()
        off = (
            np.inf if result.heights.shape != heights.shape else np.abs(result.heights - heights).max() / heights.std()
        )
        yield Check(
            f"map, {name}: largest error over Sq",
            min(off, 1e9),
            expected=0.0,
            tolerance=1e-6,
            source=OWN,
            kind=ABSOLUTE,
        )
        for axis in range(2):
            yield Check(
                f"map, {name}: cell along {'xy'[axis]}",
                result.spacing[axis],
                expected=cells[axis],
                tolerance=1e-9,
                source=OWN,
                unit="m",
            )


def made(rough: Roughness, contact: Keywords) -> HalfSpaceContact:
    """Return the rough contact that a scene with this surface gets."""
    s = PATCH.with_(surface=rough, contact={"shape": None, "spacing": None} | contact)
    return half_space(prepare(s))


def generated() -> Iterator[Item]:
    """Check the height, the correlation length at the given level along each axis, and that another seed gives another
    map."""
    maps = {}
    for seed in (1, 2):
        rough = Roughness(sq=80e-9, correlation_length=(3e-6, 6e-6), acf="gaussian", decay_level=0.2, seed=seed)
        s = PATCH.with_(surface=rough, contact={"shape": (512, 512), "spacing": 0.5e-6})
        maps[seed] = prepare(s).surface.heights
    z = maps[1] - maps[1].mean()
    yield Check(
        "generated map: Sq", float(z.std()), expected=80e-9, tolerance=1e-6, source="the requested value", unit="m"
    )
    for axis, (name, length) in enumerate((("x", 3e-6), ("y", 6e-6))):
        cells = round(length / 0.5e-6)
        value = float(np.mean(z * np.roll(z, cells, axis)) / np.mean(z * z))
        words = f"generated map: autocorrelation at the length along {name}"
        yield Check(words, value, expected=0.2, tolerance=0.06, source="the requested value", kind=ABSOLUTE)
    far = float(np.mean(z * np.roll(z, 24, 0)) / np.mean(z * z))
    yield Check(
        "generated map: autocorrelation at four lengths",
        abs(far),
        expected=0.0,
        tolerance=0.12,
        source="Gaussian: none left",
        kind=AT_MOST,
    )
    apart = float(np.sqrt(np.mean((maps[1] - maps[2]) ** 2)) / 80e-9)
    yield Check(
        "generated map: difference of two seeds over Sq",
        apart,
        expected=1.2,
        tolerance=0.0,
        source="independent: 1.41",
        kind=AT_LEAST,
    )
