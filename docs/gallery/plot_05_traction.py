"""
Traction with and without heat
==============================

A roller of 10 mm runs on a plane at 2 m/s, with ISO VG 68 at 70 °C.

Left: friction over the slide-roll ratio at three Hertz pressures. The full lines include the heat of inlet, film and
surfaces, the dashed lines do not.

Right: without heat the curves coincide, as Jacod, Venner and Lugt found (J. Tribol. 123 (2001) 248-253,
doi:10.1115/1.1308021). The characteristic stress is eta(mean pressure) du/h. Above about the Eyring stress, friction in
units of the Eyring stress over the mean pressure depends on it alone. Below, the film is nearly Newtonian, and the
points at 0.5 GPa are above the grey line, which is for a uniform pressure.
"""

import matplotlib.pyplot as plt
import numpy as np

import lubfric
from lubfric.oil import viscosity

ratios = np.geomspace(1e-3, 2, 9)
scene = lubfric.load_scene("paper").with_(
    bodies={"radius": 10e-3, "width": 10e-3, "material": "steel", "hardness": None},
    lubricant={"grade": "ISO VG 68", "viscosity_index": 95, "temperature_celsius": 70, "eyring_stress": 5e6},
    motion={"entrainment_speed": 2.0},
    surface={"sq": 5e-9, "correlation_length": 40e-6, "acf": "gaussian"},
    contact={"shape": (120, 32), "spacing": 7e-6},
    numerics={"sampling": "patch", "film_deflection": "hydrodynamic", "tolerance": 0.03},
)

figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4), layout="constrained")
for peak, colour in ((0.5e9, "#1f5a94"), (1.0e9, "#2f7d4f"), (1.5e9, "#b3392f")):
    loaded = scene.with_(bodies={"hertz_pressure": peak})
    hot = lubfric.traction(loaded, ratios)
    cold = lubfric.traction(loaded.with_(numerics={"heat": "off"}), ratios)
    left.semilogx(ratios, hot.coefficient, "-o", ms=3, color=colour, label=f"{peak / 1e9:g} GPa")
    left.semilogx(ratios, cold.coefficient, "--", color=colour)
    mean = loaded.bodies.mean_hertz_pressure
    stress = viscosity(loaded.lubricant, mean) * ratios * 2.0 / cold["central_film"]
    right.loglog(stress / 5e6, cold["couette_force"] / loaded.bodies.load * mean / 5e6, "o", ms=4, color=colour)
right.loglog(*2 * [np.geomspace(1e-2, 1, 2)], ":", color="grey")
s = np.geomspace(1e-2, 1e7, 200)
right.loglog(s, np.arcsinh(s), "-", lw=1, color="grey", label="asinh, uniform pressure")
left.set(xlabel="slide-roll ratio (-)", ylabel="friction coefficient (-)")
right.set(xlabel="characteristic stress over Eyring stress (-)", ylabel="reduced friction (-)")
left.plot([], [], "--", color="grey", label="without heat")
left.set_ylim(0, None)
left.legend(frameon=False)
right.legend(frameon=False)
