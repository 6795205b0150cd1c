"""
Uncertainty of the paper's curve
================================

The paper measured a cylinder on a disk (its Fig. 8), but publishes neither the points as numbers nor all inputs. Three
inputs are uncertain: the surface (only Sq 100 nm is stated), f_b (0.09, from the same measurement), and the temperature
("room temperature, 25 °C"). The oil has 150 mm²/s at 40 °C; the 0.36 Pa s of the paper's table is for 25 °C.

Each band shows the effect of one input: five surfaces of that Sq, with correlation lengths of 2 to 16 µm; f_b within
10 %; temperatures of 22 to 28 °C.
"""

import matplotlib.pyplot as plt
import numpy as np

import lubfric

SPEEDS = np.geomspace(1e-3, 1.0, 7)
base = lubfric.load_scene("paper").with_(numerics={"model": "quick", "sampling": "patch"})


def curve(**changes) -> np.ndarray:
    return lubfric.stribeck(base.with_(**changes), SPEEDS).coefficient


def viscosity(celsius: float) -> float:
    """Return the viscosity [Pa s], with the slope of a mineral oil of 150 mm²/s at 40 °C and 14.5 at 100 °C."""
    low, high = (np.log10(np.log10(v + 0.7)) for v in (150, 14.5))
    slope = (low - high) / np.log10(373.15 / 313.15)
    values = [10**10 ** (low - slope * np.log10((273.15 + t) / 313.15)) - 0.7 for t in (celsius, 25)]
    return 0.36 * values[0] / values[1]


surfaces = [
    {"correlation_length": 2e-6},
    {"correlation_length": 4e-6, "seed": 2},
    {"correlation_length": 16e-6, "seed": 3},
    {"correlation_length": 16e-6, "seed": 4},
    {"correlation_length": 8e-6, "acf": "exponential"},
]
uncertain_inputs = {
    "surface": [{"surface": one} for one in surfaces],
    "f_b within 10 %": [{"bodies": {"boundary_friction_coefficient": f_b}} for f_b in (0.081, 0.099)],
    "22 to 28 °C": [{"lubricant": {"viscosity": viscosity(t)}} for t in (22, 28)],
}

known = curve()
figure, axes = plt.subplots(figsize=(6.5, 4), layout="constrained")
for name, changes in uncertain_inputs.items():
    curves = np.array([known, *(curve(**one) for one in changes)])
    axes.fill_between(SPEEDS, curves.min(0), curves.max(0), alpha=0.3, label=name)
axes.semilogx(SPEEDS, known, "k-", label="built-in scene")
axes.axhline(0.09, color="grey", ls=":", label="f_b of the paper")
axes.set(xlabel="entrainment speed (m/s)", ylabel="friction coefficient (-)", ylim=(0, None))
axes.legend(frameon=False)
