"""The scene that ``lubfric init`` writes: complete, commented, ready to run."""

from __future__ import annotations

from pathlib import Path

from .._base import write_whole
from ..errors import InputError

TEMPLATE = """\
# A scene of lubfric: a rough, lubricated line contact. Everything is in SI units unless the key says otherwise.
# lubfric info THIS_FILE says what it means, lubfric run THIS_FILE computes the Stribeck curve. All keys: docs/scene.md
name = "my contact"

[bodies]
radii = [8e-3, inf]                     # m, both bodies; inf: a plane, negative: a hollow. Or: radius = 8e-3 (reduced)
width = 10e-3                           # m, length of the line
load = 500.0                            # N. Or: hertz_pressure = 0.5e9 (Pa, peak)
material = "steel"                      # or ["steel", "bronze"], or young_modulus and poisson_ratio, a pair each
# hardness_hv = 700                     # Vickers; left out: elastic contact
boundary_friction_coefficient = 0.12    # of the contact spots

[lubricant]
grade = "ISO VG 68"                     # or nu40 and nu100 (m²/s), oil = "mineral-100", viscosity (Pa s)
viscosity_index = 95
density = 870                           # kg/m³ at 15 °C; left out: typical of the base oil
# base = "mineral"                      # "pao", "ester", "polyglycol": for what is estimated
temperature_celsius = 70                # or temperature in K
# pressure_viscosity_coefficient = 20e-9 # 1/Pa; left out: estimated, and the result says how well
eyring_stress = 5e6                     # Pa; above some 200 MPa no oil is Newtonian
limiting_stress_coefficient = 0.06      # limiting shear stress over pressure

[motion]
entrainment_speed = 1.0                 # m/s, (u1 + u2)/2. Or: surface_speeds = [0.975, 1.025]
slip_percent = 5                        # 100 (u2 - u1)/U. Or: slide_roll_ratio = 0.05
speed_range = [1e-3, 10.0, 13]          # m/s, m/s, number of speeds of the Stribeck curve

[surface]                               # a generated one; of an instrument: file = "map.x3p", motion_axis = "x" or "y"
sq = 0.1e-6                             # m
correlation_length = 10e-6              # m
acf = "gaussian"

[contact]                               # grid of a generated surface; a measured map keeps its own
shape = [256, 128]
spacing = 1.6e-6                        # m

[numerics]
tolerance = 0.01                        # on the friction coefficient, relative; decides how much is modelled
"""


def write_template(path: Path) -> None:
    """Write the commented scene to ``path``; raises `InputError` if something is there already."""
    if path.exists():
        raise InputError(f"{path} exists; give another name, so that no scene is lost")
    if not path.parent.is_dir():
        raise InputError(f"{path.parent} is no folder; give a file in an existing one")
    write_whole(path, TEMPLATE.encode())
