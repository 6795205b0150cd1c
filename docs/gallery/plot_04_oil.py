"""
Oil and temperature
===================

From the oil can to the friction coefficient: an ISO VG 68 oil, its viscosity index, and the temperature of
the bath.
"""

import matplotlib.pyplot as plt
import numpy as np

import lubfric
from lubfric import oil

used = oil.from_grade("ISO VG 68", 95, density=870)
temperature = np.linspace(293.15, 393.15, 41)  # K
viscosity = [used.viscosity(t) for t in temperature]

# %%
# The pressure-viscosity coefficient is not on the can. It is estimated, and the estimate states how far
# measured oils lie from it.

print(used.pressure_viscosity_coefficient(343.15).text)

# %%
# A scene takes grade, index and temperature as keys.

scene = lubfric.load_scene("paper").with_(numerics={"sampling_tolerance": 0.1})
curves = {}
for celsius in (40, 70, 100):
    keys = {"grade": "ISO VG 68", "viscosity_index": 95.0, "temperature": celsius + 273.15}
    curves[celsius] = lubfric.stribeck(scene.with_(lubricant=keys), np.geomspace(1e-3, 3.0, 7))

figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.8), layout="constrained")
left.semilogy(temperature - 273.15, viscosity, color="#1f5a94")
left.set(xlabel="temperature (°C)", ylabel="viscosity (Pa s)")
for (celsius, curve), colour in zip(curves.items(), ("#1f5a94", "#7d6ba0", "#b3392f")):
    right.semilogx(curve.speed, curve.coefficient, "o-", ms=4, color=colour, label=f"{celsius} °C")
right.set(xlabel="entrainment speed (m/s)", ylabel="friction coefficient (-)", ylim=(0, None))
right.legend(frameon=False)
