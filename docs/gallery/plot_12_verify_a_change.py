"""
Check a change against a closed form
====================================

A change of the contact solver is verified if the error decreases at the expected rate. Here the pressure under a smooth
cylinder is compared with Hertz's formula on finer and finer grids. The peak converges with second order. The root mean
square converges with first order, because Hertz's pressure falls like a square root at its edge.
"""

import matplotlib.pyplot as plt
import numpy as np

import lubfric
from lubfric.film import hertz

RADIUS, E_PRIME, LOAD = 0.01, 230e9, 1e5  # m, Pa, N/m
half_width = hertz.line_half_width(LOAD, RADIUS, E_PRIME)
peak = hertz.line_peak_pressure(LOAD, RADIUS, E_PRIME)

cells = np.array([32, 64, 128, 256])  # across the width of the contact
errors = []
for n in cells:
    step = 2 * half_width / n
    x = (np.arange(2 * n) - n + 0.5) * step
    gap = np.repeat((x**2 / (2 * RADIUS))[:, None], 4, axis=1)
    solved = lubfric.solve_contact(
        gap, step, E_PRIME, mean_pressure=LOAD / (2 * n * step), boundary=("free", "periodic"), tolerance=1e-8
    )
    exact = peak * np.sqrt(np.maximum(1 - (x / half_width) ** 2, 0))
    rms = np.sqrt(np.mean((solved.pressure[:, 0] - exact) ** 2) / np.mean(exact**2))
    errors.append((abs(solved.pressure.max() / peak - 1), rms))
errors = np.array(errors)

order = np.log2(errors[:-1] / errors[1:])
print("observed order, peak and mean square:", order.round(2).tolist())

figure, axes = plt.subplots(figsize=(6.4, 4), layout="constrained")
axes.loglog(cells, errors[:, 0], "o-", color="#1f5a94", label="peak pressure")
axes.loglog(cells, errors[:, 1], "s-", color="#b3392f", label="pressure, root mean square")
for column, power in ((0, 2), (1, 1)):
    axes.loglog(cells, 0.7 * errors[0, column] * (cells[0] / cells) ** power, ":", color="grey")
axes.plot([], [], ":", color="grey", label="second and first order")
axes.set(xlabel="cells across the contact", ylabel="relative error (-)", xticks=cells, xticklabels=cells)
axes.minorticks_off()
axes.legend(frameon=False)
