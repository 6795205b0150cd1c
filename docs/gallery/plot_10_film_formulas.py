"""
Film formulas compared with the numerical film
==============================================

Formulas for the film thickness have an error of a few per cent. Here Moes' formula for the film at the maximum of the
pressure is compared with the numerical film, from light to heavy loads.
"""

from dataclasses import replace

import matplotlib.pyplot as plt
import numpy as np

import lubfric

CONTACT = dict(
    radius=0.01,  # m
    e_prime=230e9,  # Pa
    entrainment_speed=1.0,  # m/s
    viscosity=0.04,  # Pa s
    pressure_viscosity_coefficient=22e-9,  # 1/Pa
)
loads = np.geomspace(1e3, 3e5, 9)  # N/m

films = [lubfric.solve_ehl(load_per_width=w, **CONTACT) for w in loads]
numerical = np.array([film.flow_film for film in films])
formula = np.array([film.line.moes_film for film in films])
fine = np.geomspace(loads[0], loads[-1], 100)
drawn = np.array([replace(films[0].line, load_per_width=w).moes_film for w in fine])
error = 100 * (formula / numerical - 1)
print(f"the formula deviates by {error.min():+.1f} to {error.max():+.1f} %")

figure, (upper, lower) = plt.subplots(2, sharex=True, figsize=(6.4, 5.2), layout="constrained")
upper.loglog(loads, 1e6 * numerical, "o", color="#1f5a94", label="numerical")
upper.loglog(fine, 1e6 * drawn, color="#555555", label="Moes' formula")
upper.set(ylabel="film (µm)", yticks=[0.3, 0.5, 1, 2], yticklabels=["0.3", "0.5", "1", "2"])
upper.minorticks_off()
upper.legend(frameon=False)
lower.semilogx(loads, error, "o-", color="#b3392f")
lower.axhline(0, color="0.7", lw=1)
lower.set(xlabel="load per width (N/m)", ylabel="deviation of the formula (%)")
