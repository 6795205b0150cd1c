"""Friction from a measured height map: read and check the map, then compute a Stribeck curve on it."""

import numpy as np

import lubfric


def solve():
    rng = np.random.default_rng(5)  # replaces the file of an instrument
    ridges = np.sin(np.arange(180) * 0.9)[:, None] + 0.3 * rng.standard_normal((180, 160))
    np.save("map.npy", 60e-9 * ridges)

    surface = lubfric.read_surface("map.npy", spacing=0.5e-6)
    scene = lubfric.load_scene("paper").with_(
        surface={"file": "map.npy", "spacing": 0.5e-6, "sq": None, "correlation_length": None},
        contact={"shape": None, "spacing": None},  # keep the map's own grid
    )
    return surface, lubfric.stribeck(scene, np.geomspace(1e-3, 1.0, 7))


def main():
    surface, curve = solve()
    print(surface.describe())
    for speed, f, contact in zip(curve.speed, curve.coefficient, curve.contact_load):
        print(f"U = {speed:8.4f} m/s   f = {f:.4f}   F_C = {contact:.3f} N")


if __name__ == "__main__":
    main()
