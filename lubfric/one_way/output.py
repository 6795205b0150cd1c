"""Fields of one-way points as arrays and as a picture."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from .._base import new_figure

FIELDS = ("x", "gap", "contact_pressure", "film_pressure", "closed", "ruptured")


def one_way_arrays(points) -> dict[str, np.ndarray]:
    """Arrays named ``<field>_<index>`` of each of the ``points`` (`lubfric.FrictionResult`), y, and the ``speed``; SI
    units."""
    arrays = {"speed": np.array([point.speed for point in points])}
    for i, point in enumerate(points):
        arrays |= {f"{name}_{i}": getattr(point.one_way[-1], name) for name in FIELDS} | {f"y_{i}": point.y}
    return arrays


def plot_one_way(path: Path, point) -> None:
    """Pressure of the contact, that of the film, and the gap of a point, from above, as PNG."""
    one = point.one_way[-1]
    x, y = point.x * 1e6, point.y * 1e6
    extent = (x[0], x[-1], y[0], y[-1])
    figure = new_figure(figsize=(11, 4.2))
    shown = (
        ("contact pressure (GPa)", one.contact_pressure / 1e9, "magma_r"),
        ("film pressure (GPa)", one.film_pressure / 1e9, "magma_r"),
        ("gap (nm)", one.gap * 1e9, "viridis"),
    )
    for axes, (name, field, colours) in zip(figure.subplots(1, 3, sharey=True), shown):
        image = axes.imshow(field.T, origin="lower", aspect="auto", extent=extent, cmap=colours)
        figure.colorbar(image, ax=axes, label=name, location="top")
        axes.set_xlabel("x (µm), direction of motion")
    figure.axes[0].set_ylabel("y (µm)")
    figure.savefig(path, dpi=150)
