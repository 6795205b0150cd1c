"""Inlet shear heating: the film is thinner because its inlet is warmer than the oil around.

Two published factors, h/h_isothermal over the thermal number ``L = eta0 beta U²/k`` and the slide-roll ratio S:

- P. K. Gupta, H. S. Cheng, D. Zhu, N. H. Forster, J. B. Schrand, Tribol. Trans. 35 (1992) 269-274,
  doi:10.1080/10402009208982117: ``(1 - 13.2 (p_h/E') L^0.42)/(1 + 0.213 (1 + 2.23 S^0.83) L^0.64)``: used here;
- W. R. D. Wilson, S. Sheu, J. Lubr. Technol. 105 (1983) 187-188, doi:10.1115/1.3254563, as used by A. V. Olver, H. A.
  Spikes, Proc. Inst. Mech. Eng. J 212 (1998) 321-332, doi:10.1243/1350650981542137: ``1/(1 + 0.1 (1 + 14.8 S^0.83)
  L^0.64)``. The note of Wilson and Sheu itself has 0.241 in place of 0.1, and S/2 in place of S, at the same L.

In rolling they agree to some 10 %. Both were fitted near rolling. At S = 2 they differ by up to 100 % (0.47 and 0.27 at
L = 1; 0.21 by the note itself), and which is right is not known. Every factor comes with this difference.
"""

from __future__ import annotations

from dataclasses import dataclass

SLIDING = 0.5  # |S| above which the factors are used outside the range they were made for
LARGEST = 20.0  # L above which neither is supported by the solutions they were fitted to


@dataclass(frozen=True)
class InletHeat:
    """thermal_number L [-], factor on the film (Gupta et al.) and other (Wilson and Sheu) [-]."""

    thermal_number: float
    factor: float
    other: float

    @property
    def text(self) -> str:
        """The factors in words."""
        return (
            f"inlet shear heating: film x {self.factor:.3g} (Gupta et al. 1992; {self.other:.3g} by Wilson and Sheu "
            f"1983), L = {self.thermal_number:.2g}"
        )


def inlet_heat(
    *, viscosity, temperature_coefficient, conductivity, speed, slide_roll_ratio, pressure_ratio
) -> InletHeat:
    """Factors at eta0 [Pa s], beta [1/K], k [W/(m K)], entrainment speed U [m/s], slide-roll ratio [-] and p_h/E'
    [-]."""
    number = viscosity * temperature_coefficient * speed**2 / conductivity
    sliding = abs(slide_roll_ratio) ** 0.83
    pressed = max(1 - 13.2 * pressure_ratio * number**0.42, 0.0)
    factor = pressed / (1 + 0.213 * (1 + 2.23 * sliding) * number**0.64)
    return InletHeat(number, factor, 1 / (1 + 0.1 * (1 + 14.8 * sliding) * number**0.64))
