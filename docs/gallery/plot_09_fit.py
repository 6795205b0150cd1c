"""
A fit to a measured curve
=========================

Which boundary friction coefficient explains a measured Stribeck curve, and how well can the data tell? The
measurement of this example is made up: a computed curve with a coefficient of 0.12 and 5 % noise. So the answer is
known.
"""

import numpy as np

import lubfric

scene = lubfric.load_scene("paper").with_(
    contact={"shape": (100, 100), "spacing": 0.9e-6}, numerics={"sampling": "patch", "tolerance": 0.02}
)
speeds = np.geomspace(1e-3, 0.3, 7)
rng = np.random.default_rng(4)
truth = lubfric.stribeck(scene.with_(bodies={"boundary_friction_coefficient": 0.12}), speeds)
noisy = truth.coefficient * (1 + 0.05 * rng.standard_normal(speeds.size))

# %%
# The search is bounded. About how long it takes is said before. The result says how sure each parameter is.

measured, bounds = lubfric.Measured(speeds, noisy), {"bodies.boundary_friction_coefficient": (0.05, 0.2)}
print(lubfric.explain_fit(scene, measured, bounds))
found = lubfric.fit(scene, measured, bounds)
print(found.explain())

axes = found.plot()
axes.semilogx(speeds, truth.coefficient, "--", color="0.5", label="truth")
axes.set(ylim=(0, None))
axes.legend(frameon=False)
