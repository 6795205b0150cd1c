"""
Your own height map
===================

Read a map, look at it, set it under a cylinder. The map of this example is made here, so that the script runs
anywhere: ridges with some noise, as a grinding wheel leaves them.
"""

import tempfile
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import lubfric

rng = np.random.default_rng(5)
ridges = np.sin(0.9 * np.arange(180))[:, None] + 0.3 * rng.standard_normal((180, 160))
path = Path(tempfile.mkdtemp()) / "map.npy"
np.save(path, 60e-9 * ridges)

surface = lubfric.read_surface(path, spacing=0.5e-6)
print(surface.describe())

# %%
# The scene takes the file in place of its generated surface, and keeps the map's own grid.

scene = lubfric.load_scene("paper").with_(
    surface={"file": str(path), "spacing": 0.5e-6, "sq": None, "correlation_length": None},
    contact={"shape": None, "spacing": None},
)
curve = lubfric.stribeck(scene, np.geomspace(1e-3, 1.0, 7))

figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.8), layout="constrained")
image = left.imshow(1e9 * surface.heights.T, origin="lower", extent=(0, 90, 0, 80), cmap="viridis")
left.set(title="heights (nm)", xlabel="x, along the motion (µm)", ylabel="y (µm)")
figure.colorbar(image, ax=left)
right.semilogx(curve.speed, curve.coefficient, "o-", color="#1f5a94")
right.set(xlabel="entrainment speed (m/s)", ylabel="friction coefficient (-)", ylim=(0, None))
