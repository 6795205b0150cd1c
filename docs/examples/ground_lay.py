"""Friction of a measured ground surface that slides along and across its lay, at several places of the map.

python docs/examples/ground_lay.py path/to/ground-77nm.x3p [figure.png]
"""

import sys
from pathlib import Path

import numpy as np

import lubfric

HERE = Path(__file__).parent
SPEEDS = np.geomspace(1e-4, 1.0, 17)


def solve(surface_file, places=5):
    """Return the coefficient (places, speeds) by direction; a place is a position of the line of contact on the map."""
    curves = {}
    for direction in ("along", "across"):
        scene = lubfric.load_scene(HERE / f"ground_{direction}.toml", surface_file=surface_file)
        scene = scene.with_(numerics={"sampling": "patch", "model": "quick"})
        full = lubfric.read_surface(surface_file)
        full = (full.transposed() if direction == "along" else full).resampled(spacing=scene.contact.spacing)
        nx, ny = lubfric.prepare(scene).surface.shape[0], full.shape[1]
        rows = []
        for first in np.linspace(0, full.shape[0] - nx, places).astype(int):
            piece = full.cropped((nx, ny), (first, 0)).periodic(axes=(False, True))
            rows.append(lubfric.stribeck(lubfric.prepare(scene, piece), SPEEDS).coefficient)
        curves[direction] = np.array(rows)
    return curves


def visualize(curves, path):
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(7, 4.2), layout="constrained")
    FigureCanvasAgg(figure)
    axes = figure.subplots()
    for (direction, rows), colour in zip(curves.items(), ("#1f5a94", "#b3392f")):
        axes.fill_between(SPEEDS, rows.min(axis=0), rows.max(axis=0), color=colour, alpha=0.2, lw=0)
        axes.semilogx(
            SPEEDS, rows.mean(axis=0), "o-", ms=4, color=colour, label=f"{direction} the lay: mean and range of places"
        )
    axes.set(xlabel="entrainment speed U (m/s)", ylabel="friction coefficient (-)", ylim=(0, None))
    axes.legend(frameon=False)
    figure.savefig(path, dpi=130)


def main(arguments=()):
    if not arguments:
        print(__doc__)
        return
    curves = solve(arguments[0])
    for direction, rows in curves.items():
        for speed, f in zip(SPEEDS, rows.T):
            print(f"{direction:7s} U = {speed:8.5f} m/s   f = {f.mean():.4f}   ({f.min():.4f} to {f.max():.4f})")
    if len(arguments) > 1:
        visualize(curves, arguments[1])


if __name__ == "__main__":
    main(sys.argv[1:])
