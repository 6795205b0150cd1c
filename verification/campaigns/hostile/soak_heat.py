"""Heat in the check of random scenes: the physics of `lubfric.film` by other numerical methods.

The temperature across the film comes from its double integral on a grid, by a fixed point, and not in closed form. That
of the surfaces comes from heat that is constant in each cell, and that of the inlet from Moes' film and bisection.
"""

import math

import numpy as np

from lubfric.oil import Lubricant
from lubfric.scene import Scene

from ...fem.parts import halved, the

ACROSS = 25  # nodes of half the film
STEPS = 2000  # of the fixed point, at most
KEPT = 0.9  # part of the last iterate that a step keeps
SETTLED = 1e-5  # of the largest stress: what a step still moves


def heats(scene: Scene) -> bool:
    """Return whether the lubricant says how its viscosity falls with the temperature, and something is to be heated."""
    return scene.numerics.heat != "off" and bool(scene.lubricant.temperature_coefficient)


def moes(w: float, radius: float, e_prime: float, speed: float, viscosity: float, alpha: float) -> float:
    """Return the film [m] by Moes' formula as printed."""
    u1 = 2 * viscosity * speed / (e_prime * radius)
    m = w / (e_prime * radius * math.sqrt(u1))
    l = alpha * e_prime * u1**0.25
    ri = 3 / m
    ei = 2.621 * m**-0.2
    rp = 1.287 * l ** (2 / 3)
    ep = 1.311 * m**-0.125 * l**0.75
    s = 0.2 * (7 + 8 * math.exp(-2 * ei / ri))
    iso = ri ** (7 / 3) + ei ** (7 / 3)
    piezo = (rp**-3.5 + ep**-3.5) ** (-2 * s / 7) if l > 1e-6 else 0.0
    return float(radius * math.sqrt(u1) * (iso ** (3 * s / 7) + piezo) ** (1 / s))


def inlet_viscosity(scene: Scene, speed: float) -> float:
    """Return viscosity [Pa s] at which Moes' film is as thin as the heat of the inlet makes it (Gupta et al. 1992)."""
    oil = scene.lubricant
    bodies = scene.bodies
    u = abs(speed)
    coefficient = oil.temperature_coefficient
    if coefficient is None or not heats(scene) or u == 0:
        return oil.viscosity
    number = oil.viscosity * coefficient * u * u / oil.conductivity
    peak = math.sqrt(bodies.load / bodies.width * bodies.e_prime / (2 * math.pi * bodies.radius))
    thinner = max(1 - 13.2 * peak / bodies.e_prime * number**0.42, 0.0)
    thinner /= 1 + 0.213 * (1 + 2.23 * abs(scene.motion.slide_roll_ratio) ** 0.83) * number**0.64
    alpha = oil.pressure_viscosity_coefficient * (oil.viscosity_law != "constant")

    def film(eta: float) -> float:
        return moes(bodies.load / bodies.width, bodies.radius, bodies.e_prime, u, eta, alpha)

    total = thinner * film(oil.viscosity)
    return halved(1e-9 * oil.viscosity, oil.viscosity, lambda eta: film(eta) < total, 80)


def heated_stress(
    scene: Scene,
    x: np.ndarray,
    p: np.ndarray,
    h: np.ndarray,
    log_ratio: np.ndarray,
    free: np.ndarray,
    contact_load: float,
    speed: float,
) -> np.ndarray:
    """Return shear stress [Pa], without sign, at nodes running downstream, of film and surfaces that heat one another.

    ``log_ratio`` is ln(eta/eta0) at the nodes, at the temperature of the oil. ``free`` is the share of the width on
    which they have film.
    """
    oil = scene.lubricant
    ambient = the(oil.temperature, "temperature")
    bodies = scene.bodies
    k = scene.lubricant.conductivity
    slide = abs(scene.motion.slide_roll_ratio * speed)
    walls = [abs(abs(speed) + side * slide / 2) for side in (-1, 1)]
    effusivity = [math.sqrt(k_s * c_s) for k_s, c_s in zip(bodies.conductivity, bodies.volumetric_heat)]
    carried = sum(e * math.sqrt(u) for e, u in zip(effusivity, walls))
    behind = np.sqrt(np.maximum(x[:, None] - x[None, :], 0.0))
    memory = 2 * (behind[:, :-1] - behind[:, 1:]) / (math.sqrt(math.pi) * carried)
    contacts = np.sqrt(np.maximum(1 - (x / bodies.half_width) ** 2, 0.0)) * 2 * contact_load
    contacts *= bodies.boundary_friction_coefficient * slide / (math.pi * bodies.half_width * bodies.width)
    z = np.linspace(0, 0.5, ACROSS)
    wall = np.full(x.size, ambient)
    rise = np.zeros((x.size, ACROSS))
    tau = np.zeros(x.size)
    for _ in range(STEPS):
        log_eta, beta = _viscosity(oil, log_ratio, wall)
        excess = beta[:, None] * (rise - rise[:, :1])
        thin = np.exp(excess)
        total = 2 * np.trapezoid(thin, z, axis=1)
        rate = slide / (h * total)
        mean = wall + tau * slide * h / (12 * k)
        new = np.exp(log_eta) * rate
        if oil.eyring_stress:
            stress = oil.eyring_stress * mean / ambient
            new = stress * np.arcsinh(new / stress)
        if isinstance(oil.limiting_stress_coefficient, float):
            limit = oil.limiting_stress_offset + oil.limiting_stress_coefficient * p
            new = np.minimum(new, limit * np.exp(585 * (1 / mean - 1 / ambient)))
        moved, tau = float(np.max(np.abs(new - tau))), KEPT * tau + (1 - KEPT) * new
        source = (tau * slide * h / k)[:, None] * thin / total[:, None]
        rise = KEPT * rise + (1 - KEPT) * _twice_integrated(source, z)
        heat = free * tau * slide + contacts
        hotter = ambient + memory @ (0.5 * (heat[1:] + heat[:-1]))
        wall = KEPT * wall + (1 - KEPT) * hotter
        if moved < SETTLED * float(np.max(tau)):
            return tau
    return np.full(x.size, np.nan)  # a judge that does not know


def _twice_integrated(source: np.ndarray, z: np.ndarray) -> np.ndarray:
    """Return temperature of -T'' = source by the trapezoidal rule: it is 0 at the wall, its slope in the middle."""
    step = z[1] - z[0]
    cells = 0.5 * (source[:, 1:] + source[:, :-1]) * step
    slope = np.concatenate([np.cumsum(cells[:, ::-1], axis=1)[:, ::-1], np.zeros((source.shape[0], 1))], axis=1)
    rises = 0.5 * (slope[:, 1:] + slope[:, :-1]) * step
    return np.concatenate([np.zeros((source.shape[0], 1)), np.cumsum(rises, axis=1)], axis=1)


def _viscosity(oil: Lubricant, log_ratio: np.ndarray, temperature: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return ln eta and -d ln(eta)/dT at temperatures [K], by Roelands' law if the scene requests it, otherwise
    exponential."""
    t0 = the(oil.temperature, "temperature")
    beta = the(oil.temperature_coefficient, "temperature coefficient")
    cold = math.log(oil.viscosity) + log_ratio
    if oil.viscosity_law != "roelands":
        return cold - beta * (temperature - t0), np.full(temperature.size, beta)
    power = beta * (t0 - 138) / (math.log(oil.viscosity) + 9.67)
    above = (cold + 9.67) * ((temperature - 138) / (t0 - 138)) ** -power
    return above - 9.67, above * power / (temperature - 138)
