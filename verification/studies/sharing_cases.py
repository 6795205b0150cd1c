"""Load sharing by finite elements beyond the paper's corner: oils, sliding, yielding, the flat contact, a measured
map."""

import math
import tempfile
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import lru_cache
from pathlib import Path

import numpy as np

import lubfric
from lubfric.scene.roughness import Roughness
from lubfric.sharing import Prepared, prepare

from ..check import AT_LEAST, Check, compared
from ..fem.contact import solve_contact
from ..fem.ehl import LineContact
from ..fem.fluid import Fluid
from ..fem.harmonic import Compliance, Strip, compliance
from ..fem.layer_waves import fourier_compliance
from ..fem.sharing import Bodies, FlatBodies, Shared, share_load
from ..parts import the
from .contact_rough import BOX, layer_of, roughness
from .load_sharing import LENGTH, SOURCE, TIGHT, averaged, elastic, rough, rows_of, scene

CELLS = 32
TOLERANCE = {"quick": (3e-3, 1.2e-2, 5e-3), "default": (3e-3, 6e-3, 3e-3), "full": (3e-3, 6e-3, 3e-3)}
REFINEMENTS = {"quick": 0, "default": 1, "full": 1}
EYRING, LIMIT, OFFSET = 1e6, 0.02, 0.3e6  # Pa, 1, Pa: both cut the stress of a part of the film


@dataclass(frozen=True)
class Case:
    """Changed sections of the scene, the fluid that finite elements have instead, and the hardness (Pa)."""

    name: str
    speed: float
    sections: dict = field(default_factory=dict)
    fluid: dict = field(default_factory=dict)
    hardness: float = math.inf


LIMITED = {"eyring_stress": EYRING, "limiting_stress_coefficient": LIMIT, "limiting_stress_offset": OFFSET}
CUT = {"eyring_stress": EYRING, "limiting_stress": (OFFSET, LIMIT)}
HEAVY = {"radius": 1e-3, "load": 20.0}  # Hertz pressure of 350 MPa, at which the laws of the oil matter
SOFT = 1.5e9


def heavy(name: str, oil: dict, fluid: dict) -> Case:
    """A contact in which both limits cut the stress of a part of the film, with more of the oil."""
    return Case(name, 0.1, {"bodies": HEAVY, "lubricant": LIMITED | oil}, CUT | fluid)


CASES = (
    heavy("Eyring with a limiting stress", {}, {}),
    heavy("Dowson-Higginson", {"density_law": "dowson-higginson"}, {"density_law": "dowson_higginson"}),
    heavy("Barus", {"viscosity_law": "barus"}, {"viscosity_law": "barus"}),
    Case("slide-roll 0.1", 0.02, {"motion": {"slide_roll_ratio": 0.1}}),
    Case("slide-roll -2", 0.02, {"motion": {"slide_roll_ratio": -2.0}}),
    Case("yielding cells", 0.01, {"bodies": {"hardness": SOFT}}, hardness=SOFT),
)


def sharing_cases(level: str):
    """What `load_sharing` does at one corner, at others: f, both loads, gap and shear force of `lubfric.friction`.

    They are Eyring's law with a limiting shear stress, a compressible oil, Barus' law, nearly pure rolling and the
    other surface sliding, and a hardness at which cells do yield. Then comes a measured map that has to be turned
    and scaled, on cells that are not square. Last is the nominally flat contact, whose patch is pressed on an
    elastic layer of bricks.
    """
    asked, refinements = TOLERANCE[level], REFINEMENTS[level]
    body, heights = strip(LENGTH / CELLS), rough(CELLS, CELLS)
    for case in CASES[::4] if level == "quick" else CASES:
        s = scene().with_(bodies={"hardness": None}).with_(**case.sections)
        model = averaged(prepare(s, lubfric.Surface(heights, (LENGTH / CELLS,) * 2)))
        found = share_load(cylinder(model, body, heights, case), refinements=refinements)
        main = lubfric.friction(model, case.speed)
        yield from compared(case.name, rows_of(main, found, asked), SOURCE)
        if case.hardness < math.inf:
            yield from yielded(found, main, body, model)
    if level != "quick":
        yield from measured_map(asked, refinements)
    yield from flat(asked, refinements)


@lru_cache(maxsize=2)
def strip(across: float) -> Compliance:
    """The strip of the patch, with cells ``across`` (m) long along y."""
    return compliance(Strip((CELLS, CELLS), (LENGTH / CELLS, across), elastic(), fineness=1))


