"""Random mixed-lubricated line contacts, drawn by kind: a fluid, a lay of the roughness, a load, a film, a motion."""

import math
from dataclasses import dataclass, replace

import numpy as np

import lubfric
from lubfric.models.deterministic import RoughBody, reach
from lubfric.surface import Surface

from ...fem.parts import halved
from ...types import Keywords

MOTIONS = ("rest", "rolling")
FLUIDS = ("newtonian", "eyring", "limit", "low-limit")
LAYS = ("isotropic", "across", "along", "plateau")
LIGHTEST = 5e3  # N/m
HEAVIEST = 1.2e9  # Pa, Hertz pressure
LAMBDA = (0.2, 3.0)  # Moes' film of the whole load over Sq
RIDGE = 5.0  # length of ridges over their width
CUT = 0.3  # Sq: height at which the summits of a plateau are cut off
FINE = 0.1  # Sq of the fine roughness on a plateau
# Sq [m] of the maps that are made: a power of two, so that they have the digits of those with an Sq of 1 m.
UNIT = 2.0**-23
# cells in a correlation length, along x and y, at rest and where the roughness moves
PER_LENGTH = {"rest": (5.0, 4.0), "rolling": (4.0, 2.5)}
PER_HALF_WIDTH = 4.0  # cells in the Hertz half-width, at least
# cells of a deterministic grid, at most, and cells along y, at least and at most
CELLS = {"rest": 30_000, "rolling": 4_500}
ROWS = {"rest": (72, 320), "rolling": (16, 40)}
MOST_COLUMNS = {"rest": 400, "rolling": 220}
PERIOD = {"rest": 9.0, "rolling": 7.0}  # correlation lengths of a map along x, at least
SUMMITS = 4.5  # Sq: height that no summit exceeds by much
DRAWS = 200  # of the numbers of a case, until its grid is small enough


@dataclass(frozen=True, kw_only=True)
class Case:
    """One contact: its scene without a map, the maps of its rough bodies, and the speed [m/s].

    facts : what was drawn, by name: plain numbers and words, columns of the table
    """

    scene: lubfric.Scene
    bodies: tuple[RoughBody, ...]
    speed: float
    facts: Keywords

    @property
    def surface(self) -> Surface:
        """The sum of the maps, periodic along x and y."""
        heights = np.sum([body.surface.heights for body in self.bodies], axis=0)
        return Surface(heights, self.bodies[0].surface.spacing, periodic_axes=(True, True))

    def widened(self, shift: int = 0) -> Surface:
        """Return the sum of the maps, moved by ``shift`` cells along x and repeated until it covers the contact."""
        surface = self.surface
        wanted = contact_reach(self.scene, surface.sq) / surface.spacing[0]
        times = max(1, math.ceil(wanted / surface.shape[0]))
        heights = np.tile(np.roll(surface.heights, shift, axis=0), (times, 1))
        return Surface(heights, surface.spacing, periodic_axes=(True, True))


# Number of the first rolling case with slight sliding, as in rolling bearings.
SLIGHT_FROM = 1000

# Slide-roll ratios of these cases [-].
SLIGHT = (0.003, 0.3)

# Number of the first case with a light contact, at rest and rolling; of the rolling ones, every second run of 16 slides
# slightly.
LIGHT_FROM = 2000

# Loads of light contacts [N/m]. The scene "paper" has 917 N/m.
LIGHT_LOADS = (500.0, 5000.0)

# Hertz pressures of light contacts [Pa]. The scene "paper" has 130 MPa.
LIGHT_PRESSURES = (40e6, 140e6)

# Cylinder radii of light contacts [m]: that of the scene "paper" and somewhat less, up to that of a large gear.
LIGHT_RADII = (1.5e-3, 50e-3)

# Number of the first case with a thin film, at rest and rolling; of the rolling ones, every second run of 16 slides
# slightly.
THIN_FROM = 3000

