"""
Sampling error of a friction coefficient
========================================

A finite piece of a rough surface is a sample. In mixed lubrication few asperities carry the asperity load, so the error
from one small patch can be large. ``lubfric`` solves as many strips of the surface as the target error requires, and
states the remaining error.
"""

import matplotlib.pyplot as plt
import numpy as np

import lubfric

scene = lubfric.load_scene("paper").with_(numerics={"sampling_tolerance": 0.04})
point = lubfric.friction(scene, 0.03)
print(point.uncertainty.text)

# %%
# Ten patches of the paper's size, 90 µm wide, scatter widely about this value. A single patch does not show this
# scatter.

patches = []
for seed in range(10):
    patch = scene.with_(surface={"seed": seed}, numerics={"sampling": "patch"})
    patches.append(lubfric.friction(patch, 0.03).coefficient)

low, high = point.uncertainty.interval
figure, axes = plt.subplots(figsize=(6.4, 3.6), layout="constrained")
axes.plot(range(10), patches, "o", color="#555555", label="single patches")
axes.axhspan(low, high, color="#1f5a94", alpha=0.2, label="95 % interval of the strips")
axes.axhline(point.coefficient, color="#1f5a94", label="mean of the strips")
axes.set(xlabel="seed of the patch", ylabel="friction coefficient (-)", ylim=(0, None), xticks=np.arange(10))
axes.legend(frameon=False, loc="lower right")
