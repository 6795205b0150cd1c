"""The bodies and the oil of the small scene files that several tests write."""

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
