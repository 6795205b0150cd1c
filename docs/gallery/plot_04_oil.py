"""
Oil and temperature
===================

From the label of an oil to the friction coefficient: ISO VG 68, its viscosity index, and its temperature.
"""

import matplotlib.pyplot as plt
import numpy as np

import lubfric
from lubfric import oil

vg68 = oil.from_grade("ISO VG 68", 95, density=870)
temperature = np.linspace(293.15, 393.15, 41)  # K
viscosity = [vg68.viscosity(t) for t in temperature]

# %%
# The pressure-viscosity coefficient is not on the label. It is estimated, and the estimate states the range of measured
# oils.

print(vg68.pressure_viscosity_coefficient(343.15).text)

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
