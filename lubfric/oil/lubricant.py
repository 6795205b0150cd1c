"""The lubricant: viscosity and density against pressure, shear stress against shear rate.

Pressures are gauge pressures in Pa. A pressure below ambient (it occurs only inside an iteration: a
converged film has p >= 0) continues each law by its tangent at p = 0.
"""

import math
from dataclasses import KW_ONLY, dataclass

import numpy as np
from numpy.typing import ArrayLike

from .._base import Renamed, Shown, validate
from ..errors import InputError
from .oil import Oil
from .shear_laws import FLOW_LAWS, LIMIT_LAWS, LimitingStress, ShearLaw
from .viscosity import checked_temperature

# p0 [Pa] of Roelands' law (Roelands 1966).
ROELANDS_PRESSURE = 1.96e8
# Pressure [Pa] of the density law of Dowson and Higginson (1966).
DENSITY_PRESSURE = 5.9e8
# -ln of the pole viscosity 6.31e-5 Pa s (Roelands 1966).
ROELANDS_LOG_VISCOSITY = 9.67
# Stress [Pa] at ambient pressure above every limiting stress measured in oils.
CARRIED_AT_REST = 5e6
# Rise of `CARRIED_AT_REST` with the pressure [Pa/Pa]; measured limiting stresses have 0.03 to 0.1.
CARRIED = 0.12
# Pressure [Pa] at which no oil flows. A choice: laws of viscosity are extrapolated ten times beyond measurements there.
NO_LIQUID = 1e10


# limiting_stress_coefficient of a Newtonian lubricant whose limit is stated to be f_b p.
AS_BOUNDARY = "f_b"


