"""
A first Stribeck curve
======================

The built-in scene ``paper`` is a steel cylinder on a moving disk. The curve shows three regimes. The asperities carry
the load in boundary lubrication, at low speed. The film carries it in full-film lubrication, at high speed. In mixed
lubrication they share it.
"""

import matplotlib.pyplot as plt
import numpy as np

import lubfric

scene = lubfric.load_scene("paper")
curve = lubfric.stribeck(scene, np.geomspace(1e-4, 1.0, 9))

# %%
# The two forces add up to the load of 5.5 N at every speed. The band is the 95 % interval of the friction coefficient.

print(f"largest load error: {max(abs(curve.load_residual)):.1e}")

figure, (upper, lower) = plt.subplots(2, sharex=True, figsize=(6.4, 5.6), layout="constrained")
low, high = curve.uncertainty.interval.T
upper.fill_between(curve.speed, low, high, color="#1f5a94", alpha=0.2, label="95 % interval")
upper.semilogx(curve.speed, curve.coefficient, "o-", color="#1f5a94", label="friction coefficient")
upper.legend(frameon=False)
upper.set(ylabel="friction coefficient (-)", ylim=(0, None))
lower.semilogx(curve.speed, curve.contact_load, "o-", color="#b3392f", label="asperities")
lower.semilogx(curve.speed, curve.film_load, "o-", color="#1f5a94", label="film")
lower.set(xlabel="entrainment speed (m/s)", ylabel="load (N)")
lower.legend(frameon=False)
