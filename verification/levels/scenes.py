"""Two hundred scenes over the whole range that a user may ask for: Sobol points, seeded.

What a scene leaves open is chosen so that a full solve is both possible and trustworthy:

- steel on steel, E' = 231 GPa, 10 mm wide, f_b = 0.1, sliding with a slide-roll ratio of 2;
- Roelands viscosity (alpha below 1.5 /GPa: constant) with Ree-Eyring shear at 5 MPa and a limiting shear stress of 1
  MPa plus 5 % of the pressure: the Newtonian law of the paper gives friction far above 1 at gigapascals, and a relative
  error of such a number says nothing;
- half of the scenes elastic, half with a plastic limit of 3 GPa, or 1.5 times the mean Hertz pressure where that is
  more;
- a Gaussian autocorrelation, 24 cells to the correlation length (and 4 to the Hertz strip): its contact converges with
  the grid, so the error of the reference can be checked against a finer one (an exponential one has detail at every
  scale and no limit);
- a patch of 12 correlation lengths along the line, and as long as contact may reach across it: the Hertz strip and
  where the gap of the undeformed cylinder is below three standard deviations of the heights, and a third more;
- accepted where an assumption does not hold: both sides rest on it.
"""

from __future__ import annotations

import math

import numpy as np

from lubfric.film import hertz
from lubfric.oil import Lubricant
from lubfric.scene.bodies import Bodies
from lubfric.scene.contact import ContactDomain
from lubfric.scene.motion import Motion
from lubfric.scene.numerics import Numerics
from lubfric.scene.roughness import Roughness
from lubfric.scene.scene import Scene

from ..parts import the

E_PRIME, WIDTH, EYRING, LIMITING = 231e9, 10e-3, 5e6, 0.05
CELLS_PER_LENGTH, LENGTHS_ALONG, REACH = 24, 12, 1.33
SEED = 7
LOG_RANGES = {
    "load": (1e2, 1e6),
    "speed": (1e-5, 10.0),
    "radius": (1e-3, 50e-3),
    "viscosity": (0.005, 1.0),
    "sq": (10e-9, 1e-6),
    "correlation_length": (2e-6, 50e-6),
}
LARGEST_ALPHA, CONSTANT_BELOW = 30e-9, 1.5e-9


def points(count: int, seed: int = SEED) -> list[dict]:
    """The first ``count`` points (a power of two is drawn): values by name, load in N/m."""
    from scipy.stats import qmc

    unit = qmc.Sobol(len(LOG_RANGES) + 2, seed=seed).random_base2(math.ceil(math.log2(count)))[:count]
    table = []
    for row in unit:
        values = {name: float(low * (high / low) ** u) for u, (name, (low, high)) in zip(row, LOG_RANGES.items())}
        table.append(values | {"alpha": float(LARGEST_ALPHA * row[-2]), "plastic": bool(row[-1] < 0.5)})
    return table


def scene(values: dict, index: int) -> Scene:
    """The scene of one point; ``index`` seeds its surface."""
    load, radius, sq = values["load"], values["radius"], values["sq"]
    half_width = hertz.line_half_width(load, radius, E_PRIME)
    hardness = max(3e9, 1.5 * hertz.line_mean_pressure(load, radius, E_PRIME)) if values["plastic"] else None
    length = values["correlation_length"]
    cell = length / CELLS_PER_LENGTH
    across = min(cell, half_width / 2)
    reach = max(REACH * (half_width + math.sqrt(6 * radius * sq)), LENGTHS_ALONG / 2 * length)
    shape = (8 * math.ceil(2 * reach / across / 8), CELLS_PER_LENGTH * LENGTHS_ALONG)
    constant = values["alpha"] < CONSTANT_BELOW
    lubricant = Lubricant(
        values["viscosity"],
        0.0 if constant else values["alpha"],
        "constant" if constant else "roelands",
        eyring_stress=EYRING,
        limiting_stress_coefficient=LIMITING,
    )
    return Scene(
        Bodies(radius, WIDTH, load * WIDTH, E_PRIME, 0.1, hardness),
        lubricant,
        Motion(values["speed"]),
        Roughness(sq=sq, correlation_length=length, acf="gaussian", seed=index),
        ContactDomain(shape=shape, spacing=(across, cell)),
        Numerics(film_deflection="hydrodynamic", sampling="patch", accept=True),
        name=f"scene {index}",
    )


def table(count: int) -> list[Scene]:
    """The scenes of `points`."""
    return [scene(values, index) for index, values in enumerate(points(count))]


def cells(scene: Scene) -> int:
    """Number of cells of the contact grid."""
    return int(np.prod(the(scene.contact.shape, "shape")))
