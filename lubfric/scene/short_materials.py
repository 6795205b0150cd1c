"""Named materials of the bodies: typical handbook values at room temperature.

Young's modulus and Poisson ratio are good to some 5 % within a family (ceramics and polymers 10 %), thermal data to
some 20 %; give the numbers themselves where they are known.
"""

from __future__ import annotations

from dataclasses import dataclass

from .._base import validate


@dataclass(frozen=True)
class Material:
    """young_modulus [Pa], poisson_ratio [-], conductivity [W/(m K)], volumetric_heat rho c [J/(m³ K)]."""

    young_modulus: float
    poisson_ratio: float
    conductivity: float
    volumetric_heat: float


MATERIALS = {
    "steel": Material(207e9, 0.30, 46.0, 7850 * 460.0),  # through-hardened bearing steel
    "stainless steel": Material(200e9, 0.30, 25.0, 7750 * 460.0),  # martensitic
    "cast iron": Material(110e9, 0.26, 50.0, 7200 * 500.0),  # grey
    "bronze": Material(110e9, 0.34, 55.0, 8800 * 380.0),  # tin bronze
    "brass": Material(105e9, 0.35, 115.0, 8500 * 380.0),
    "aluminium": Material(70e9, 0.33, 150.0, 2700 * 900.0),  # alloys
    "titanium": Material(114e9, 0.34, 7.0, 4430 * 530.0),  # Ti-6Al-4V
    "silicon nitride": Material(310e9, 0.26, 28.0, 3230 * 700.0),
    "alumina": Material(380e9, 0.23, 28.0, 3900 * 800.0),
    "zirconia": Material(205e9, 0.31, 2.5, 6050 * 460.0),
    "tungsten carbide": Material(600e9, 0.22, 85.0, 14900 * 200.0),  # 6 % cobalt
    "glass": Material(82e9, 0.21, 1.1, 2510 * 860.0),  # BK7
    "sapphire": Material(420e9, 0.27, 40.0, 3980 * 760.0),
    "polyamide": Material(2.8e9, 0.40, 0.25, 1140 * 1700.0),  # dry, short loads: it creeps
    "peek": Material(3.8e9, 0.40, 0.27, 1310 * 1300.0),  # creeps
}


def material(name: str) -> Material:
    """The named material; an error lists the known ones."""
    return MATERIALS[validate.choice("bodies.material", name, tuple(MATERIALS))]
