"""
Torque of a tapered roller bearing
==================================

Bearing 32216 under an axial load of 6 kN, in a bath of FVA 3 at 50 °C. The measured points were read off a figure
(P. Wingertszahn et al., Lubricants 11 (2023) 369, doi:10.3390/lubricants11090369, Fig. 5) with an error of about 5 %.
Geometry, oil and roughness are from the same publication; the angle is from the catalogue.

In pure rolling each contact takes the power 2 u F, with its rolling force F on each surface. With flooded inlets
the sum over 16 rollers and two races is two to three times the measured torque, and so is that of the published law
(Biboulet and Houpert 2010). So the inlets are not flooded, or they are hotter than the outer ring. The length of the
inlets is not known. With inlets that begin 0.2 to 0.3 mm before the contact, where the gap is some micrometres, the
range of results contains the measurement. The flange, the cage and churning are not modelled; they increase the torque.
"""

import matplotlib.pyplot as plt
import numpy as np

import lubfric

ROLLERS, DIAMETER, PITCH, LENGTH = 16, 17e-3, 108.5e-3, 20.7e-3  # m; the length without its rounded edges
ANGLE, AXIAL = np.radians(15.6), 6e3  # N
RPM, MEASURED = np.array([500, 2000, 4000]), np.array([1.30, 2.95, 3.75])  # N m

inner, outer = (PITCH + sign * DIAMETER * np.cos(ANGLE) for sign in (-1, 1))  # mean diameters of the races
turn = 2 * np.pi / 60 * RPM
speeds = turn * inner / (inner + outer) * outer / 2  # entrainment, in both contacts
base = lubfric.load_scene("paper").with_(
    bodies={"width": LENGTH, "load": AXIAL / (ROLLERS * np.sin(ANGLE)), "material": "steel", "hardness": None},
    lubricant={
        "viscosity": 0.0525,
        "pressure_viscosity_coefficient": 20e-9,
        "density_law": "dowson-higginson",
        "eyring_stress": 5e6,
        "limiting_stress_coefficient": 0.047,
    },
    motion={"slide_roll_ratio": 1e-3},
    surface={"sq": 160e-9, "correlation_length": 20e-6, "acf": "gaussian"},
    contact={"shape": (64, 32), "spacing": 8e-6},
    numerics={"model": "quick", "sampling": "patch", "tolerance": 0.03},
)


def torque(oil: dict) -> np.ndarray:
    total = np.zeros(RPM.size)
    for race in (inner, -outer):
        radii = [DIAMETER / 2, race / 2 / np.cos(ANGLE)]
        curve = lubfric.stribeck(base.with_(bodies={"radii": radii}, lubricant=oil), speeds)
        total += ROLLERS * 2 * speeds / turn * curve["rolling_force"]
    return total


flooded, short, long = (torque(oil) for oil in ({}, {"inlet_length": 0.2e-3}, {"inlet_length": 0.3e-3}))
figure, axes = plt.subplots(figsize=(6, 4), layout="constrained")
axes.plot(RPM, flooded, "o-", label="rolling, flooded inlets")
axes.fill_between(RPM, short, long, alpha=0.3, label="rolling, inlets of 0.2 to 0.3 mm")
axes.errorbar(RPM, MEASURED, 0.05 * MEASURED, fmt="ks", capsize=3, label="measured, with flange")
axes.set(xlabel="speed (1/min)", ylabel="torque (N m)", ylim=(0, None))
axes.legend(frameon=False)