@dataclass(frozen=True, repr=False)
class Lubricant(Renamed, Shown):
    """A lubricant at one temperature.

    Parameters
    ----------
    viscosity : dynamic viscosity at ambient pressure, eta0 > 0 [Pa s]; above exp(-9.67) =
        6.3e-5 Pa s for the Roelands law
    pressure_viscosity_coefficient : d ln(eta)/dp at ambient pressure, alpha >= 0 [1/Pa];
        > 0 for the Roelands law, not used by the constant law
    viscosity_law : "roelands" (Roelands 1966, thesis Delft, z = alpha p0/(ln eta0 + 9.67), p0 = 1.96e8 Pa;
        fitted to about 1 GPa, an extrapolation above), "barus" (Barus 1893, exp(alpha p);
        overestimates above a few 100 MPa) or "constant"
    density_law : "constant" or "dowson-higginson" (Dowson & Higginson 1966, mineral oil, in the
        form (5.9e8 + 1.34 p)/(5.9e8 + p) usual in EHL; some authors round it to 1 + 0.6e-9 p/(1 + 1.7e-9 p),
        which is up to 0.7 % denser at 1 GPa; fitted to about 0.4 GPa, at most 34 % denser)
    eyring_stress : Eyring stress tau_E > 0 [Pa] (Ree-Eyring flow, typically 2-10 MPa);
        None: Newtonian
    carreau : [G [Pa], n [-]], critical stress and exponent of Carreau's law, 0.1 <= n < 1, in place of Eyring's; None
    limiting_stress_coefficient : Lambda > 0 [-]: |tau| <= tau_0 + Lambda p (Bair & Winer 1979,
        doi:10.1115/1.3453342, typically 0.03-0.1); None: no limit; "f_b": the oil is stated to be Newtonian up to f_b
        p. Without a limit the deterministic model assumes the same, but then the error of f contains the limits of oils
    limiting_stress_offset : tau_0 >= 0 [Pa], the limit at ambient pressure (about 1-5 MPa)
    temperature : T0 [K] at which all these values hold, and temperature_coefficient : beta = -d ln(eta)/dT >= 0 there
        at ambient pressure [1/K]; None: the heat of the film is not known
    conductivity : thermal conductivity of the film [W/(m K)]
    inlet_length : distance [m] upstream of the line of contact at which the lubricant begins, with p = 0 there; None:
        fully flooded
    inlet_film : thickness [m] of the lubricant that arrives on both surfaces together, moving at U, at ambient density.
        It fills the gap from the place at which the flow through the contact equals this supply; None: fully flooded
    oil : the `Oil` that gives viscosity, pressure-viscosity and temperature coefficient (None: they are given as
        numbers)

    shear_modulus : G [Pa] of the film, with which film and discs shear elastically at small slip (K. L. Johnson, J. L.
        Tevaarwerk 1977, doi:10.1098/rspa.1977.0129; oils in contacts about 1e7 to 1e9 Pa); None: no elastic shear

    Raises
    ------
    InputError : a value out of range, or Roelands with alpha = 0
    """

    viscosity: float
    pressure_viscosity_coefficient: float = 0.0
    _: KW_ONLY
    viscosity_law: str = "roelands"
    density_law: str = "constant"
    eyring_stress: float | None = None
    limiting_stress_coefficient: float | str | None = None
    limiting_stress_offset: float = 1e6
    temperature: float | None = None
    temperature_coefficient: float | None = None
    conductivity: float = 0.13
    oil: Oil | None = None
    inlet_length: float | None = None
    inlet_film: float | None = None
    carreau: tuple[float, float] | None = None
    shear_modulus: float | None = None
    _RENAMED = {"newtonian": "has_unlimited_stress"}

    def __post_init__(self) -> None:
        stated = self._state_limit()
        validate.python_fields(self, "lubricant")
        validate.in_range("lubricant", self, prefix="")
        alpha = "pressure_viscosity_coefficient"
        least = math.exp(-ROELANDS_LOG_VISCOSITY)
        if self.viscosity_law == "roelands" and self.pressure_viscosity_coefficient == 0.0:
            raise InputError(
                " is missing or 0 1/Pa, and the Roelands law needs it",
                alpha,
                "> 0 1/Pa, or viscosity_law = 'constant'",
                "give it, or state the oil by lubricant.grade or lubricant.nu40, from which it is estimated",
            )
        if self.viscosity_law == "roelands" and self.viscosity <= least:
            message = f" = {self.viscosity:g} Pa s is out of range for the Roelands law"
            raise InputError(message, "viscosity", f"> exp(-9.67) = {least:.4g} Pa s")
        for kind, what in ((FLOW_LAWS, "two laws of one flow"), (LIMIT_LAWS, "two limits of one stress")):
            keys = [law.key for law in kind if getattr(self, law.key) is not None]
            if len(keys) > 1:
                raise InputError(f" and {keys[0]} are {what}", keys[1], recommendation="give one of them")
        for law in self.shear_laws:
            object.__setattr__(self, law.key, law.checked(getattr(self, law.key)))
        if self.temperature is not None:
            checked_temperature(self.temperature, "lubricant.temperature")
        if stated:
            object.__setattr__(self, LimitingStress.key, AS_BOUNDARY)

    def _state_limit(self) -> bool:
        """Take `AS_BOUNDARY` out of the fields, so that they can be checked as numbers; return whether it was there."""
        if self.limiting_stress_coefficient != AS_BOUNDARY:
            return False
        limiting = [law.key for law in FLOW_LAWS if not law.is_power_law]
        if any(getattr(self, key) is not None for key in limiting):
            message = (
                f" = {AS_BOUNDARY!r} is for a lubricant without a limit of its shear stress, and the law of this one "
                "has a limit"
            )
            laws = " and ".join(limiting)
            raise InputError(message, LimitingStress.key, f"a number, or omit {laws}")
        object.__setattr__(self, LimitingStress.key, None)
        return True

    @property
    def is_limited_by_boundary_friction(self) -> bool:
        """Return True where the limit of a Newtonian lubricant is stated to be f_b p."""
        return self.limiting_stress_coefficient == AS_BOUNDARY

    @property
    def shear_laws(self) -> tuple[ShearLaw, ...]:
        """Return the laws of its shear stress, in the order in which they act; none: Newtonian."""
        return tuple(law for law in (self.flow_law, self.limit) if law is not None)

    @property
    def flow_law(self) -> ShearLaw | None:
        """Return the law by which shear thins the lubricant; None: shear does not thin it."""
        return next((law(self) for law in FLOW_LAWS if getattr(self, law.key) is not None), None)

    @property
    def limit(self) -> LimitingStress | None:
        """Return the law of its largest stress; None: it has none."""
        if self.is_limited_by_boundary_friction:
            return None
        return next((law(self) for law in LIMIT_LAWS if getattr(self, law.key) is not None), None)

    @property
    def heats(self) -> bool:
        """Return True where temperature and temperature coefficient are known, so that the heat of the film can be
        found."""
        return self.temperature is not None and bool(self.temperature_coefficient)

    @property
    def floods(self) -> bool:
        """Return True where nothing limits the lubricant in the inlet."""
        return self.inlet_length is None and self.inlet_film is None

    @property
    def has_unlimited_stress(self) -> bool:
        """Return True where the shear stress grows with the shear rate without end: of a Newtonian oil, and where every
        shear law is a power at large rates."""
        return all(law.is_power_law for law in self.shear_laws)

    @property
    def roelands_exponent(self) -> float:
        """z = alpha p0/(ln eta0 + 9.67)."""
        pole = math.log(self.viscosity) + ROELANDS_LOG_VISCOSITY
        return self.pressure_viscosity_coefficient * ROELANDS_PRESSURE / pole


