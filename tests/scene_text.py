"""Parts of the small scene files that several tests write: the bodies and the oil, and a small rough patch."""

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
"""
