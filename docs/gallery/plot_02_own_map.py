"""
Your own height map
===================

Read a map, check it, and compute the friction of a cylinder on it. This script makes its own map, so that it needs no
other file: ridges with noise, similar to a ground surface.
"""

import tempfile
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import lubfric

rng = np.random.default_rng(5)
ridges = np.sin(0.9 * np.arange(240))[:, None] + 0.3 * rng.standard_normal((240, 640))
path = Path(tempfile.mkdtemp()) / "map.npy"
np.save(path, 60e-9 * ridges)  # m; a text file or a file of an instrument works as well

surface = lubfric.read_surface(path, spacing=0.5e-6)
print(surface.describe())

# %%
# The scene uses the file instead of a generated surface, with the grid of the map. Where few asperities are in contact,
# the map is too small for a sampling error of 2 %. The result says so, and states how much more area is needed.

scene = lubfric.load_scene("paper").with_(
    surface={"file": str(path), "spacing": 0.5e-6, "sq": None, "correlation_length": None},
    contact={"shape": None, "spacing": None},
)
curve = lubfric.stribeck(scene, np.geomspace(1e-3, 1.0, 7))
low, high = curve.uncertainty.interval.T
for speed, text in zip(curve.speed, curve.uncertainty.text):
    print(f"{speed:6.3f} m/s: {text}")

figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.8), layout="constrained")
image = left.imshow(1e9 * surface.heights[:120, :120].T, origin="lower", extent=(0, 60, 0, 60), cmap="viridis")
left.set(title="heights (nm), a part of the map", xlabel="x, along the motion (µm)", ylabel="y (µm)")
figure.colorbar(image, ax=left)
right.fill_between(curve.speed, low, high, color="#1f5a94", alpha=0.2, label="95 % interval")
right.semilogx(curve.speed, curve.coefficient, "o-", color="#1f5a94")
right.legend(frameon=False, loc="lower left")
right.set(xlabel="entrainment speed (m/s)", ylabel="friction coefficient (-)", ylim=(0, None))
