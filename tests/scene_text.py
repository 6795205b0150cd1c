"""Scenes that many tests begin with: parts of small scene files (the bodies and the oil, a small rough patch by
load sharing), and the paper's by load sharing."""

import lubfric

BODIES_AND_OIL = """
[bodies]
radius = 2e-3
width = 6e-3
load = 5.5
e_prime = 231e9
boundary_friction_coefficient = 0.09
[lubricant]
viscosity = 0.36
pressure_viscosity_coefficient = 25e-9
"""
SMALL_PATCH = """[surface]
sq = 1e-7
correlation_length = 4e-6
[contact]
shape = [48, 48]
spacing = 1.1e-6
[numerics]
model = "paper"
sampling = "patch"
tolerance = 0.03
"""


def paper_scene(**sections) -> lubfric.Scene:
    """The scene "paper" by load sharing alone, which takes a fraction of a default answer, with other ``sections``."""
    return lubfric.load_scene("paper").with_(numerics={"model": "paper"}).with_(**sections)
