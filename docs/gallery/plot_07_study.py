"""
A study over loads and viscosities
==================================

A study varies any key of a scene. It needs no loops, keeps every finished point in a folder when one is
given, and hands back a table. Here twelve combinations of load and viscosity are solved at four speeds each.
"""

import matplotlib.pyplot as plt
import numpy as np

import lubfric

scene = lubfric.load_scene("paper").with_(
    contact={"shape": (100, 100), "spacing": 0.9e-6}, numerics={"sampling": "patch", "tolerance": 0.02}
)
vary = {"bodies.load": [2.0, 5.5, 11.0], "lubricant.viscosity": [0.1, 0.2, 0.4, 0.8]}
speeds = np.geomspace(3e-3, 0.3, 4)

# %%
# The plan tells what it will cost before anything is solved.

print(lubfric.plan_study(scene, vary, speeds).explain())

# %%
# Any executor of ``concurrent.futures`` may carry it out; without one it runs here.

found = lubfric.study(scene, vary, speeds)
viscosity, load = np.array(vary["lubricant.viscosity"]), np.array(vary["bodies.load"])
coefficient = found["coefficient"]  # loads x viscosities x speeds

# %%
# Drawn over viscosity times speed over load, the curves nearly fall on one.

figure, axes = plt.subplots(figsize=(6.4, 4), layout="constrained")
for w, rows in zip(load, coefficient):
    hersey = viscosity[:, None] * speeds / w
    order = np.argsort(hersey, axis=None)
    axes.semilogx(hersey.flat[order], rows.flat[order], "o", ms=4, label=f"{w:g} N")
axes.set(xlabel="viscosity x speed / load (Pa m/N)", ylabel="friction coefficient (-)", ylim=(0, None))
axes.legend(frameon=False)
