"""The laws of the shear stress, each written once: friction, heat, runs in time and both models take them from here.

A lubricant has at most one law of each kind, by the keys that it is given. Both know a critical stress tau_c:

- a flow law (`ShearLaw`) says how shear thins the lubricant, a generalised Newtonian fluid: its stress over tau_c is a
  function f of s, the Newtonian stress eta gamma over tau_c;
- a limit (`LimitingStress`) cuts the stress that is left at tau_c.

What a law leaves out and a model requests is refused with an `InputError`. CONTRIBUTING.md shows how to add one.
"""

from typing import Any, NoReturn

import numpy as np
from numpy.typing import ArrayLike

from .._base import FloatArray, validate
from ..errors import InputError

# Activation temperature of the limiting stress [K] (Houpert, Flamand, Berthe 1981).
LIMIT_ACTIVATION = 585.0
# s [-] below which a fluid is Newtonian. A choice: s/f(s) is 1 to rounding there.
NEWTONIAN_S = 1e-6


class ShearLaw:
    """How shear thins the lubricant ``oil`` (`lubfric.Lubricant`), which has the ``key`` of the law; ``others``: keys
    in addition to it. ``cited_as``, ``heat_cited_as``: the names under which `lubfric.estimate` cites (papers.toml) the
    law, and its `warmth`; "": not at all; ``is_cited_without_sliding``: whether that source is about more than the
    friction of a film that is sheared. ``thins``: whether the flow of the smooth film thins by it as well; for that
    tau_c has to be the same at any pressure. ``is_power_law``: whether f is a power of s at large s, so that the stress
    grows without end. ``is_calibrated``: whether the solved cases of the quick model have such oils."""

    key = ""
    cited_as = ""
    heat_cited_as = ""
    is_cited_without_sliding = False
    others: tuple[Any, ...] = ()
    thins = False
    is_power_law = False
    is_calibrated = False

    @property
    def power_law_exponent(self) -> float | None:
        """The exponent n of f ~ s^n at large s, by which closed forms estimate how shear thins a smooth film; None: f
        grows like no power, and they leave its film as it is."""
        return None

    def __init__(self, oil: Any):
        self.oil = oil

    @classmethod
    def checked(cls, value: Any) -> Any:
        """Return the ``value`` of the key, checked beyond what keys.toml says of it."""
        return value

    def critical(self, pressure: ArrayLike) -> tuple[Any, Any]:
        """Return tau_c [Pa] at each pressure [Pa], and its change with the pressure [-]; both numbers if that is 0."""
        self.refuse("critical", "everything", "omit the key")

    def warmth(self, temperature: ArrayLike) -> FloatArray:
        """Return tau_c at a temperature [K] over that at the temperature of the lubricant."""
        self.refuse("warmth", "the heat of the film", "set numerics.heat = 'off'")

    def critical_at(self, pressure: ArrayLike, temperature: ArrayLike) -> FloatArray:
        """Return tau_c [Pa] at pressure [Pa] and temperature [K]."""
        return self.critical(pressure)[0] * self.warmth(temperature)

    def refuse(self, part: str, model: str, recommendation: str) -> NoReturn:
        """Raise `InputError`: this law does not have the ``part`` that the ``model`` needs."""
        message = f" has a shear law without {part}, which {model} needs"
        raise InputError(
            message,
            f"lubricant.{self.key}",
            recommendation=f"give it in lubfric/oil/shear_laws.py, or {recommendation}",
        )

    def f(self, s: float | np.ndarray) -> FloatArray:
        """Return tau/tau_c, odd in s."""
        self.refuse("f", "everything", "omit the key")

    def tangent(self, s: float | np.ndarray) -> tuple[FloatArray, FloatArray]:
        """Return Φ = 1/f' and s dΦ/ds, at s >= 0."""
        self.refuse("tangent", "the deterministic model", "set numerics.model = 'paper'")

    def inverse(self, x: float | np.ndarray) -> FloatArray:
        """Return s of tau/tau_c = x, odd in x."""
        self.refuse("inverse", "the heat of the film", "set numerics.heat = 'off'")

    def as_temperature(self, temperature: ArrayLike) -> FloatArray:
        """Return the `warmth` of a tau_c that is proportional to the temperature."""
        return np.asarray(temperature) / self.oil.temperature

    def stress(self, newtonian: float | np.ndarray, critical: float | np.ndarray) -> FloatArray:
        """Return the stress [Pa] at the ``newtonian`` one."""
        return critical * self.f(newtonian / critical)

    def newtonian(self, stress: float | np.ndarray, critical: float | np.ndarray) -> FloatArray:
        """Return the Newtonian stress [Pa] at the ``stress`` that there is."""
        return critical * self.inverse(stress / critical)

    def thinning(self, s: float | np.ndarray, *, along: bool) -> tuple[Any, Any]:
        """Return Φ and s dΦ/ds of a small pressure flow in addition to the sliding: by the tangent 1/f' along it, by
        the secant s/f across (perturbation of a Couette flow: T. F. Conry, S. Wang, C. Cusano, J. Tribol. 109 (1987)
        648-654, doi:10.1115/1.3261526)."""
        if along:
            return self.tangent(s)
        s = np.maximum(s, NEWTONIAN_S)
        factor = s / self.f(s)
        return factor, factor - factor**2 / self.tangent(s)[0]


