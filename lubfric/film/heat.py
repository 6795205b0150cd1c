"""Heat of a film: temperatures of the surfaces, stress of the film between them, and the heat of its inlet.

Flash temperature: two bodies of effusivity e = sqrt(k rho c) move the same way at u1 and u2, and carry away the heat
q(x) [W/m²]. Two assumptions are made: the film is so thin that both surfaces have the same temperature, and the sources
move fast (u b rho c/(2 k) above about 5). Then the surfaces share the heat in proportion to e sqrt(u): ``T(x) =
1/(√π (e1 √u1 + e2 √u2)) ∫_{-∞}^{x} q(x')/√(x - x') dx'`` (J. C. Jaeger, Proc. R. Soc. N.S.W. 76 (1942) 203; H. Blok
1937). A slow source is cooler than that.

Inlet: the film is thinner because its inlet is warmer than the oil around. There are two published factors,
h/h_isothermal over the thermal number ``L = eta0 beta U²/k`` and the slide-roll ratio S:

- P. K. Gupta, H. S. Cheng, D. Zhu, N. H. Forster, J. B. Schrand, Tribol. Trans. 35 (1992) 269-274,
  doi:10.1080/10402009208982117: ``(1 - 13.2 (p_h/E') L^0.42)/(1 + 0.213 (1 + 2.23 S^0.83) L^0.64)``: used here;
- W. R. D. Wilson, S. Sheu, J. Lubr. Technol. 105 (1983) 187-188, doi:10.1115/1.3254563, as used by A. V. Olver, H. A.
  Spikes, Proc. Inst. Mech. Eng. J 212 (1998) 321-332, doi:10.1243/1350650981542137: ``1/(1 + 0.1 (1 + 14.8 S^0.83)
  L^0.64)``. The note of Wilson and Sheu itself has 0.241 in place of 0.1, and S/2 in place of S, at the same L.

In rolling they agree to some 10 %. Both were fitted near rolling. At S = 2 they differ by up to 100 % (0.47 and 0.27 at
L = 1; 0.21 by the note itself), and which is right is not known. Every factor comes with this difference.

Across the film, between walls of a given temperature, the stress is constant. If the viscosity falls as
exp(-beta (T - T_w)) from the walls, the heat equation k T'' = -tau gamma integrates in closed form for any law gamma =
gamma_w(tau) exp(beta (T - T_w)), Newtonian, Ree-Eyring, Carreau: with a = exp(beta (T_middle - T_w)) and G = beta tau
gamma_w h²/k, ``a - 1 = beta tau dU²/(8 k gamma_w)`` and ``asinh²√(a - 1) = a G/8``, one root for tau. (Of a Newtonian
fluid that is the closed form of R. Nahme, Ingenieur-Archiv 11 (1940) 191-209, doi:10.1007/BF02086920.)

With the temperature change:

- the viscosity, by Roelands, ``(ln eta + 9.67) ~ (T - 138 K)^-S0``, with S0 from the temperature coefficient (C. J. A.
  Roelands, thesis, Delft 1966); by exp(-beta (T - T0)) for the other laws;
- the critical stresses of the shear laws (`lubfric.oil.shear_laws`), at the mean temperature of the film, T_w + tau dU
  h/(12 k).

Since the viscosity is linearised about the walls, it is somewhat too low if the middle of the film is tens of kelvin
hotter.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.linalg import solve_triangular

from .._base import FloatArray
from ..errors import CONVERGED, ITERATION_LIMIT, InputError, Report, returned
from ..oil import ROELANDS_LOG_VISCOSITY, Lubricant, ShearLaw, log_viscosity_ratio, shear_stress

# Péclet number u b rho c/(2 k) [-] from which a heat source moves fast (Jaeger 1942).
FAST_PECLET_NUMBER = 5.0
# Nodes of the flash temperature, at most. A choice: the work grows with its cube.
FLASH_NODES = 257
# Iterations of film and surface temperature, at most. A choice: a bound.
TEMPERATURE_ITERATIONS = 40
# Step [K] of a difference over the temperature. A choice: far below the warming over which the viscosity bends, far
# above rounding.
DIFFERENCE_STEP = 0.05
# Change of the temperatures over the largest rise [-] at which the iteration ends. A choice, far below all other
# errors.
TEMPERATURE_TOLERANCE = 1e-6
# |S| [-] above which the factors of the inlet are used outside the range they were made for. A choice: both were fitted
# near rolling, and differ the more the larger S.
MOST_SLIDE_ROLL_RATIO_OF_INLET = 0.5
# L [-] above which neither factor is supported by the solutions it was fitted to. A choice: a smaller value warns of
# more films.
MOST_THERMAL_LOADING = 20.0
# Temperature [K] at which the viscosity of Roelands' law is infinite. By definition of that law (Roelands 1966).
ROELANDS_ZERO = 138.0
# Least heated stress over the Newtonian one [-] from which the root is sought. A choice: no film is heated so much.
LEAST_HEATED_STRESS = 1e-14
# Least stress [Pa] from which the root is sought, where it is lower. A choice: far below any stress that matters.
LEAST_STRESS = 1e-3
# Largest Newtonian stress [Pa] that a number holds. A choice, below the largest number of double precision, 1.8e308.
MOST_STRESS = 1e300
# Halvings of the logarithm of the stress: to 1e-12 and less. As many as the interval of ln of the stress needs: a
# choice of accuracy.
STRESS_HALVINGS = 64


@dataclass(frozen=True)
class Surroundings:
    """The bodies that carry the heat away, and other sources of heat.

    carried: e1 √u1 + e2 √u2 of the bodies; sliding: u2 - u1 [m/s]; contact_heat (n,) [W/m²] of the asperity contacts
    and wet (n,), the share of the width that the film covers, at the nodes of the film.
    """

    carried: float
    sliding: float
    wet: np.ndarray
    contact_heat: np.ndarray


@dataclass(frozen=True)
class FilmHeat:
    """Temperatures of a film at its nodes, running downstream.

    stress (n,) [Pa] over the film, signed; wall (n,) [K] of the surfaces; film_rise (n,) [K] mean over the film above
    its walls. ``report``: residual, the largest mismatch of the surface temperature over its largest rise.
    """

    stress: np.ndarray
    wall: np.ndarray
    film_rise: np.ndarray
    report: Report

    @property
    def flash(self) -> float:
        """Return the largest rise of the surfaces [K] (the wall's first node is upstream of all heat)."""
        return float(np.max(self.wall) - self.wall[0])

    @property
    def film(self) -> float:
        """Return the largest mean rise of the film over its walls [K]."""
        return float(np.max(self.film_rise))


def flash_matrix(x: np.ndarray, carried: float) -> np.ndarray:
    """Return the matrix (n, n), lower triangular: from the heat [W/m²] at the nodes ``x`` (n,) [m], rising downstream,
    to the rise [K] there. The heat is linear between the nodes, and zero upstream. carried: e1 √u1 + e2 √u2 [J/(m² K
    s^½) (m/s)^½].
    """
    n = x.size
    step = np.diff(x)
    behind = np.maximum(x[:, None] - x[None, :], 0.0)  # from a node to those upstream
    roots = np.sqrt(behind)
    powers = behind * roots
    root = 2 * (roots[:, :-1] - roots[:, 1:])
    share = (behind[:, :-1] * root - 2 / 3 * (powers[:, :-1] - powers[:, 1:])) / step  # of the cell's downstream end
    matrix = np.zeros((n, n))
    matrix[:, 1:] += np.tril(share, -1)
    matrix[:, :-1] += np.tril(root - share, -1)
    return matrix / (np.sqrt(np.pi) * carried)


def isothermal_heat(
    lubricant: Lubricant, x: np.ndarray, pressure: np.ndarray, film: np.ndarray, around: Surroundings
) -> FilmHeat:
    """Return an upper estimate of the temperatures in one pass: the surfaces as hot as the stress of the unheated film
    makes them, and the stress of the film between such surfaces.

    They are hotter than in the solution, so the stress of the heated film lies between this stress and the isothermal
    one.
    """
    nodes = _nodes(x.size)
    stress = shear_stress(lubricant, pressure, around.sliding / film)
    heat = around.wet * np.abs(stress * around.sliding) + around.contact_heat
    wall = lubricant.temperature + flash_matrix(x[nodes], around.carried) @ heat[nodes]
    wall = np.interp(x, x[nodes], wall)
    left, rise = heated_stress(lubricant, pressure, film, around.sliding, wall)
    return FilmHeat(
        left, wall, rise, Report("heat, one pass", CONVERGED, iterations=1, residual=0.0, tolerance=math.inf)
    )


def heated_film(
    lubricant: Lubricant,
    x: np.ndarray,
    pressure: np.ndarray,
    film: np.ndarray,
    around: Surroundings,
    *,
    raise_on_failure: bool = True,
) -> FilmHeat:
    """Return the stress and temperatures of a film. ``x`` (n,) [m] rises downstream; ``pressure`` [Pa] and ``film`` [m]
    are at its nodes.

    The heat of film and asperity contacts makes the surfaces hot (`flash_matrix`, on at most 257 of the nodes). The
    stress is that of the film between such walls (`heated_stress`). Newton's method finds the wall temperatures. It
    stops when no equation is off by more than 1e-6 of the largest rise. After 40 steps it raises `ConvergenceError`
    with the report.
    """
    nodes = _nodes(x.size)
    places, p, h, wet, extra = (a[nodes] for a in (x, pressure, film, around.wet, around.contact_heat))
    matrix = flash_matrix(places, around.carried)
    speed = abs(around.sliding)

    def heat(wall: FloatArray) -> FloatArray:
        return wet * np.abs(heated_stress(lubricant, p, h, around.sliding, wall)[0]) * speed + extra

    def mismatch(rise: FloatArray, made: FloatArray) -> FloatArray:
        return matrix @ made - rise

    rise = np.zeros(places.size)
    made = heat(np.full(places.size, lubricant.temperature))
    defect = mismatch(rise, made)
    history = []
    for _ in range(TEMPERATURE_ITERATIONS):
        wall = lubricant.temperature + rise
        slope = (heat(wall + DIFFERENCE_STEP) - made) / DIFFERENCE_STEP
        step = solve_triangular(np.eye(places.size) - matrix * slope, defect, lower=True)
        share = 1.0
        while True:
            new = np.maximum(rise + share * step, 0.0)
            made = heat(lubricant.temperature + new)
            new_defect = mismatch(new, made)
            if np.max(np.abs(new_defect)) < np.max(np.abs(defect)) or share < 1e-3:
                break
            share *= 0.5
        rise = new
        defect = new_defect
        history.append(float(np.max(np.abs(defect)) / max(np.max(rise), 1e-9)))
        if history[-1] <= TEMPERATURE_TOLERANCE:
            break
    status = CONVERGED if history[-1] <= TEMPERATURE_TOLERANCE else ITERATION_LIMIT
    report = Report(
        "heat of the film",
        status,
        iterations=len(history),
        residual=history[-1],
        tolerance=TEMPERATURE_TOLERANCE,
        history=tuple(history),
    )
    wall = np.interp(x, places, lubricant.temperature + rise)
    stress, film_rise = heated_stress(lubricant, pressure, film, around.sliding, wall)
    return returned(FilmHeat(stress, wall, film_rise, report), raise_on_failure=raise_on_failure)


def _nodes(count: int) -> np.ndarray:
    """Return the indices, evenly spread, of at most `FLASH_NODES` of ``count`` nodes; first and last are among them."""
    return np.unique(np.linspace(0, count - 1, min(count, FLASH_NODES)).round().astype(int))


@dataclass(frozen=True)
class InletHeat:
    """thermal_number L [-], factor on the film (Gupta et al.) and other (Wilson and Sheu) [-]."""

    thermal_number: float
    factor: float
    other: float


def inlet_heat(
    *,
    viscosity: float,
    temperature_coefficient: float,
    conductivity: float,
    speed: float,
    slide_roll_ratio: float,
    pressure_ratio: float,
) -> InletHeat:
    """Return the factors of inlet heating at eta0 [Pa s], beta [1/K], k [W/(m K)], entrainment speed U [m/s],
    slide-roll ratio [-] and p_h/E' [-]."""
    number = viscosity * temperature_coefficient * speed**2 / conductivity
    sliding = abs(slide_roll_ratio) ** 0.83
    pressed = max(1 - 13.2 * pressure_ratio * number**0.42, 0.0)
    factor = pressed / (1 + 0.213 * (1 + 2.23 * sliding) * number**0.64)
    return InletHeat(number, factor, 1 / (1 + 0.1 * (1 + 14.8 * sliding) * number**0.64))


def _thermal(lubricant: Lubricant) -> tuple[float, float]:
    """Return the temperature [K] and temperature coefficient [1/K] of a lubricant that has them (`Lubricant.heats`)."""
    if lubricant.temperature is None or lubricant.temperature_coefficient is None:
        raise InputError("lubricant has no temperature [K] or temperature_coefficient [1/K]; give both, or an oil")
    return lubricant.temperature, lubricant.temperature_coefficient


def viscosity_at(lubricant: Lubricant, pressure: FloatArray, temperature: FloatArray) -> tuple[np.ndarray, np.ndarray]:
    """Return ln(eta [Pa s]) and -d ln(eta)/dT [1/K] at each pressure [Pa] and temperature [K]."""
    t0, beta = _thermal(lubricant)
    cold = np.log(lubricant.viscosity) + log_viscosity_ratio(lubricant, pressure)[0]
    if lubricant.viscosity_law != "roelands":
        return cold - beta * (temperature - t0), np.broadcast_to(beta, np.shape(cold - temperature)).astype(float)
    above = np.asarray(temperature, dtype=float) - ROELANDS_ZERO
    power = beta * (t0 - ROELANDS_ZERO) / (np.log(lubricant.viscosity) + ROELANDS_LOG_VISCOSITY)
    over_pole = (cold + ROELANDS_LOG_VISCOSITY) * (above / (t0 - ROELANDS_ZERO)) ** -power
    return over_pole - ROELANDS_LOG_VISCOSITY, over_pole * power / above


def heated_stress(
    lubricant: Lubricant, pressure: ArrayLike, film: ArrayLike, sliding: float, wall: ArrayLike
) -> tuple[np.ndarray, np.ndarray]:
    """Return the shear stress [Pa], with the sign of ``sliding`` [m/s], and mean rise of the film over its walls [K].

    ``pressure`` [Pa], ``film`` thickness [m] and temperature of the ``wall`` [K]: arrays (n,). By bisection on ln(tau),
    to 1e-12, in 1.5 ms for 257 nodes; ``scipy.optimize.elementwise.find_root`` takes 2.7 ms.
    """
    speed = abs(sliding)
    k = lubricant.conductivity
    p, h, wall = (np.asarray(a, dtype=float) for a in np.broadcast_arrays(pressure, film, wall))
    if speed == 0.0:
        return np.zeros(p.shape), np.zeros(p.shape)
    log_eta, beta = viscosity_at(lubricant, p, wall)
    per_stress = speed * h / (12 * k)  # K/Pa
    high = log_eta + np.log(2 * speed / h)
    low = np.minimum(high + np.log(LEAST_HEATED_STRESS), np.log(LEAST_STRESS))
    laws = lubricant.shear_laws[::-1]
    with np.errstate(over="ignore"):
        for _ in range(STRESS_HALVINGS):
            middle = 0.5 * (low + high)
            tau = np.exp(middle)
            above = _too_high(laws, k, p, h, speed, tau, log_eta, beta, wall + tau * per_stress)
            low = np.where(above, low, middle)
            high = np.where(above, middle, high)
    tau = np.exp(0.5 * (low + high))
    return np.copysign(tau, sliding), tau * per_stress


def _too_high(
    laws: Sequence[ShearLaw],
    k: float,
    p: FloatArray,
    h: FloatArray,
    speed: float,
    tau: FloatArray,
    log_eta: FloatArray,
    beta: FloatArray,
    mean: FloatArray,
) -> np.ndarray:
    """Return where ``tau`` is above the root: the film would be sheared faster than ``speed``, or carry more than its
    limit. ``laws``: of its shear, the last one first."""
    newtonian = tau
    for law in laws:
        newtonian = np.minimum(law.newtonian(newtonian, law.critical_at(p, mean)), MOST_STRESS)
    log_rate = np.log(newtonian) - log_eta  # of gamma_w
    excess = np.exp(np.log(beta * tau * speed**2 / (8 * k)) - log_rate)  # a - 1
    left = np.arcsinh(np.sqrt(excess)) ** 2
    right = np.exp(np.log(beta * tau * h**2 / (8 * k)) + log_rate) + (beta * tau * h * speed / (8 * k)) ** 2
    return right > left
