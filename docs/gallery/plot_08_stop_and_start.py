"""
A contact that stops and starts
===============================

The speed falls to zero and rises again within 20 ms. While the bodies are at rest nothing slides, and the coefficient
is zero. Friction during slowing down and during starting differs, because the stop squeezes the film out of the
contact. Over the speed, the two branches form a loop.
"""

import matplotlib.pyplot as plt

import lubfric

scene = lubfric.load_scene(
    {
        "name": "stop and start",
        "bodies": {
            "radius": 2e-3,
            "width": 6e-3,
            "load": 5.5,
            "e_prime": 231e9,
            "boundary_friction_coefficient": 0.09,
        },
        "lubricant": {"viscosity": 0.36, "pressure_viscosity_coefficient": 25e-9},
        "motion": {
            "slide_roll_ratio": 2.0,
            "entrainment_speed": {
                "kind": "table",
                "times": [0.0, 0.005, 0.010, 0.015, 0.020],
                "values": [0.1, 0.0, 0.0, 0.1, 0.1],
            },
        },
        "surface": {"sq": 100e-9, "correlation_length": 8e-6, "acf": "gaussian", "seed": 1},
        "contact": {"shape": [100, 100], "spacing": 0.9e-6},
        "transient": {"duration": 0.020, "outputs": 60},
    }
)
history = lubfric.transient(scene)

figure, panels = plt.subplot_mosaic([["speed", "loop"], ["friction", "loop"]], figsize=(9, 4.6), layout="constrained")
upper, lower, loop = panels["speed"], panels["friction"], panels["loop"]
upper.plot(1e3 * history.time, history.entrainment_speed, color="#555555")
upper.set(ylabel="entrainment speed (m/s)")
lower.plot(1e3 * history.time, history.coefficient, color="#1f5a94")
lower.set(xlabel="time (ms)", ylabel="friction coefficient (-)", ylim=(0, None))
moving = history.entrainment_speed > 1e-4
for branch, label, colour in (
    (history.time < 0.0075, "slowing down", "#1f5a94"),
    (history.time > 0.0075, "starting", "#b3392f"),
):
    part = moving & branch
    loop.plot(history.entrainment_speed[part], history.coefficient[part], ".-", color=colour, label=label)
loop.set(xlabel="entrainment speed (m/s)", ylabel="friction coefficient (-)", ylim=(0, None))
loop.legend(frameon=False)
