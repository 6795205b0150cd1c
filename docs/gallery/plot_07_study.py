"""
A study over loads and viscosities
==================================

A study varies any keys of a scene. It stores every finished point if a folder is given, and returns a table. Here an
executor solves twelve combinations of load and viscosity at four speeds each.
"""

from concurrent.futures import ThreadPoolExecutor

import matplotlib.pyplot as plt
import numpy as np

import lubfric

scene = lubfric.load_scene("paper").with_(
    contact={"shape": (100, 100), "spacing": 0.9e-6}, numerics={"sampling": "patch", "tolerance": 0.02}
)
vary = {"bodies.load": [2.0, 5.5, 11.0], "lubricant.viscosity": [0.1, 0.2, 0.4, 0.8]}
speeds = np.geomspace(3e-3, 0.3, 4)

# %%
# The plan estimates the time before anything is solved.

print(lubfric.plan_study(scene, vary, speeds).explain())

# %%
# Any executor of ``concurrent.futures`` can solve it: a pool of processes, a cluster, or the threads used here. The
# results are the same on each.

with ThreadPoolExecutor(2) as executor:
    study = lubfric.study(scene, vary, speeds, executor=executor)
viscosity, load = np.array(vary["lubricant.viscosity"]), np.array(vary["bodies.load"])
coefficient = study["coefficient"]  # loads x viscosities x speeds

# %%
# Drawn over viscosity times speed over load (the Hersey number per length), the curves nearly coincide.

figure, axes = plt.subplots(figsize=(6.4, 4), layout="constrained")
for w, rows, colour in zip(load, coefficient, ("#1f5a94", "#2f7d4f", "#b3392f")):
    hersey = viscosity[:, None] * speeds / w
    axes.semilogx(hersey.flat, rows.flat, "o", ms=4, color=colour, label=f"{w:g} N")
axes.set(xlabel="viscosity x speed / load (Pa m/N)", ylabel="friction coefficient (-)", ylim=(0, None))
axes.legend(frameon=False)
