"""
A fit to a measured curve
=========================

A fit determines the boundary friction coefficient from a measured Stribeck curve, with an interval. The measurement of
this example is synthetic: a computed curve with a coefficient of 0.12 and 5 % noise. So the true value is known.
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
# The search has bounds. The time is estimated before the fit. The result has an interval for each parameter.

measured, bounds = lubfric.Measured(speeds, noisy), {"bodies.boundary_friction_coefficient": (0.05, 0.2)}
print(lubfric.explain_fit(scene, measured, bounds))
fitted = lubfric.fit(scene, measured, bounds)
print(fitted.explain())

axes = fitted.plot()
axes.semilogx(speeds, truth.coefficient, "--", color="0.5", label="true curve")
axes.set(ylim=(0, None))
axes.legend(frameon=False)
