"""Load sharing by finite elements beyond the paper's corner: oils, sliding, yielding, the flat contact, a measured
map."""

import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np

import lubfric
from lubfric.models import prepare
from lubfric.models.shared import Prepared
from lubfric.scene.roughness import Roughness

from ...campaigns.wiring.maps import planed
from ...check import AT_LEAST, Check, Item, compared
from ...types import Keywords
from ..parts import the
from ..solvers.contact import solve_contact
from ..solvers.harmonic import Compliance
from ..solvers.layer_waves import fourier_compliance
from ..solvers.sharing import FlatBodies, SharedLoad, share_load
from .contact_rough import BOX, layer_of, roughness
from .load_sharing import LENGTH, SOURCE, TIGHT, averaged, cylinder, rough, rows_of, scene, strip, whole

CELLS = 32  # in a side of the patch
TOLERANCE = {"quick": (3e-3, 1.2e-2, 5e-3), "default": (3e-3, 6e-3, 3e-3), "full": (3e-3, 6e-3, 3e-3)}
REFINEMENTS = {"quick": 0, "default": 1, "full": 1}
EYRING = 1e6  # Pa, Eyring stress: it cuts the stress of a part of the film
LIMIT = 0.02  # limiting stress over the pressure: it cuts that of another part
OFFSET = 0.3e6  # Pa, limiting stress at ambient pressure


LIMITED = {"eyring_stress": EYRING, "limiting_stress_coefficient": LIMIT, "limiting_stress_offset": OFFSET}
HEAVY = {"bodies": {"radius": 1e-3, "load": 20.0, "hardness": None}}  # 350 MPa of Hertz: the laws of the oil matter
ELASTIC: dict[str, Keywords] = {"bodies": {"hardness": None}}
YIELDING = "yielding cells"
CASES: dict[str, tuple[float, dict[str, Keywords]]] = {  # speed [m/s], and changed sections of the scene
    "Eyring with a limiting stress": (0.1, HEAVY | {"lubricant": LIMITED}),
    "Dowson-Higginson": (0.1, HEAVY | {"lubricant": LIMITED | {"density_law": "dowson-higginson"}}),
    "Barus": (0.1, HEAVY | {"lubricant": LIMITED | {"viscosity_law": "barus"}}),
    "slide-roll 0.1": (0.02, ELASTIC | {"motion": {"slide_roll_ratio": 0.1}}),
    "slide-roll -2": (0.02, ELASTIC | {"motion": {"slide_roll_ratio": -2.0}}),
    YIELDING: (0.01, {"bodies": {"hardness": 1.5e9}}),
}


def sharing_cases(level: str) -> Iterator[Item]:
    """What `load_sharing` does at one corner, at others: f, both loads, gap and shear force of `lubfric.friction`.

    They are Eyring's law with a limiting shear stress, a compressible oil, Barus' law, nearly pure rolling and the
    other surface sliding, and a hardness at which cells do yield. Then comes a measured map that has to be turned
    and scaled, on cells that are not square. Last is the nominally flat contact, whose patch is pressed on an
    elastic layer of bricks.
    """
    allowed = TOLERANCE[level]
    refinements = REFINEMENTS[level]
    body = strip(CELLS, 1)
    heights = rough(CELLS, CELLS)
    for name in list(CASES)[::4] if level == "quick" else CASES:
        speed, sections = CASES[name]
        s = scene().with_(**sections)
        model = averaged(prepare(s, lubfric.Surface(heights, (LENGTH / CELLS,) * 2)))
        solution = share_load(cylinder(s, speed, body, heights), refinements=refinements)
        main = lubfric.friction(model, speed)
        yield from compared(name, rows_of(main, solution, allowed), SOURCE)
        if name == YIELDING:
            yield from yielded(solution, main, body, model)
    if level != "quick":
        yield from measured_map(allowed, refinements)
    yield from flat(allowed, refinements)


