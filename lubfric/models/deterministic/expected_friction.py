"""What is expected of the friction of moving roughness before it is solved, by closed forms: for estimates of its
work."""

import math
from dataclasses import dataclass

from ...oil import FLOW_LAWS, shear_stress
from ...scene import HARDNESS_KEY, Scene, value_of
from ...surface import Surface, rms_slope
from ..shared import peak_hertz_pressure

# Inputs that are the stress of a law of the flow (`lubfric.oil.FLOW_LAWS`), by their keys. By definition.
OF_FLOW = tuple(f"lubricant.{law.key}" for law in FLOW_LAWS)

# Change of f by the load that another hardness moves, at most, over that by the mean of the contact [-]. On a strip at
# rest and on one in motion, of which hardnesses 30 % lower moved .4 to 16 % of the load, solved changes were .2 to 1.6
# times it. The value measured, with a margin.
REDISTRIBUTED = 2.0

# Expected change of f by another hardness, over f, above which f is solved with that hardness [-]. A convention.
HARDNESS_MATTERS = 0.02

# Expected asperity load over film load [-]: the first, times the full-load film over Sq and the pressure-viscosity
# coefficient times the Hertz pressure, each to its power. Fitted to the 228 contacts with a shear law among the rolling
# ones of verification.campaigns.calibration: ln of the ratio has a standard deviation of 1.75 about it, and of 3.4 in
# all.
LOAD_RATIO = 0.27
LOAD_RATIO_BY_FILM = -2.9
LOAD_RATIO_BY_THICKENING = -0.88

# The least of that coefficient times that pressure that counts [-]: below it the viscosity changes little. A
# convention.
LEAST_COUNTED_THICKENING = 1.0

# Film load ratio times the shear stress of the film over the critical one, if its oil had the viscosity of the inlet and
# did not thin (`solved_ends_of_shear`), at which one of the two ends of the range of a flow law is expected to be solved
# in motion [-]. Fitted with its power by their likelihood to 95 random contacts of
# ``verification.campaigns.estimates`` up to 1.5 GPa with typical ranges, where 66 of 190 ends were: 0, 16, 25, 25, 61,
# 84 % in sixths of them, ordered by it. Of the limiting stress 11 of 170 were, and none is expected.
HALF_OF_ENDS = 0.008

# Power of that in proportion to which the ends that are solved grow over those that are not [-]. Fitted.
ENDS_BY_STRESS = 1.3


@dataclass(frozen=True, kw_only=True)
class ExpectedFriction:
    """Friction as a mean of f_b and of the friction of the film at the mean Hertz pressure.

    ``share``: asperity load ratio; ``boundary``: f_b, 0 in pure rolling; ``film``: friction of the film, over its load.
    """

    share: float
    boundary: float
    film: float

    @property
    def contrast(self) -> float:
        """The change of f, over it, by all of the load that moves from the film to asperities; 0 where nothing
        slides."""
        f = self.share * self.boundary + (1.0 - self.share) * self.film
        return abs(self.boundary - self.film) / f if f > 0 else 0.0


def expected_friction(scene: Scene, sq: float, speed: float) -> ExpectedFriction:
    """Return the friction that is expected on roughness of ``sq`` [m] at ``speed`` [m/s], not 0."""
    line = scene.line_contact(abs(speed))
    sliding = abs(scene.motion.slide_roll_ratio * speed)
    boundary = scene.bodies.boundary_friction_coefficient if sliding > 0 else 0.0
    pressure = scene.bodies.mean_hertz_pressure
    film = float(shear_stress(line.lubricant, pressure, sliding / line.expected_film)) / pressure
    if scene.lubricant.has_unlimited_stress:
        film = min(film, boundary)
    load_ratio = LOAD_RATIO * (line.moes_film / sq) ** LOAD_RATIO_BY_FILM
    thickened = scene.lubricant.pressure_viscosity_coefficient * peak_hertz_pressure(scene)
    load_ratio *= max(thickened, LEAST_COUNTED_THICKENING) ** LOAD_RATIO_BY_THICKENING
    return ExpectedFriction(share=load_ratio / (1.0 + load_ratio), boundary=boundary, film=film)


def solved_ends_of_hardness(scene: Scene, surface: Surface, speed: float) -> int:
    """Return how many ends of a range of the hardness are expected to be solved at ``speed`` [m/s]
    (`HARDNESS_MATTERS`): those that move enough load.

    Asperities of an elastic ``surface`` of the rms slope s have pressures of Rayleigh's distribution, of the scale E'
    s/4 (B. N. J. Persson, J. Chem. Phys. 115 (2001) 3840-3861, doi:10.1063/1.1388626, at a small part of the area in
    contact). Of their load, erfc(H/(sqrt(2) scale)) is above the hardness H.
    """
    expected = expected_friction(scene, surface.sq, speed)
    scale = scene.bodies.e_prime * rms_slope(surface)[2] / 4.0
    if scale == 0:
        return 0

    def above(hardness: float) -> float:
        """The part of the load on asperities that is above this ``hardness`` [Pa]."""
        return math.erfc(hardness / (math.sqrt(2.0) * scale))

    times = 1.0 if expected.boundary == 0 else REDISTRIBUTED * (1.0 - expected.share) * expected.contrast
    ends = [value_of(end, HARDNESS_KEY) for name, *both in scene.at_ends() if name == HARDNESS_KEY for end in both]
    moved = [expected.share * abs(above(end) - above(value_of(scene, HARDNESS_KEY))) for end in ends]
    return sum(times * load > HARDNESS_MATTERS for load in moved)


def solved_ends_of_shear(scene: Scene, sq: float, speed: float, name: str) -> float:
    """Return how many ends of the range of the stress ``name`` of an oil are expected to be solved at ``speed`` [m/s],
    on moving roughness of ``sq`` [m]: none of a limiting stress; of a flow law those at which its films flow so
    differently that f changes.

    Sliding thins the pressure flow around asperities by its stress over the critical one, in the films that carry the
    load.
    """
    if name not in OF_FLOW:
        return 0.0
    law = scene.lubricant.flow_law
    assert law is not None  # it has a range
    (critical, _) = law.critical(0.0)
    film = scene.line_contact(abs(speed)).moes_film
    stress = scene.lubricant.viscosity * abs(scene.motion.slide_roll_ratio * speed) / film
    thinned = (1.0 - expected_friction(scene, sq, speed).share) * stress / critical
    solved_over_others = (thinned / HALF_OF_ENDS) ** ENDS_BY_STRESS
    return 2.0 * solved_over_others / (1.0 + solved_over_others)
