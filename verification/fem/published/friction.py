"""Rolling and sliding friction of smooth films compared with Biboulet and Houpert, Martin, Johnson and Tevaarwerk."""

import math
from collections.abc import Iterator

import numpy as np

import lubfric
from lubfric.film import ShearForce, shear_force
from lubfric.oil import Lubricant

from ... import plotting
from ...check import Check, Figure, Item, listed_near
from ...types import Keywords
from .. import references
from ..parts import ALPHA, E_PRIME, RADIUS, VISCOSITY
from . import against
from .films import film, own

# M, L
LOADS = (0.2, 1, 2, 5, 10, 30, 100, 200)
OILS = (4, 8, 12, 16)
STARVED = ((10, 4, 3.0), (10, 4, 8.0), (10, 12, 4.5), (100, 12, 2.0))  # M, L, beginning of the inlet in half-widths
EYRING = ((100, 10, 5e6, 0.01), (200, 10, 5e6, 0.2), (50, 15, 2e6, 0.05))  # M, L, stress [Pa], slide-roll ratio
STEEL = 2.3e11  # Pa, E' of two steel bodies
INLETS = (0.2e-3, 0.3e-3)  # m: lengths of the inlets of the bearing
TOLERANCE = 1e-3  # of the films
FVA_3: Keywords = {  # at 50 °C: 0.0525 Pa s and 20 /GPa of Wingertszahn et al.
    "viscosity": 0.0525,
    "pressure_viscosity_coefficient": 20e-9,
    "density_law": "dowson-higginson",
}
WIDE = (
    "the published fit neglects a dependence on M and L ('few per cents'); finite elements confirm lubfric (study ehl)"
)
# rolling torque of lubfric [p_h b²/M^1.5] where it differs from the fit, by M and L
TORQUES_DIFFER: dict[tuple[float, float], float] = {
    (2, 4): 1.596,
    (5, 4): 1.706,
    (10, 4): 1.722,
    (30, 4): 1.676,
    (100, 4): 1.571,
    (5, 8): 1.593,
    (10, 8): 1.603,
    (30, 8): 1.568,
    (5, 12): 1.530,
    (10, 12): 1.547,
    (30, 12): 1.523,
}


def friction(level: str) -> Iterator[Item]:
    """Forces on a smooth film: rolling without sliding, the rigid cylinder, and Eyring's traction.

    The rolling force is `1/2 ∫ h dp` per length, the force on one surface, as published. The publication has one curve
    over M, with Barus' law; the inlet is flooded, or begins with p = 0. The error of lubfric is the one that the
    solver states for the film, and for the rolling force also the error of its sum.
    """
    rolled: dict[tuple[float, float], tuple[float, float]] = {(m, l): rolling(m, l) for l in OILS for m in LOADS}
    for (m, l), (ours, error) in rolled.items():
        name = f"rolling torque, M = {m}, L = {l}"
        listed = listed_near(TORQUES_DIFFER[m, l], "theirs", WIDE) if (m, l) in TORQUES_DIFFER else None
        yield against("biboulet", name, ours, references.rolling_torque(m), error, "p_h b²/M^1.5", WIDE, listed=listed)
    for m, l, where in STARVED:
        ours, s, error = starved(m, l, where)
        name = f"rolling torque over the flooded one, M = {m}, L = {l}, inlet at {s:.0f} smallest films"
        yield against("biboulet", name, ours, references.starved_torque(s), error)
    yield from rigid()
    yield from bearing()
    for m, l, stress, ratio in EYRING:
        yield eyring(m, l, stress, ratio)
    yield drawn(rolled)


def bearing() -> Iterator[Item]:
    """Torque of tapered roller bearing 32216 in FVA 3 at 50 °C, by the rolling forces of its 16 rollers on both races.

    How much lubricant reaches the inlets is not published. Ours is the middle between inlets of 0.2 and 0.3 mm, which
    bracket the measurement, and half their difference is the error: the shape of the curve over the speed is compared,
    its level was chosen. The flange, the cage and churning are not modelled."""
    bearing = references.BEARING
    inner, outer = (bearing["pitch"] + sign * bearing["diameter"] * math.cos(bearing["angle"]) for sign in (-1, 1))
    load = bearing["axial load"] / (bearing["rollers"] * math.sin(bearing["angle"])) / bearing["length"]
    for rpm, theirs in references.BEARING_TORQUE.items():
        turn = 2 * math.pi / 60 * rpm
        speed = turn * inner / (inner + outer) * outer / 2
        torques = []
        for inlet in INLETS:
            total = 0.0
            for race in (inner, -outer):
                radius = 1 / (2 / bearing["diameter"] + 2 * math.cos(bearing["angle"]) / race)
                case: Keywords = {
                    "load_per_width": load,
                    "radius": radius,
                    "e_prime": STEEL,
                    "entrainment_speed": speed,
                }
                solution = lubfric.solve_ehl(**case, **FVA_3, inlet_length=inlet, tolerance=TOLERANCE)
                rolled = force(solution, solution.line.lubricant, 1e-9).rolling * bearing["length"]
                total += bearing["rollers"] * 2 * speed / turn * rolled
            torques.append(total)
        short, long = torques
        middle = (short + long) / 2
        name = f"torque of bearing 32216, {rpm} rpm"
        note = "inlets of 0.2 to 0.3 mm; flooded ones give two to three times the torque"
        yield against("bearing", name, middle, theirs, abs(long - short) / 2 / middle, "N m", note)


