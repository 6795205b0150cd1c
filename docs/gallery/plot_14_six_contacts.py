"""
Six contacts: which effects change f most
=========================================

A cam, a gear flank, a roller, a piston ring, a seal and a covered roller, each as a small scene. A scene does not contain
all effects: less oil may arrive, the oil may be warmer than stated, shear may thin the oil, the surface may run in, and
an additive may change f_b. Here each effect is added, one at a time, with the load-sharing model on one patch. The
longest bar shows which input to measure first.
"""

import math

import matplotlib.pyplot as plt

import lubfric

# %%
# They differ in size, pressure, oil and motion.

SHARED = {"model": "paper", "sampling": "patch", "tolerance": 0.05, "accept": True, "heat": "off"}
PLANE = math.inf


def contact(name, bodies, lubricant, motion, surface):
    """A scene on a patch longer than its Hertz strip and twelve correlation lengths wide."""
    tables = {"bodies": bodies, "lubricant": lubricant, "motion": motion, "surface": surface | {"acf": "gaussian"}}
    cells = {"shape": [8, 8], "spacing": surface["correlation_length"] / 3}
    scene = lubfric.load_scene(tables | {"contact": cells, "numerics": SHARED, "name": name})
    step = min(cells["spacing"], scene.bodies.half_width / 6)
    length = max(2.5 * scene.bodies.half_width, 8 * surface["correlation_length"])
    return scene.with_(contact={"shape": [math.ceil(length / step), 36], "spacing": [step, cells["spacing"]]})


OIL = {"viscosity_index": 95, "eyring_stress": 5e6, "limiting_stress_coefficient": 0.06}
STEEL = {"material": "steel", "boundary_friction_coefficient": 0.12, "hardness": "7 GPa"}
contacts = [
    contact(
        "cam",
        STEEL | {"radius": "10 mm", "width": "14 mm", "load": "700 N"},
        OIL | {"grade": "ISO VG 68", "temperature": "100 °C"},
        {"entrainment_speed": 2.0, "slide_roll_ratio": 2.0},
        {"ra": "0.2 um", "correlation_length": 1.5e-5},
    ),
    contact(
        "gear flank",
        STEEL | {"radii": ["15 mm", "25 mm"], "width": "20 mm", "load": "10 kN"},
        OIL | {"grade": "ISO VG 220", "temperature": "80 °C"},
        {"entrainment_speed": 3.0, "slip_percent": 30},
        {"ra": "0.4 um", "correlation_length": 2e-5},
    ),
    contact(
        "roller",
        STEEL | {"radii": ["6 mm", "30 mm"], "width": "14 mm", "load": "2 kN"},
        OIL | {"grade": "ISO VG 68", "temperature": "70 °C"},
        {"entrainment_speed": 1.0, "slip_percent": 3},
        {"ra": "0.1 um", "correlation_length": 1e-5},
    ),
    contact(
        "piston ring",
        {"radius": "25 mm", "width": "250 mm", "load": "150 N", "material": ["steel", "cast iron"]}
        | {"boundary_friction_coefficient": 0.12, "hardness": "2.5 GPa"},
        OIL | {"grade": "ISO VG 46", "temperature": "120 °C"},
        {"entrainment_speed": 0.25, "slide_roll_ratio": 2.0},
        {"ra": "0.25 um", "correlation_length": 1.5e-5},
    ),
    contact(
        "seal",
        {"radius": "1 mm", "width": "150 mm", "load": "15 N", "young_modulus": ["8 MPa", PLANE]}
        | {"poisson_ratio": [0.49, 0.3], "boundary_friction_coefficient": 0.3},
        OIL | {"grade": "ISO VG 46", "temperature": "60 °C"},
        {"entrainment_speed": 0.1, "slide_roll_ratio": 2.0},
        {"ra": "0.8 um", "correlation_length": 3e-5},
    ),
    contact(
        "covered roller",
        {"radius": "100 mm", "width": "1 m", "load": "10 kN", "young_modulus": ["10 MPa", PLANE]}
        | {"poisson_ratio": [0.49, 0.3], "boundary_friction_coefficient": 0.4},
        {"viscosity": 1e-3, "pressure_viscosity_coefficient": 0.0, "viscosity_law": "constant"},
        {"entrainment_speed": 0.2, "slip_percent": 1},
        {"ra": "3 um", "correlation_length": 3e-4},
    ),
]

# %%
# How each effect is added. The starved inlet receives 70 % of the oil that flows through the flooded contact. The
# Carreau law, here with 30 kPa and 0.8, is for an oil with polymers, such as a multigrade oil.


def variations(scene, film):
    """Return the scenes with one effect each."""
    oil, bodies = scene.lubricant, scene.bodies
    other = {
        "starved: film x 0.7": {"lubricant": {"inlet_film": 0.7 * film}},
        "run in: Sq x 0.6": {"surface": {"sq": 0.6 * scene.surface.sq}},
        "other additive: f_b x 0.75": {
            "bodies": {"boundary_friction_coefficient": 0.75 * bodies.boundary_friction_coefficient}
        },
        "hot: viscosity x 0.7": {"lubricant": {"oil": None, "viscosity": 0.7 * oil.viscosity}},
        "thinned by shear: Carreau": {"lubricant": {"eyring_stress": None, "carreau": [3e4, 0.8]}},
    }
    return {effect: scene.with_(**changed) for effect, changed in other.items()}


figure, axes = plt.subplots(2, 3, figsize=(12, 6.2), layout="constrained")
for scene, ax in zip(contacts, axes.flat, strict=True):
    point = lubfric.friction(scene)
    changes = {
        effect: 100 * (lubfric.friction(other).coefficient / point.coefficient - 1)
        for effect, other in variations(scene, point.balance.film.flow_film).items()
    }
    ordered = sorted(changes.items(), key=lambda change: abs(change[1]))
    ax.barh(
        [w for w, _ in ordered], [c for _, c in ordered], color=["#b3392f" if c > 0 else "#1f5a94" for _, c in ordered]
    )
    ax.axvline(0, color="black", lw=0.8)
    ratio = 100 * point.contact_load / scene.bodies.load
    ax.set_title(f"{scene.name}: f = {point.coefficient:.3f},\nasperities carry {ratio:.0f} % of the load", fontsize=10)
    ax.set_xlabel("change of f (%)")
    ax.tick_params(axis="y", labelsize=8)
    print(
        f"{scene.name}: {point.coefficient:.4f}",
        *(f"{e.what}: f {100 * e.change:+.0f} %" for e in point.unmodelled_effects if e.change == e.change),
        sep="\n    ",
    )

# %%
# Where asperities carry most of the load, f_b and the surface have the largest effect; where the film carries it, the
# oil. Results and ``lubfric info`` estimate each effect with closed forms, as printed above.
