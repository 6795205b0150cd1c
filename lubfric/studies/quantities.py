"""Names, units and long names of the columns of a study."""

from __future__ import annotations

QUANTITIES = {  # name: (unit, long name)
    "coefficient": ("-", "friction coefficient"),
    "contact_load": ("N", "load carried by the rough contact"),
    "film_load": ("N", "load carried by the film"),
    "shear_force": ("N", "shear force of the film"),
    "couette_force": ("N", "sliding part of the shear force"),
    "rolling_force": ("N", "rolling part of the shear force"),
    "boundary_force": ("N", "friction force of the contact spots"),
    "real_contact_area_fraction": ("-", "real contact area over nominal area"),
    "real_contact_area": ("m2", "real contact area"),
    "plastic_area_fraction": ("-", "plastic area over nominal area"),
    "min_film": ("m", "smallest film thickness"),
    "central_film": ("m", "central film thickness"),
    "mean_gap": ("m", "mean gap of the rough surfaces"),
    "film_to_roughness_ratio": ("-", "central film over Sq"),
    "inlet_film_factor": ("-", "film thinner by the heat of its inlet"),
    "flash_temperature_rise": ("K", "largest temperature rise of the surfaces"),
    "film_temperature_rise": ("K", "largest mean temperature rise of the film over the surfaces"),
    "clearance": ("-", "gap between the film and the highest summits over Sq, where they do not touch"),
    "load_residual": ("-", "relative residual of the load balance"),
    "volume_residual": ("-", "relative residual of the volume balance"),
    "seconds": ("s", "processing time"),
}
KEYS = {  # units of the keys of a scene that are numbers
    "speed": ("m/s", "entrainment speed"),
    "bodies.radius": ("m", "reduced radius"),
    "bodies.width": ("m", "length of the line contact"),
    "bodies.load": ("N", "total load"),
    "bodies.e_prime": ("Pa", "composite modulus E'"),
    "bodies.hardness": ("Pa", "plastic limit of the contact pressure"),
    "bodies.boundary_friction_coefficient": ("-", "boundary friction coefficient"),
    "lubricant.viscosity": ("Pa s", "viscosity at ambient pressure"),
    "lubricant.pressure_viscosity_coefficient": ("1/Pa", "pressure-viscosity coefficient"),
    "lubricant.eyring_stress": ("Pa", "Eyring stress"),
    "lubricant.limiting_stress_coefficient": ("-", "limiting shear stress per pressure"),
    "lubricant.limiting_stress_offset": ("Pa", "limiting shear stress at ambient pressure"),
    "motion.slide_roll_ratio": ("-", "slide-roll ratio"),
    "motion.slip_percent": ("%", "slide-roll ratio in percent"),
    "bodies.hertz_pressure": ("Pa", "peak Hertz pressure"),
    "bodies.hardness_hv": ("HV", "Vickers hardness"),
    "lubricant.temperature": ("K", "temperature of the oil"),
    "lubricant.temperature_celsius": ("°C", "temperature of the oil"),
    "lubricant.viscosity_index": ("-", "viscosity index"),
    "lubricant.nu40": ("m2/s", "kinematic viscosity at 40 °C"),
    "lubricant.nu100": ("m2/s", "kinematic viscosity at 100 °C"),
    "lubricant.density": ("kg/m3", "density of the oil at 15 °C"),
    "surface.sq": ("m", "root mean square roughness"),
    "surface.correlation_length": ("m", "correlation length"),
    "contact.spacing": ("m", "cell size"),
}


def described(name: str, table: dict) -> dict[str, str]:
    """Attributes of a column, in the words of the CF conventions."""
    unit, text = table.get(name, ("", name.rpartition(".")[2].replace("_", " ")))
    return {"units": "1" if unit == "-" else unit, "long_name": text} if unit else {"long_name": text}
