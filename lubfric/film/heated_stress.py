"""Shear stress across a film that heats itself, between walls of a given temperature.

The stress is constant across the film. If the viscosity falls as exp(-beta (T - T_w)) from the walls, the heat equation
k T'' = -tau gamma integrates in closed form for any law gamma = gamma_w(tau) exp(beta (T - T_w)), Newtonian and
Ree-Eyring: with a = exp(beta (T_middle - T_w)) and G = beta tau gamma_w h²/k, ``a - 1 = beta tau dU²/(8 k gamma_w)``
and ``asinh²√(a - 1) = a G/8``, one root for tau (for a Newtonian fluid `lubfric.film.formulas.nahme_stress`).

With the temperature change:

- the viscosity, by Roelands, ``(ln eta + 9.67) ~ (T - 138 K)^-S0``, with S0 from the temperature coefficient (C. J. A.
  Roelands, thesis, Delft 1966); by exp(-beta (T - T0)) for the other laws;
- the Eyring stress ~ T (H. Eyring, J. Chem. Phys. 4 (1936) 283, doi:10.1063/1.1749836: tau_E = k T/v);
- the limiting stress ~ exp(585 K (1/T - 1/T0)) (L. Houpert, L. Flamand, D. Berthe, J. Lubr. Technol. 103 (1981)
  526-532, doi:10.1115/1.3251731).

Both stresses are taken at the mean temperature of the film, T_w + tau dU h/(12 k). Since the viscosity is linearised
about the walls, it is somewhat too low if the middle of the film is tens of kelvin hotter.
"""

from __future__ import annotations

import numpy as np

from ..errors import InputError
from ..oil import ROELANDS_LOG_VISCOSITY, Lubricant, log_viscosity_ratio

ROELANDS_ZERO = 138.0  # K
LIMIT_ACTIVATION = 585.0  # K
LEAST = 1e-14  # of the Newtonian stress, and
LEAST_STRESS = 1e-3  # Pa, the lower of which is where a heated stress is sought from
STEPS = 64  # halvings of the logarithm of the stress: to 1e-12 and less


def _thermal(lubricant: Lubricant) -> tuple[float, float]:
    """Temperature [K] and temperature coefficient [1/K] of a lubricant that has them (`Lubricant.heats`)."""
    if lubricant.temperature is None or lubricant.temperature_coefficient is None:
        raise InputError("lubricant has no temperature [K] or temperature_coefficient [1/K]; give both, or an oil")
    return lubricant.temperature, lubricant.temperature_coefficient


def viscosity_at(lubricant: Lubricant, pressure, temperature) -> tuple[np.ndarray, np.ndarray]:
    """ln(eta [Pa s]) and -d ln(eta)/dT [1/K] at each pressure [Pa] and temperature [K]."""
    t0, beta = _thermal(lubricant)
    cold = np.log(lubricant.viscosity) + log_viscosity_ratio(lubricant, pressure)[0]
    if lubricant.viscosity_law != "roelands":
        return cold - beta * (temperature - t0), np.broadcast_to(beta, np.shape(cold - temperature)).astype(float)
    above = np.asarray(temperature, dtype=float) - ROELANDS_ZERO
    power = beta * (t0 - ROELANDS_ZERO) / (np.log(lubricant.viscosity) + ROELANDS_LOG_VISCOSITY)
    over_pole = (cold + ROELANDS_LOG_VISCOSITY) * (above / (t0 - ROELANDS_ZERO)) ** -power
    return over_pole - ROELANDS_LOG_VISCOSITY, over_pole * power / above


def eyring_stress_at(lubricant: Lubricant, temperature):
    """tau_E [Pa] at ``temperature`` [K]."""
    return lubricant.eyring_stress * np.asarray(temperature) / _thermal(lubricant)[0]


def limiting_stress_at(lubricant: Lubricant, pressure, temperature):
    """Largest stress [Pa] at each pressure [Pa] and temperature [K]."""
    cold = lubricant.limiting_stress_offset + lubricant.limiting_stress_coefficient * np.maximum(pressure, 0.0)
    return cold * np.exp(LIMIT_ACTIVATION * (1 / np.asarray(temperature) - 1 / _thermal(lubricant)[0]))


def heated_stress(
    lubricant: Lubricant, pressure, film, sliding: float, wall_temperature
) -> tuple[np.ndarray, np.ndarray]:
    """Shear stress [Pa], with the sign of ``sliding`` [m/s], and mean rise of the film over its walls [K].

    ``pressure`` [Pa], ``film`` thickness [m] and ``wall_temperature`` [K]: arrays (n,). By bisection on ln(tau), to
    1e-12.
    """
    speed, k = abs(sliding), lubricant.conductivity
    p, h, wall = (np.asarray(a, dtype=float) for a in np.broadcast_arrays(pressure, film, wall_temperature))
    if speed == 0.0:
        return np.zeros(p.shape), np.zeros(p.shape)
    log_eta, beta = viscosity_at(lubricant, p, wall)
    per_stress = speed * h / (12 * k)  # K/Pa
    high = log_eta + np.log(2 * speed / h)
    low = np.minimum(high + np.log(LEAST), np.log(LEAST_STRESS))
    for _ in range(STEPS):
        middle = 0.5 * (low + high)
        tau = np.exp(middle)
        above = _too_high(lubricant, p, h, speed, tau, log_eta, beta, wall + tau * per_stress)
        low, high = np.where(above, low, middle), np.where(above, middle, high)
    tau = np.exp(0.5 * (low + high))
    return np.copysign(tau, sliding), tau * per_stress


def _too_high(lubricant, p, h, speed, tau, log_eta, beta, mean) -> np.ndarray:
    """Where ``tau`` is above the root: the film would be sheared faster than ``speed``, or carry more than its
    limit."""
    log_rate = np.log(tau) - log_eta  # of gamma_w
    if lubricant.eyring_stress is not None:
        log_rate = log_rate + _log_sinhc(tau / eyring_stress_at(lubricant, mean))
    k = lubricant.conductivity
    with np.errstate(over="ignore"):
        excess = np.exp(np.log(beta * tau * speed**2 / (8 * k)) - log_rate)  # a - 1
        left = np.arcsinh(np.sqrt(excess)) ** 2
        right = np.exp(np.log(beta * tau * h**2 / (8 * k)) + log_rate) + (beta * tau * h * speed / (8 * k)) ** 2
    above = right > left
    if lubricant.limiting_stress_coefficient is not None:
        above |= tau > limiting_stress_at(lubricant, p, mean)
    return above


def _log_sinhc(x):
    """ln(sinh(x)/x), x >= 0."""
    small = np.maximum(x, 1e-6)
    return np.where(x < 1e-4, x**2 / 6, small + np.log(-np.expm1(-2 * small)) - np.log(2 * small))
