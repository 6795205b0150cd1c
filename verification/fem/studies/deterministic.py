"""The deterministic mixed film of lubfric: its limits, its grids, and its film in the same gap by finite elements."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

import lubfric
from lubfric.film import LineContact
from lubfric.models.deterministic import Problem, dry_contact, lay_out, solve_point
from lubfric.oil import Lubricant
from lubfric.surface import Surface

from ...check import ABSOLUTE, Check, Item, compared
from ...types import Keywords
from ..parts import line_contact
from ..solvers.fluid import Fluid
from ..solvers.rough_film import GivenGap, rough_film
from ..waves import smooth_film
from .given_fluid import contact_given_fluid
from .waviness import waviness

RADIUS = 2e-3  # m, of the paper's cylinder
E_PRIME = 231e9  # Pa, E' of the paper's cylinder
VISCOSITY = 0.36  # Pa s, of the paper's oil
ALPHA = 25e-9  # 1/Pa, of the paper's oil
LOAD = 917.0  # N/m, of the paper's cylinder
WIDTH = 90e-6  # m, side of the patch
PRESCRIBED_PRESSURE = 1e8  # Pa: from there on the pressure is prescribed to the finite elements
CASES = {  # cells over 90 µm and speeds [m/s]
    "quick": ((112, (0.1,)),),
    "default": ((128, (0.1,)), (192, (0.03,))),
    "full": ((128, (0.1,)), (192, (0.03,)), (256, (0.1, 0.03, 0.01))),
}


def deterministic(level: str) -> Iterator[Item]:
    """The deterministic model, compared with the smooth film, the dry contact, and finite elements.

    The smooth film is that of `solve_ehl`, the dry contact that of `solve_contact`. Three comparisons are with finite
    elements:

    - The gap of a deterministic solution is given to a Reynolds solver on triangles. The pressure above 100 MPa is
      also given, because the gap of such thin films does not determine it well enough. The solver has to reproduce the
      flow and the load of the film elsewhere. The surface is symmetric, so half of it is enough.
    - The pressure of the fluid is given to a contact solver (`given_fluid`), which has to reproduce cells, pressure
      and load of the asperity contacts.
    - Small waves at rest in an elastic film are compared with the linear response of a full-system solver
      (`waviness`).
    """
    yield from smooth()
    yield from dry()
    for cells, speeds in CASES[level]:
        for speed in speeds:
            yield from same_gap(cells, speed)
    yield from contact_given_fluid(level, contact(0.1))
    yield from waviness(level)


def contact(speed: float) -> LineContact:
    """Return the paper's cylinder."""
    return LineContact(
        load_per_width=LOAD,
        radius=RADIUS,
        e_prime=E_PRIME,
        entrainment_speed=speed,
        lubricant=Lubricant(VISCOSITY, ALPHA),
    )


def surface(cells: int, seed: int = 1) -> Surface:
    """Return a Gaussian surface of 100 nm and 8 µm, over 90 by 70 µm, which is its own mirror image along y."""
    fine = lubfric.generate_surface(
        (256, 128), WIDTH / 256, sq=100e-9, correlation_length=8e-6, acf="gaussian", seed=seed
    )
    mirrored = replace(fine.cropped((256, 100)).periodic(axes=(False, True)), periodic_axes=(True, True))
    return mirrored.resampled(shape=(cells, round(cells * 100 / 256) * 2))


def problem(cells: int, speed: float, seed: int = 1) -> Problem:
    """Return the deterministic problem on that surface."""
    return lay_out(surface(cells, seed), contact(speed), sliding=2 * speed, boundary_friction=0.09, hardness=6e9)


def smooth() -> Iterator[Item]:
    """A surface without roughness."""
    for speed, load in ((0.3, LOAD), (0.1, 20 * LOAD)):
        case: Keywords = {"load_per_width": load, "entrainment_speed": speed, "density_law": "dowson-higginson"}
        case |= {"radius": RADIUS, "e_prime": E_PRIME, "viscosity": VISCOSITY, "pressure_viscosity_coefficient": ALPHA}
        solution = smooth_film(line_contact(case), 2 * speed)
        film = lubfric.solve_ehl(**case, tolerance=1e-4)
        rows = [
            ("smallest film", "m", solution.min_gap, film.min_film, 1e-3),
            ("flow film", "m", solution.flow_film, film.flow_film, 1e-3),
        ]
        yield from compared(f"smooth, {load:g} N/m, {speed:g} m/s", rows, "solve_ehl")


def dry() -> Iterator[Item]:
    """At 2 µm/s the fluid carries nothing, and the dry contact is left."""
    case = problem(64, 2e-6)
    solution = solve_point(case).pressure
    exact = dry_contact(case, tolerance=1e-8).pressure
    difference = np.sqrt(np.mean((solution - exact) ** 2) / np.mean(exact**2))
    yield Check(
        "dry limit: rms of the pressure",
        difference,
        expected=0.0,
        tolerance=0.01,
        source="solve_contact",
        kind=ABSOLUTE,
        grade="B",
    )


def same_gap(cells: int, speed: float) -> Iterator[Item]:
    """Flow and load of the film by finite elements in the gap that was found."""
    case = problem(cells, speed)
    solution = solve_point(case)
    pressure = 0.5 * (solution.pressure + solution.pressure[:, ::-1])
    gap = 0.5 * (solution.gap + solution.gap[:, ::-1])
    contacts = pressure > PRESCRIBED_PRESSURE
    given = GivenGap(
        x=solution.x, dy=case.spacing[1], gap=gap, pressure=pressure, contact=contacts, radius=RADIUS, log=case.edge_log
    )
    judge = rough_film(
        given, Fluid(VISCOSITY, viscosity_law="roelands", pressure_viscosity_coefficient=ALPHA), speed, cells=cells
    )
    half = pressure.shape[1] // 2
    free = ~contacts[:, :half]
    cell = case.spacing[0] / half
    load = pressure[:, :half][free].sum() * cell + solution.inlet_load
    by_elements = judge.pressure[free].sum() * cell + judge.upstream
    rows = [
        ("load of the film", "N/m", by_elements, load, 5e-3),
        ("flow", "m^2/s", judge.flow, solution.flow_film * speed, 5e-3),
    ]
    note = f"{100 * load / LOAD:.0f} % of the load is outside the asperity contacts"
    yield from compared(f"{cells} cells, {speed:g} m/s", rows, "finite elements in the same gap", note)