def yielded(solution: SharedLoad, main: lubfric.FrictionResult, body: Compliance, model: Prepared) -> Iterator[Item]:
    """Cells at the hardness, on both sides."""
    weight = model.rough_contact.weight / model.rough_contact.weight.sum()
    share = float(weight @ the(solution.pressed, "dry contact").saturated.mean(axis=1))
    words = f"{YIELDING}: share of the strip at the hardness"
    yield Check(
        f"{words}, finite elements",
        share,
        expected=1e-3,
        tolerance=0.0,
        source="the hardness was chosen so",
        kind=AT_LEAST,
    )
    yield Check(
        words,
        main.plastic_area_fraction,
        expected=share,
        tolerance=0.1,
        source=SOURCE,
        note="whole cells: a few of them",
    )


def measured_map(allowed: tuple[float, float, float], refinements: int) -> Iterator[Item]:
    """A ground surface in a file: along the other axis, with other cells along it, tilted, and too rough."""
    across = 1.1e-6
    speed = 0.01
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "ground.npy"
        np.save(path, ground(across))
        surface = Roughness(file=str(path), spacing=(across, LENGTH / CELLS), motion_axis="y", sq=100e-9)
        s = scene().with_(**ELASTIC, surface=surface, contact={"shape": None, "spacing": None})
        model = averaged(prepare(s))
    heights = planed(ground(across)).T
    heights *= 100e-9 / heights.std()
    solution = share_load(
        cylinder(s, speed, strip(CELLS, 1, across), heights - heights.mean()), refinements=refinements
    )
    yield from compared("measured map", rows_of(lubfric.friction(model, speed), solution, allowed), SOURCE)


def ground(across: float) -> np.ndarray:
    """Return heights (CELLS, CELLS) m, grooved and skewed, with worn tops and deep scratches, on a tilted plane."""
    rng = np.random.default_rng(5)
    y = np.arange(CELLS)[:, None] * across
    x = np.arange(CELLS) * LENGTH / CELLS
    width = CELLS * across
    waves = sum(
        rng.standard_normal() * np.cos(2 * np.pi * (m * x / LENGTH + n * y / width) + rng.uniform(0, 6.3)) / m
        for m in range(2, 8)
        for n in (0, 1)
    )
    return 1e-7 * (waves - 0.35 * waves**2) + 2e-3 * x + 1e-3 * y + 3e-7


def flat(allowed: tuple[float, float, float], refinements: int) -> Iterator[Item]:
    """The paper's nominally flat contact on a patch of few waves."""
    nodes = 64
    speed = 0.02
    s = lubfric.load_scene("flat").with_(numerics=TIGHT | {"tolerance": 1e-3})
    x = np.arange(nodes) * BOX / nodes
    heights = roughness(x[:, None], x[None])
    model = prepare(s, lubfric.Surface(heights, (BOX / nodes,) * 2))
    b = s.bodies
    sliding = s.motion.slide_roll_ratio * speed
    bodies = FlatBodies(
        contact=whole(s, speed),
        width=b.width,
        pressed=pressed_layer(32),
        boundary_friction=b.boundary_friction_coefficient,
        sliding=sliding,
    )
    solution = share_load(bodies, refinements=refinements, tolerance=1e-4)
    yield from compared("flat", rows_of(lubfric.friction(model, speed), solution, allowed), SOURCE)


def pressed_layer(nodes: int) -> Callable[[float], tuple[float, float]]:
    """Return mean gap (m) and share in contact of the patch, pressed on a layer of bricks by a mean pressure (Pa)."""
    grid = layer_of(nodes, 2)
    displacement = fourier_compliance(grid).displacement
    weights = grid.weights.ravel()
    gap0 = -roughness(*grid.x).ravel()

    def pressed(pressure: float) -> tuple[float, float]:
        solution = solve_contact(displacement, weights, gap0, pressure * BOX**2)
        return float(weights @ np.maximum(solution.gap, 0) / weights.sum()), float(np.mean(solution.pressure > 0))

    return pressed
