"""
A gear flank along its path of contact
======================================

A pair of the FZG rig, type C: 16 and 24 teeth, module 4.5 mm, pressure angle 22.4 degrees in operation, 14 mm wide, at
2.1 m/s in the pitch circle, with a mineral oil of ISO VG 100 at 60 °C. Along the path of contact the radius and both
speeds change. Near the pitch point sliding is slow, so the shear of the film vanishes, and asperity friction remains.

The flanks are ground, Ra 0.2 µm each. The published f_b for these flanks is 0.065 to 0.07 (Arana et al. 2019), and 0.12
for roller contacts. Where two pairs of teeth are in contact, each carries half the load, which assumes rigid teeth.
"""

import matplotlib.pyplot as plt
import numpy as np

import lubfric

TEETH, CENTRES, ANGLE, WIDTH = (16, 24), 91.5e-3, np.radians(22.44), 14e-3  # m
TIPS, SPEED, FORCE = (41.23e-3, 59.18e-3), 2.1, 3.5e3  # radii m; m/s; N along the path

pitch = np.array(TEETH) / sum(TEETH) * CENTRES
foot = pitch * np.cos(ANGLE)  # base circles
reach = np.sqrt(np.array(TIPS) ** 2 - foot**2) - pitch * np.sin(ANGLE)  # from the pitch point to either end
place = np.linspace(-reach[1], reach[0], 9) + 1e-5
radius = pitch[:, None] * np.sin(ANGLE) + np.outer([1, -1], place)
u = SPEED / pitch[:, None] * radius
base_pitch = 2 * np.pi * foot[0] / TEETH[0]
single = (place > reach[0] - base_pitch) & (place < base_pitch - reach[1])

base = lubfric.load_scene("paper").with_(
    bodies={"width": WIDTH, "material": "steel", "hardness": None},
    lubricant={
        **{"grade": "ISO VG 100", "viscosity_index": 95},
        "density": 880,
        "temperature_celsius": 60,
        "eyring_stress": 5e6,
        "limiting_stress_coefficient": 0.05,
    },
    surface={"sq": 0.35e-6, "correlation_length": 30e-6, "acf": "gaussian"},
    contact={"shape": (96, 32), "spacing": 8e-6},
    numerics={"model": "quick", "sampling": "patch", "tolerance": 0.03},
)


def along(f_b: float) -> list[float]:
    coefficients = []
    for r, (u1, u2), alone in zip(radius.T, u.T, single):
        bodies = {"radii": list(r), "load": FORCE * (1 if alone else 0.5), "boundary_friction_coefficient": f_b}
        motion = {"slide_roll_ratio": 2 * (u2 - u1) / (u1 + u2)}
        coefficients.append(lubfric.friction(base.with_(bodies=bodies, motion=motion), (u1 + u2) / 2).coefficient)
    return coefficients


figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.8), layout="constrained")
left.plot(1e3 * place, u.T, label=["wheel 1", "wheel 2"])
right.plot(1e3 * place, along(0.0675), "o-", label="f_b = 0.065 to 0.07")
right.plot(1e3 * place, along(0.12), "--", label="f_b = 0.12")
for axes, what in ((left, "speed of the flank (m/s)"), (right, "friction coefficient on wheel 2 (-)")):
    axes.set(xlabel="distance from the pitch point (mm)", ylabel=what)
    axes.legend(frameon=False)
