"""
The dry rough contact alone
===========================

The contact solver can be used without a film: two rough half-spaces are pressed together, with the hardness as the
limit of the pressure. The real contact area is almost proportional to the pressure.
"""

import matplotlib.pyplot as plt
import numpy as np

import lubfric

surface = lubfric.generate_surface((256, 256), 0.5e-6, sq=200e-9, correlation_length=8e-6, acf="gaussian", seed=3)
gap = surface.heights.max() - surface.heights
pressures = np.array([10e6, 30e6, 100e6, 300e6])
solved = [lubfric.solve_contact(gap, surface.spacing, 230e9, mean_pressure=p, hardness=6e9) for p in pressures]
for p, contact in zip(pressures, solved):
    print(f"{p / 1e6:5.0f} MPa: {100 * contact.contact_area_fraction:.2f} % in contact, {contact.report.message}")

figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.8), layout="constrained")
image = left.imshow(solved[-1].pressure.T / 1e9, origin="lower", cmap="magma", extent=(0, 128, 0, 128))
figure.colorbar(image, ax=left, label="pressure (GPa)")
left.set(title="contact pressure at 300 MPa", xlabel="x (µm)", ylabel="y (µm)")
right.loglog(pressures / 1e6, [100 * c.contact_area_fraction for c in solved], "o-", color="#1f5a94")
right.set(xlabel="mean pressure (MPa)", ylabel="real contact area (%)")
