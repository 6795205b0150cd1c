"""Units of the keys of a scene, for tables that show them."""

from __future__ import annotations

ROUGHNESS = {"sq": "m", "correlation_length": "m", "spacing": "m", "s_filter": "m", "l_filter": "m"}
UNITS = {
    "bodies": {
        "radius": "m",
        "width": "m",
        "load": "N",
        "e_prime": "Pa",
        "hardness": "Pa",
        "conductivity": "W/(m K)",
        "volumetric_heat": "J/(m³ K)",
    },
    "lubricant": {
        "viscosity": "Pa s",
        "pressure_viscosity_coefficient": "1/Pa",
        "eyring_stress": "Pa",
        "limiting_stress_offset": "Pa",
        "temperature": "K",
        "temperature_coefficient": "1/K",
        "conductivity": "W/(m K)",
    },
    "motion": {"entrainment_speed": "m/s", "speeds": "m/s"},
    "surface": ROUGHNESS,
    "counterface": ROUGHNESS,
    "contact": {"spacing": "m"},
    "transient": {"duration": "s", "initial_film": "m"},
}