def force(solution: lubfric.EHLResult, oil: Lubricant, ratio: float) -> ShearForce:
    """Return the forces per width without asperity contacts."""
    return shear_force(
        solution, oil, slide_roll_ratio=ratio, width=1.0, contact_fraction=lambda x: np.zeros(x.size - 1)
    )


def rolling(m: float, l: float, inlet: float | None = None) -> tuple[float, float]:
    """Return torque on a roller over p_h b²/M^1.5, and its relative error. ``inlet``: where it begins, in
    half-widths."""
    flooded = film(m, l, "dowson-higginson", "barus")
    b = flooded.half_width
    solution = film(m, l, "dowson-higginson", "barus", inlet_length=inlet * b) if inlet else flooded
    size, error = solution.rolling or (math.nan, math.nan)
    unit = solution.hertz_pressure * b**2 / (RADIUS * m**1.5)
    return force(solution, solution.line.lubricant, 1e-9).rolling / unit, own(solution) + error / size


def starved(m: float, l: float, inlet: float) -> tuple[float, float, float]:
    """Return torque with an inlet [b] over the flooded one, the gap there over the smallest film, and the relative
    error."""
    full = film(m, l, "dowson-higginson", "barus")
    (flooded, first) = rolling(m, l)
    (part, second) = rolling(m, l, inlet)
    return part / flooded, float(full.film_at(np.array([-inlet * full.half_width]))[0]) / full.min_film, first + second


def rigid() -> Iterator[Item]:
    """Forces on the rigid cylinder."""
    solution = film(1e-3, 5.0, law="constant", tolerance=1e-4)
    forces = force(solution, solution.line.lubricant, 1.0)
    h0 = solution.min_film
    scale = VISCOSITY * solution.entrainment_speed * math.sqrt(RADIUS / h0)
    for name, ours in (("couette", forces.couette / scale), ("rolling", forces.rolling / (2 * scale))):
        error = own(solution) + forces.quadrature / forces.couette
        yield against("martin", f"rigid cylinder, {name} force", ours, references.RIGID[name], error)
    m = 0.05
    l = 5.0
    solution = film(m, l, law="constant", tolerance=1e-4)
    torque = force(solution, solution.line.lubricant, 1e-9).rolling * RADIUS
    ours = torque * m / (solution.hertz_pressure * solution.half_width**2)
    yield against("biboulet-rigid", f"torque on a roller, M = {m}", ours, references.RIGID_TORQUE, own(solution))


def eyring(m: float, l: float, stress: float, ratio: float) -> Check:
    """Compare the traction of a heavy contact (Barus, Eyring) with the published law at the central film of lubfric."""
    solution = film(m, l, law="barus")
    ours = force(solution, Lubricant(VISCOSITY, ALPHA, viscosity_law="barus", eyring_stress=stress), ratio).couette
    rate = ratio * solution.entrainment_speed / solution.central_film
    half_width, peak = references.hertz_line(solution.line.load_per_width, RADIUS, E_PRIME)
    theirs = references.eyring_force(stress, VISCOSITY, ALPHA, rate, half_width, peak)
    name = f"Eyring traction, M = {m}, L = {l}, {stress / 1e6:g} MPa, slide-roll {ratio:g}"
    return against("johnson", name, ours, theirs, own(solution), "N/m")


def drawn(rolled: dict[tuple[float, float], tuple[float, float]]) -> Figure:
    """Draw the rolling torque over the published one."""
    canvas, ax = plotting.panel(6.0, 3.8)
    for k, l in enumerate(OILS):
        ratios = [rolled[m, l][0] / references.rolling_torque(m) for m in LOADS]
        errors = [rolled[m, l][1] * r for m, r in zip(LOADS, ratios)]
        ax.errorbar(LOADS, ratios, errors, fmt="osD^"[k] + "-", lw=0.8, label=f"lubfric, L = {l}")
    error = references.SOURCES["biboulet"].error
    ax.axhspan(1 - error, 1 + error, color="0.88", label="Biboulet and Houpert ± 5 %")
    ax.axhline(1.0, color="k", lw=0.8)
    ax.set(xscale="log", xlabel="M", ylabel="rolling torque over the published one")
    canvas.legend(loc="outside lower center", ncols=3, frameon=False)
    return plotting.finish("rolling", canvas, "Rolling torque over eq. 42 of Biboulet and Houpert")