def line_contact(model: Prepared, case: Case) -> LineContact:
    """The smooth contact under the whole load."""
    b, oil = model.scene.bodies, model.scene.lubricant
    law = {"viscosity_law": "roelands", "pressure_viscosity_coefficient": oil.pressure_viscosity_coefficient}
    return LineContact(b.load / b.width, b.radius, b.e_prime, case.speed, Fluid(oil.viscosity, **law | case.fluid))


def cylinder(model: Prepared, body: Compliance, heights: np.ndarray, case: Case) -> Bodies:
    """The same for the finite elements. They get nothing of ``model`` but numbers of its scene."""
    b = model.scene.bodies
    sliding = model.scene.motion.slide_roll_ratio * case.speed
    f_b = b.boundary_friction_coefficient
    return Bodies(line_contact(model, case), b.width, body, heights, case.hardness, f_b, sliding)


def yielded(found: Shared, main: lubfric.FrictionResult, body: Compliance, model: Prepared):
    """Cells at the hardness, on both sides."""
    weight = model.contact.weight / model.contact.weight.sum()
    share = float(weight @ the(found.pressed, "dry contact").saturated.mean(axis=1))
    words = "yielding cells: share of the strip at the hardness"
    yield Check(f"{words}, finite elements", share, 1e-3, 0.0, "the hardness was chosen so", AT_LEAST)
    yield Check(words, main.plastic_area_fraction, share, 0.1, SOURCE, note="whole cells: a few of them")


def measured_map(allowed, refinements: int):
    """A ground surface in a file: along the other axis, with other cells along it, tilted, and too rough."""
    across = 1.1e-6
    case = Case("measured map", 0.01)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "ground.npy"
        np.save(path, ground(across))
        surface = Roughness(file=str(path), spacing=(across, LENGTH / CELLS), motion_axis="y", sq=100e-9)
        s = scene().with_(bodies={"hardness": None}, surface=surface, contact={"shape": None, "spacing": None})
        model = averaged(prepare(s))
    heights = levelled(ground(across)).T
    heights *= 100e-9 / heights.std()
    found = share_load(cylinder(model, strip(across), heights - heights.mean(), case), refinements=refinements)
    main = lubfric.friction(model, case.speed)
    yield from compared(case.name, rows_of(main, found, allowed), SOURCE)


def ground(across: float) -> np.ndarray:
    """Heights (CELLS, CELLS) m, grooved and skewed, with worn tops and deep scratches, on a tilted plane."""
    rng = np.random.default_rng(5)
    y, x = np.arange(CELLS)[:, None] * across, np.arange(CELLS) * LENGTH / CELLS
    width = CELLS * across
    waves = sum(
        rng.standard_normal() * np.cos(2 * np.pi * (m * x / LENGTH + n * y / width) + rng.uniform(0, 6.3)) / m
        for m in range(2, 8)
        for n in (0, 1)
    )
    return 1e-7 * (waves - 0.35 * waves**2) + 2e-3 * x + 1e-3 * y + 3e-7


def levelled(z: np.ndarray) -> np.ndarray:
    """The heights less their plane of least squares."""
    i, j = np.indices(z.shape)
    terms = np.stack([np.ones(z.size), i.ravel(), j.ravel()], axis=1)
    return z - (terms @ np.linalg.lstsq(terms, z.ravel(), rcond=None)[0]).reshape(z.shape)


def flat(allowed, refinements: int):
    """The paper's nominally flat contact on a patch of few waves."""
    nodes, case = 64, Case("flat", 0.02)
    s = lubfric.load_scene("flat").with_(numerics=TIGHT | {"tolerance": 1e-3})
    x = np.arange(nodes) * BOX / nodes
    heights = roughness(x[:, None], x[None])
    model = prepare(s, lubfric.Surface(heights, (BOX / nodes,) * 2))
    b = s.bodies
    sliding = s.motion.slide_roll_ratio * case.speed
    bodies = FlatBodies(line_contact(model, case), b.width, pressed_layer(32), b.boundary_friction_coefficient, sliding)
    found = share_load(bodies, refinements=refinements, tolerance=1e-4)
    main = lubfric.friction(model, case.speed)
    yield from compared(case.name, rows_of(main, found, allowed), SOURCE)


def pressed_layer(nodes: int) -> Callable[[float], tuple[float, float]]:
    """Mean gap (m) and share in contact of the patch, pressed on a layer of bricks by a mean pressure (Pa)."""
    grid = layer_of(nodes, 2)
    displacement, weights = fourier_compliance(grid).displacement, grid.weights.ravel()
    gap0 = -roughness(*grid.x).ravel()

    def pressed(pressure: float) -> tuple[float, float]:
        found = solve_contact(displacement, weights, gap0, pressure * BOX**2)
        return float(weights @ np.maximum(found.gap, 0) / weights.sum()), float(np.mean(found.pressure > 0))

    return pressed
