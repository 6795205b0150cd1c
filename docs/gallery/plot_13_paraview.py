"""
Fields for ParaView
===================

One file contains surface, contact pressure, gap and film of an operating point. In ParaView, "warp by scalar" with the
height shows the surface. ``lubfric run --vtk`` writes the same file.
"""

import tempfile
from pathlib import Path

import matplotlib.pyplot as plt

import lubfric
from lubfric.output.fields import vtk_bytes

model = lubfric.prepare(lubfric.load_scene("paper").with_(numerics={"sampling": "patch"}))
point = lubfric.friction(model, 0.003, fields=True)

path = Path(tempfile.mkdtemp()) / "contact.vtk"
path.write_bytes(vtk_bytes(point))
print(f"{path.name}: {path.stat().st_size / 2**20:.1f} MiB, {point.x.size} x {point.y.size} points")

# %%
# The same fields from Python: the pressure on the asperity contacts, and the gap between them.

figure, panels = plt.subplots(1, 2, figsize=(9, 3.8), layout="constrained")
extent = [1e6 * value for value in (point.x[0], point.x[-1], point.y[0], point.y[-1])]
fields = (("contact pressure (GPa)", 1e-9 * point.pressure, "magma"), ("gap (nm)", 1e9 * point.gap, "viridis"))
for axes, (title, field, colours) in zip(panels, fields):
    image = axes.imshow(field.T, origin="lower", extent=extent, cmap=colours)
    axes.set(title=title, xlabel="x (µm)", ylabel="y (µm)")
    figure.colorbar(image, ax=axes)