class Eyring(ShearLaw):
    """Ree-Eyring: f = asinh s (Johnson & Tevaarwerk 1977, doi:10.1098/rspa.1977.0129), tau_E = k T/v (H. Eyring, J.
    Chem. Phys. 4 (1936) 283, doi:10.1063/1.1749836)."""

    key = "eyring_stress"
    cited_as = "Eyring stress"
    heat_cited_as = "hot Eyring stress"
    thins = True
    is_calibrated = True
    warmth = ShearLaw.as_temperature

    def critical(self, pressure: ArrayLike) -> tuple[Any, Any]:
        return self.oil.eyring_stress, 0.0

    def f(self, s: float | np.ndarray) -> FloatArray:
        return np.arcsinh(s)

    def tangent(self, s: float | np.ndarray) -> tuple[FloatArray, FloatArray]:
        factor = np.hypot(1.0, s)
        return factor, s * (s / factor)

    def inverse(self, x: float | np.ndarray) -> FloatArray:
        return np.sinh(x)


class Carreau(ShearLaw):
    """f = s (1 + s²)^((n - 1)/2) (P. J. Carreau, Trans. Soc. Rheol. 16 (1972) 99-127); G ~ T, as the Eyring stress."""

    key = "carreau"
    cited_as = "Carreau"
    is_cited_without_sliding = True
    thins = True
    is_power_law = True
    warmth = ShearLaw.as_temperature

    @classmethod
    def checked(cls, value: Any) -> Any:
        if not isinstance(value, (list, tuple)) or len(value) != 2:
            raise InputError(f" = {validate.shown(value)}", "carreau", "[G, n]: critical stress in Pa and exponent")
        G = validate.positive("carreau (G)", value[0], "Pa")
        return G, validate.number("carreau (n)", value[1], "(-)", minimum=0.1, maximum=0.999)

    @property
    def power_law_exponent(self) -> float:
        return float(self.oil.carreau[1])

    def critical(self, pressure: ArrayLike) -> tuple[Any, Any]:
        return self.oil.carreau[0], 0.0

    def f(self, s: float | np.ndarray) -> FloatArray:
        return s * (1 + s**2) ** (0.5 * (self.oil.carreau[1] - 1))

    def tangent(self, s: float | np.ndarray) -> tuple[FloatArray, FloatArray]:
        n = self.oil.carreau[1]
        square = s**2
        factor = (1 + square) ** ((3 - n) / 2) / (1 + n * square)
        return factor, factor * ((3 - n) * square / (1 + square) - 2 * n * square / (1 + n * square))

    def inverse(self, x: float | np.ndarray) -> FloatArray:
        n = self.oil.carreau[1]
        log_x = np.log(np.maximum(np.abs(x), 1e-300))
        y = log_x + 0.5 * (1 / n - 1) * np.logaddexp(0, 2 * log_x)  # ln s by a law alike
        for _ in range(6):  # doubling digits: to the last bit
            steep = 1 + (n - 1) / (1 + np.exp(np.minimum(-2 * y, 700.0)))  # d ln x/d ln s
            y = y - (y + 0.5 * (n - 1) * np.logaddexp(0, 2 * y) - log_x) / steep
        return np.copysign(np.exp(y), x)


class LimitingStress(ShearLaw):
    """The largest stress that the lubricant bears, tau_0 + Λ p (Bair & Winer 1979, doi:10.1115/1.3453342), ~ exp(585 K
    (1/T - 1/T0)) (L. Houpert, L. Flamand, D. Berthe, J. Lubr. Technol. 103 (1981) 526-532, doi:10.1115/1.3251731)."""

    key = "limiting_stress_coefficient"
    cited_as = "limiting stress"
    heat_cited_as = "hot limiting stress"
    is_calibrated = True
    others = ("limiting_stress_offset",)

    def critical(self, pressure: ArrayLike) -> tuple[Any, Any]:
        slope = self.oil.limiting_stress_coefficient
        return self.oil.limiting_stress_offset + slope * np.maximum(pressure, 0.0), slope

    def warmth(self, temperature: ArrayLike) -> FloatArray:
        return np.exp(LIMIT_ACTIVATION * (1 / np.asarray(temperature) - 1 / self.oil.temperature))

    def twice(self) -> dict[str, Any]:
        """Return fields of a lubricant with twice this tau_c: those that it is proportional to."""
        return {key: 2 * getattr(self.oil, key) for key in (self.key, *self.others)}

    def stress(self, newtonian: float | np.ndarray, critical: float | np.ndarray) -> FloatArray:
        """Return the stress [Pa] at the ``newtonian`` one."""
        return np.clip(newtonian, -critical, critical)

    def newtonian(self, stress: float | np.ndarray, critical: float | np.ndarray) -> FloatArray:
        """Return the Newtonian stress [Pa] at the ``stress`` >= 0 that there is; infinite above what it bears."""
        return np.where(stress > critical, np.inf, stress)

    def thinning(self, s: float | np.ndarray, *, along: bool) -> tuple[Any, Any]:
        """Return Φ and s dΦ/ds by the secant of ``1/eta_eff = 1/eta + Δu/(h tau_c)``, 1 + s, in both directions. (The
        tangent of a fluid at its limit is infinite.)"""
        return 1.0 + s, s


FLOW_LAWS: tuple[type[ShearLaw], ...] = (Eyring, Carreau)
LIMIT_LAWS: tuple[type[LimitingStress], ...] = (LimitingStress,)
