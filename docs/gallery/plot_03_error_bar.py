"""
Sampling error of a friction coefficient
========================================

A finite piece of a rough surface is a sample. Where film and asperities share the load, few asperities carry their
part, and one small patch can be far off. The library solves as many strips of the surface as the target error needs,
and states the error that remains.
"""

import matplotlib.pyplot as plt
import numpy as np

import lubfric

scene = lubfric.load_scene("paper").with_(numerics={"sampling_tolerance": 0.04})
point = lubfric.friction(scene, 0.03)
print(point.uncertainty.text)

# %%
# Ten patches of the paper's size, 90 µm wide, scatter widely about this value. No single patch shows it.

patches = []
for seed in range(10):
    patch = scene.with_(surface={"seed": seed}, numerics={"sampling": "patch"})
    patches.append(lubfric.friction(patch, 0.03).coefficient)

low, high = point.uncertainty.interval
figure, axes = plt.subplots(figsize=(6.4, 3.6), layout="constrained")
axes.plot(range(10), patches, "o", color="#555555", label="one patch each")
axes.axhspan(low, high, color="#1f5a94", alpha=0.2, label="95 % interval of the strips")
axes.axhline(point.coefficient, color="#1f5a94", label="the strips")
axes.set(xlabel="seed of the patch", ylabel="friction coefficient (-)", ylim=(0, None), xticks=np.arange(10))
axes.legend(frameon=False, loc="lower right")