# Lambda ratios of thin films [-]: down to a needle roller of 3 mm under 80 N/mm at 0.05 m/s.
THIN_LAMBDA = (0.03, 0.2)

# Difference of the seeds of the maps of one case, repeated.
REPEAT_STEP = 104_729


def contact_reach(scene: lubfric.Scene, sq: float) -> float:
    """Return the length [m] along x that contains the contact: where an undeformed cylinder, resting on the ends of the
    Hertz strip, has risen by `SUMMITS` times ``sq`` [m]."""
    bodies = scene.bodies
    return 2 * math.sqrt(bodies.half_width**2 + 2 * bodies.radius * SUMMITS * sq)


def drawn(motion: str, seed: int, repeat: int = 0) -> Case:
    """Return the random case number ``seed`` of a ``motion`` ("rest" or "rolling"); its ``repeat`` 1, 2, ... differs
    from it by the seed of the map alone.

    Fluid and lay follow from the number, so that any run of 16 numbers has every pair once.
    """
    rng = np.random.default_rng([46, MOTIONS.index(motion), seed])
    fluid = FLUIDS[seed % 4]
    lay = LAYS[(seed // 4) % 4]
    thin = seed >= THIN_FROM
    light = LIGHT_FROM <= seed < THIN_FROM
    slight = motion == "rolling" and (seed // 16 % 2 == 1 if light or thin else seed >= SLIGHT_FROM)
    for _ in range(DRAWS):
        case = _drawn(rng, motion, fluid, lay, slight=slight, light=light, thin=thin, repeat=repeat)
        if case is not None:
            return replace(case, facts={"motion": motion, "seed": seed, "repeat": repeat} | case.facts)
    raise RuntimeError(f"no case of {motion}, {fluid}, {lay} is small enough")


def _drawn(
    rng: np.random.Generator, motion: str, fluid: str, lay: str, *, slight: bool, light: bool, thin: bool, repeat: int
) -> Case | None:
    """Return one draw, of ``slight`` sliding as in a bearing, under a ``light`` load and with a ``thin`` film; None
    where its grid has too many columns."""

    def between(low: float, high: float) -> float:
        return float(math.exp(rng.uniform(math.log(low), math.log(high))))

    radius = between(2e-3, 3e-2)
    e_prime = between(1.1e11, 2.4e11)
    lightest = math.sqrt(LIGHTEST * e_prime / (2 * math.pi * radius))
    pressure = between(lightest, HEAVIEST)
    if light:
        load = between(*LIGHT_LOADS)
        pressure = between(*LIGHT_PRESSURES)
        radius = load * e_prime / (2 * math.pi * pressure**2)
    sq = between(50e-9, 400e-9)
    length = between(5e-6, 25e-6)
    friction = rng.uniform(0.08, 0.15)
    oil = _oil(rng, fluid, friction)
    ratio = between(*(THIN_LAMBDA if thin else LAMBDA))
    slip = rng.uniform(-2, 2) if motion == "rolling" else 2.0
    if slight:
        (least, most) = map(math.log, SLIGHT)
        slip = math.copysign(math.exp(least + abs(slip) / 2 * (most - least)), slip)
    rough = ("lower", "upper", "both")[int(rng.integers(3))] if motion == "rolling" else "lower"
    hardness = None if rng.random() < 0.5 else between(3e9, 9e9)
    acf = "exponential" if lay == "isotropic" and rng.random() < 0.4 else "gaussian"
    map_seed = int(rng.integers(2**31)) + REPEAT_STEP * repeat
    if light and not LIGHT_RADII[0] <= radius <= LIGHT_RADII[1]:
        return None
    scene = lubfric.load_scene("paper").with_(
        bodies={
            "radius": radius, "e_prime": e_prime, "hertz_pressure": pressure, "hardness": hardness,
            "boundary_friction_coefficient": friction,
        },
        lubricant={
            "viscosity": between(0.01, 0.2), "pressure_viscosity_coefficient": rng.uniform(12e-9, 26e-9),
            "density_law": "dowson-higginson",
        } | oil,
        motion={"slide_roll_ratio": slip},
        numerics={"accept": True, "film_deflection": "scaled"},
    )  # fmt: skip
    lengths = {"across": (length, RIDGE * length), "along": (RIDGE * length, length)}.get(lay, (length, length))
    speed = halved(1e-7, 1e3, lambda u: scene.line_contact(u).moes_film < ratio * sq)
    line = scene.line_contact(speed)
    (px, py) = PER_LENGTH[motion]
    dx = min(lengths[0] / px, scene.bodies.half_width / PER_HALF_WIDTH)
    dy = lengths[1] / py
    columns = sum(reach(line, sq)) / dx
    if columns > MOST_COLUMNS[motion]:
        return None
    (least, most) = ROWS[motion]
    ny = 4 * round(min(max(CELLS[motion] / columns, least), most) / 4)
    wanted = (
        PERIOD[motion] * lengths[0]
        if motion == "rolling"
        else max(contact_reach(scene, sq), PERIOD[motion] * lengths[0])
    )
    nx = 4 * math.ceil(wanted / dx / 4)
    count = 2 if rough == "both" else 1
    try:
        maps = [_map((nx, ny), (dx, dy), sq / math.sqrt(count), lengths, lay, acf, map_seed + k) for k in range(count)]
    except lubfric.InputError:  # the map is too short for its correlation length
        return None
    signs = {"lower": (-1,), "upper": (1,), "both": (-1, 1)}[rough]
    bodies = tuple(RoughBody(m, speed * (1 + s * slip / 2), s > 0) for m, s in zip(maps, signs))
    facts = {
        "fluid": fluid, "lay": lay, "acf": acf, "radius": radius, "e_prime": e_prime, "pressure": pressure, "sq": sq,
        "length_x": lengths[0], "length_y": lengths[1], "friction": friction, "ratio": ratio, "slip": slip,
        "rough": rough, "hardness": hardness, "viscosity": scene.lubricant.viscosity,
        "alpha": scene.lubricant.pressure_viscosity_coefficient, "eyring": scene.lubricant.eyring_stress,
        "limit": scene.lubricant.limiting_stress_coefficient, "speed": speed, "dx": dx, "dy": dy, "nx": nx, "ny": ny,
        "map_seed": map_seed,
    }  # fmt: skip
    return Case(scene=scene, bodies=bodies, speed=speed, facts=facts)


def _oil(rng: np.random.Generator, fluid: str, friction: float) -> Keywords:
    """Return keys of a lubricant of that kind: Newtonian up to f_b p; Eyring; a limit near f_b; Eyring with a limit
    below."""
    eyring = math.exp(rng.uniform(math.log(3e6), math.log(15e6)))
    near = friction * rng.uniform(0.8, 1.25)
    low = friction * rng.uniform(0.3, 0.8)
    keys: dict[str, Keywords] = {
        "newtonian": {},
        "eyring": {"eyring_stress": eyring},
        "limit": {"limiting_stress_coefficient": near},
        "low-limit": {"eyring_stress": eyring, "limiting_stress_coefficient": low},
    }
    return keys[fluid]


def _map(
    shape: tuple[int, int],
    spacing: tuple[float, float],
    sq: float,
    lengths: tuple[float, float],
    lay: str,
    acf: str,
    seed: int,
) -> Surface:
    """Return a periodic map of that lay with exactly this ``sq`` [m]."""
    keys: Keywords = {"sq": UNIT, "correlation_length": lengths, "acf": acf}
    heights = lubfric.generate_surface(shape, spacing, seed=seed, **keys).heights / UNIT
    if lay == "plateau":
        fine = lubfric.generate_surface(shape, spacing, seed=seed + 1_000_003, **keys).heights / UNIT
        heights = np.minimum(heights, CUT) + FINE * fine
    heights = heights - heights.mean()
    return Surface(sq * heights / heights.std(), spacing, periodic_axes=(True, True))
