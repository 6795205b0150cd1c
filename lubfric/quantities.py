"""Units and long names of inputs and results: keys of a scene, numbers of a result."""

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
    "steepness": ("-", "d ln(film_load/contact_load) over d ln(speed)"),
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
    "lubricant.temperature_coefficient": ("1/K", "fall of ln(viscosity) with the temperature"),
    "lubricant.conductivity": ("W/(m K)", "thermal conductivity of the film"),
    "motion.entrainment_speed": ("m/s", "entrainment speed"),
    "motion.speeds": ("m/s", "entrainment speeds"),
    "motion.slide_roll_ratio": ("-", "slide-roll ratio"),
    "motion.slip_percent": ("%", "slide-roll ratio in percent"),
    "bodies.conductivity": ("W/(m K)", "thermal conductivity of both bodies"),
    "bodies.volumetric_heat": ("J/(m3 K)", "heat capacity of both bodies"),
    "bodies.hertz_pressure": ("Pa", "peak Hertz pressure"),
    "bodies.hardness_hv": ("HV", "Vickers hardness"),
    "lubricant.temperature": ("K", "temperature of the oil"),
    "lubricant.temperature_celsius": ("°C", "temperature of the oil"),
    "lubricant.viscosity_index": ("-", "viscosity index"),
    "lubricant.nu40": ("m2/s", "kinematic viscosity at 40 °C"),
    "lubricant.nu100": ("m2/s", "kinematic viscosity at 100 °C"),
    "lubricant.density": ("kg/m3", "density of the oil at 15 °C"),
    "lubricant.density_slope": ("kg/(m3 K)", "fall of the density with the temperature"),
    "surface.sq": ("m", "root mean square roughness"),
    "surface.correlation_length": ("m", "correlation length"),
    "surface.spacing": ("m", "cell size of the map"),
    "surface.s_filter": ("m", "nesting index below which the map is smoothed"),
    "surface.l_filter": ("m", "nesting index above which the map is levelled"),
    "contact.spacing": ("m", "cell size"),
    "transient.duration": ("s", "duration"),
    "transient.initial_film": ("m", "film to start from"),
}
KEYS |= {
    key.replace("surface.", "counterface."): (unit, f"{text}, of the other body")
    for key, (unit, text) in KEYS.items()
    if key.startswith("surface.")
}
OF_ERRORS = {"line_length": ("m", "length of the line of rough surface")}


def described(name: str, table: dict) -> dict[str, str]:
    """Attributes of a column, in the words of the CF conventions."""
    unit, text = table.get(name, ("", name.rpartition(".")[2].replace("_", " ")))
    return {"units": "1" if unit == "-" else unit, "long_name": text} if unit else {"long_name": text}


def heading(name: str) -> str:
    """The heading of a column: its name, and its unit in brackets."""
    return f"{name} [{(KEYS | QUANTITIES | OF_ERRORS).get(name, ('-',))[0]}]"


def key_unit(section: str, key: str) -> str:
    """The unit of a key of a scene, for people; "" where it has none."""
    unit = KEYS.get(f"{section}.{key}", ("",))[0]
    return "" if unit == "-" else unit
