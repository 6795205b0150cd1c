"""Fields of deterministic points as a file and as a picture."""

from __future__ import annotations

import io
from pathlib import Path

import numpy as np

from ..deterministic import DeterministicResult

FIELDS = ("x", "pressure", "gap", "fill", "shear", "dent", "touching", "spots", "wet")


def deterministic_bytes(results: list[DeterministicResult]) -> bytes:
    """An ``.npz`` file of arrays named ``<field>_<index>``, the ``speed`` and ``spacing`` [m] of each; SI units."""
    arrays = {"speed": np.array([r.speed for r in results]), "spacing": np.array([r.spacing for r in results])}
    for i, result in enumerate(results):
        arrays |= {f"{name}_{i}": getattr(result, name) for name in FIELDS}
    buffer = io.BytesIO()
    np.savez_compressed(buffer, **arrays)  # type: ignore[arg-type]  # NumPy types allow_pickle, not the arrays
    return buffer.getvalue()


def plot_deterministic(path: Path, result: DeterministicResult, half_width: float) -> None:
    """Pressure, gap and shear around the Hertz strip of ``half_width`` [m], from above, as PNG."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.colors import LogNorm
    from matplotlib.figure import Figure

    near = np.flatnonzero(np.abs(result.x) <= 4 * half_width)
    part = slice(near[0], near[-1] + 1)
    width = result.pressure.shape[1] * result.spacing[1]
    extent = (result.x[near[0]] * 1e6, result.x[near[-1]] * 1e6, 0, width * 1e6)
    figure = Figure(figsize=(11, 4.2), layout="constrained")
    FigureCanvasAgg(figure)
    shown = (
        ("pressure (GPa)", result.pressure / 1e9, "magma_r", None),
        ("gap (nm)", result.gap * 1e9, "viridis", LogNorm()),
        ("shear (MPa)", result.shear / 1e6, "cividis", None),
    )
    for axes, (name, field, colours, norm) in zip(figure.subplots(1, 3, sharey=True), shown):
        image = axes.imshow(field[part].T, origin="lower", aspect="auto", extent=extent, cmap=colours, norm=norm)
        figure.colorbar(image, ax=axes, label=name, location="top")
        for edge in (-half_width, half_width):
            axes.axvline(edge * 1e6, color="0.5", lw=0.8, ls="--")
        axes.set_xlabel("x (µm), direction of motion")
    figure.axes[0].set_ylabel("y (µm)")
    figure.savefig(path, dpi=150)
