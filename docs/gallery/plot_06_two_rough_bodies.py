"""
Two rough bodies
================

Both surfaces of a contact are rough. Only the gap between them has an effect, so their maps are interpolated to one
grid and added. In this example a roller runs on a race with finer roughness.
"""

import matplotlib.pyplot as plt
import numpy as np

import lubfric

SHAPE, STEP = (200, 200), 0.45e-6
roller = lubfric.generate_surface(SHAPE, STEP, sq=100e-9, correlation_length=8e-6, acf="gaussian", seed=1)
race = lubfric.generate_surface(SHAPE, STEP, sq=60e-9, correlation_length=4e-6, acf="gaussian", seed=2)
both = roller.combined(race)

# %%
# For independent surfaces the squares of Sq add up.

print(f"Sq {1e9 * roller.sq:.0f} nm and {1e9 * race.sq:.0f} nm give {1e9 * both.sq:.1f} nm")

scene = lubfric.load_scene("paper")
speeds = np.geomspace(1e-3, 1.0, 9)
curves = {
    "roller on a smooth race": lubfric.stribeck(lubfric.prepare(scene, roller), speeds),
    "roller on a rough race": lubfric.stribeck(lubfric.prepare(scene, both), speeds),
}

figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.8), layout="constrained")
left.plot(1e6 * STEP * np.arange(200), 1e9 * roller.heights[:, 100], color="#1f5a94", label="roller")
left.plot(1e6 * STEP * np.arange(200), 1e9 * both.heights[:, 100], color="#b3392f", lw=1, label="roller and race")
left.set(xlabel="x (µm)", ylabel="height (nm)")
left.legend(frameon=False)
for (name, curve), colour in zip(curves.items(), ("#1f5a94", "#b3392f")):
    right.semilogx(curve.speed, curve.coefficient, "o-", ms=4, color=colour, label=name)
right.set(xlabel="entrainment speed (m/s)", ylabel="friction coefficient (-)", ylim=(0, None))
right.legend(frameon=False)