def log_viscosity_ratio(lubricant: Lubricant, pressure: ArrayLike) -> tuple[np.ndarray, np.ndarray]:
    """Return ln(eta/eta0) [-] and its derivative [1/Pa] at each pressure [Pa], any shape."""
    p = np.asarray(pressure, dtype=float)
    alpha = lubricant.pressure_viscosity_coefficient
    if lubricant.viscosity_law == "constant":
        return np.zeros_like(p), np.zeros_like(p)
    if lubricant.viscosity_law == "barus":
        return alpha * p, np.full_like(p, alpha)
    z = lubricant.roelands_exponent
    base = 1.0 + np.maximum(p, 0.0) / ROELANDS_PRESSURE
    slope = alpha * base ** (z - 1.0)
    value = (slope * base - alpha) * (ROELANDS_PRESSURE / z)
    return np.where(p > 0.0, value, alpha * p), slope


def viscosity(lubricant: Lubricant, pressure: ArrayLike) -> np.ndarray:
    """Return the dynamic viscosity eta(p) [Pa s] at each pressure [Pa]."""
    return lubricant.viscosity * np.exp(log_viscosity_ratio(lubricant, pressure)[0])


def density_ratio(lubricant: Lubricant, pressure: ArrayLike) -> tuple[np.ndarray, np.ndarray]:
    """Return rho/rho0 [-] and its derivative [1/Pa] at each pressure [Pa], any shape."""
    p = np.asarray(pressure, dtype=float)
    if lubricant.density_law == "constant":
        return np.ones_like(p), np.zeros_like(p)
    d = DENSITY_PRESSURE + np.maximum(p, 0.0)
    return 1.0 + 0.34 * p / d, 0.34 * DENSITY_PRESSURE / d**2


def shear_stress(lubricant: Lubricant, pressure: ArrayLike, shear_rate: ArrayLike) -> np.ndarray:
    """Return the shear stress [Pa] of a simple shear flow at pressure [Pa] and signed shear rate [1/s].

    Newtonian ``eta(p) shear_rate``, thinned and cut by the laws of the lubricant (`lubfric.oil.shear_laws`).
    """
    tau = viscosity(lubricant, pressure) * np.asarray(shear_rate, dtype=float)
    for law in lubricant.shear_laws:
        tau = law.stress(tau, law.critical(pressure)[0])
    return tau


def carried_stress(pressure: ArrayLike) -> np.ndarray:
    """Return what an oil carries at most [Pa] at ``pressure`` [Pa], any shape: 5 MPa + 0.12 p."""
    return CARRIED_AT_REST + CARRIED * np.maximum(pressure, 0.0)
