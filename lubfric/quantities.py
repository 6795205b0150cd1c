"""Every number of a result and of a scene, once: unit, name, symbol, what its error depends on (CONTRIBUTING.md)."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, field, fields
from inspect import cleandoc
from typing import Any, Generic, NamedTuple, TypeVar

from .errors import InputError
from .units import converted

T = TypeVar("T")  # float, or an array over operating points


class Quantity(NamedTuple):
    """``unit`` ("-" without one), ``label`` (long name), ``symbol``; ``error``: what its error depends on ("" where
    none is estimated); ``column``: its name in tables where that is not its own; ``note``: what a reader should know.
    """

    unit: str
    label: str
    symbol: str = ""
    error: str = ""
    column: str = ""
    note: str = ""


def quantity(unit: str, label: str, symbol: str = "", **more: Any) -> Any:
    """A field of a dataclass that is a `Quantity`. ``more``: ``error``, ``column``, ``note`` of it, ``default``."""
    default = {"default": more.pop("default")} if "default" in more else {}
    return field(metadata={"quantity": Quantity(unit, label, symbol, **more)}, **default)


def quantities(kind: type) -> dict[str, Quantity]:
    """The quantities among the fields of a dataclass, by name."""
    return {f.name: f.metadata["quantity"] for f in fields(kind) if "quantity" in f.metadata}


def described_in_doc(kind: type[T]) -> type[T]:
    """Class decorator: the attributes in the docstring begin with the quantities of ``kind``."""
    head = "Attributes\n----------\n"
    lines = [f"{name} : {q.label} [{q.unit}]{q.note and '; ' + q.note}\n" for name, q in quantities(kind).items()]
    kind.__doc__ = cleandoc(kind.__doc__ or "").replace(head, head + "".join(lines))
    return kind


@dataclass(frozen=True, repr=False)
class Quantities(Generic[T]):
    """The numbers of an operating point whose errors are estimated (T: float), or of many points (T: array)."""

    coefficient: T = quantity(
        *("-", "friction coefficient", "f"),
        error="all",
        note="(f_b F_C + F_sh)/F_T (Akchurin et al. 2015, Eq. 9), of surface 2 against its sliding",
    )
    contact_load: T = quantity("N", "load carried by the rough contact", "F_C", error="split")
    film_load: T = quantity("N", "load carried by the film", "F_H", error="split")
    shear_force: T = quantity("N", "shear force of the film", "F_sh", error="shear", note="of both parts")
    couette_force: T = quantity("N", "sliding part of the shear force", error="shear")
    rolling_force: T = quantity("N", "rolling part of the shear force", error="shear")
    boundary_force: T = quantity(
        "N", "friction force of the contact spots", "f_b F_C", error="split", note="zero in pure rolling"
    )
    real_contact_area_fraction: T = quantity("-", "real contact area over nominal area", "A_c/A", error="area")
    real_contact_area: T = quantity("m2", "real contact area", "A_c", error="area", note="on the whole line")
    plastic_area_fraction: T = quantity("-", "plastic area over nominal area", "A_p/A", error="spots")
    min_film: T = quantity(
        "m", "smallest film thickness", "h_min", error="film", note="of the smooth film; NaN without entrainment"
    )
    central_film: T = quantity(
        "m", "central film thickness", "h_c", error="film", note="of the smooth film; NaN without entrainment"
    )
    mean_gap: T = quantity(
        "m", "mean gap of the rough surfaces", error="film", note="the film thickness when they are separated"
    )
    film_to_roughness_ratio: T = quantity("-", "central film over Sq", "lambda", error="film")
    inlet_film_factor: T = quantity(
        "-", "film thinner by the heat of its inlet", error="heat", note="1 where heat is left out"
    )
    flash_temperature_rise: T = quantity(
        "K", "largest temperature rise of the surfaces", error="heat", note="0 where heat is left out"
    )
    film_temperature_rise: T = quantity(
        "K",
        "largest mean temperature rise of the film over the surfaces",
        error="heat",
        note="mean across the film; 0 where heat is left out",
    )

    def in_unit(self, name: str, unit: str) -> T:
        """The number ``name`` in another unit, ``result.in_unit("min_film", "nm")``; `InputError` for other kinds."""
        if name not in NUMBERS:
            raise InputError(f" = {name!r} is no number of a result", "name", ", ".join(NUMBERS))
        return converted(getattr(self, name), _OF_POINT[name].unit, unit)


@dataclass(frozen=True, repr=False)
class PointQuantities(Quantities[T]):
    """All numbers of an operating point: of a `lubfric.FrictionResult`, and as arrays of a `lubfric.StribeckResult`."""

    speed: T = quantity("m/s", "entrainment speed", "U")
    load_residual: T = quantity("-", "relative residual of the load balance", note="(F_C + F_H - F_T)/F_T")
    volume_residual: T = quantity("-", "relative residual of the volume balance", note="(gap - film)/(gap + film)")
    clearance: T = quantity(
        "-", "gap between the film and the highest summits over Sq", note="NaN where they touch, or without a film"
    )
    steepness: T = quantity(
        "-", "d ln(film_load/contact_load) over d ln(speed)", note="NaN where film and contact do not share the load"
    )
    seconds: T = quantity("s", "processing time")


@dataclass(frozen=True, kw_only=True)
class UncertaintyQuantities(Generic[T]):
    """How sure a friction coefficient is, in numbers: of a point (T: float) or of many (T: array)."""

    numerical: T = quantity(
        "-", "estimated relative error of f by film, grids and solvers", column="numerical_error", default=math.nan
    )
    sampling: T = quantity(
        "-",
        "relative standard error of f because a finite length of rough surface stands for all of it",
        column="sampling_error",
        note="NaN where it is not known",
        default=math.nan,
    )
    line_scatter: T = quantity(
        "-", "relative standard deviation of f between lines as wide as that of the scene", default=math.nan
    )
    participation: T = quantity(
        "-", "number of equally loaded spots that would carry the load as unevenly", default=math.nan
    )
    length: T = quantity("m", "length of the line of rough surface", column="line_length", default=math.nan)
    area_needed: T = quantity(
        "-", "how many times more of a measured map would be needed", note="1: enough", default=1.0
    )
    model: T = quantity("-", "relative error of f by the model, at 95 %", column="model_error", default=math.nan)
    inputs: T = quantity("-", "relative change of f by the ranges of inputs", column="input_error", default=0.0)


_OF_POINT = quantities(PointQuantities)
NUMBERS = ("speed", *(name for name in _OF_POINT if name != "speed"))  # of a result, in the order of its tables
QUANTITIES = {name: _OF_POINT[name] for name in NUMBERS[1:]}
ESTIMATED = tuple(quantities(Quantities))  # those with an error of their own
OF_UNCERTAINTY = quantities(UncertaintyQuantities)
INTERVAL = {
    "interval_low": Quantity("-", "lower end of the 95 % interval of f"),
    "interval_high": Quantity("-", "upper end of the 95 % interval of f"),
}
OF_MOMENT = {  # of a run in time, in the order of its table
    "time": Quantity("s", "time"),
    "entrainment_speed": _OF_POINT["speed"],
    "sliding_speed": Quantity("m/s", "sliding speed u2 - u1"),
    "load": Quantity("N", "total load", "F_T"),
    "contact_load": QUANTITIES["contact_load"],
    "film_load": QUANTITIES["film_load"],
    "friction_force": Quantity("N", "tangential force on the upper surface"),
    "boundary_force": QUANTITIES["boundary_force"],
    "couette_force": QUANTITIES["couette_force"],
    "rolling_force": QUANTITIES["rolling_force"],
    "coefficient": QUANTITIES["coefficient"],
    "sampling_error": OF_UNCERTAINTY["sampling"],
    "shear_error": Quantity("-", "estimated relative error of f by the sum of the film's shear stress"),
    "time_error": Quantity("-", "local error of the last step over its tolerance"),
    "inlet_film_factor": QUANTITIES["inlet_film_factor"],
    "heat_change": Quantity("-", "relative change of f by the heat of film and surfaces"),
    "real_contact_area_fraction": QUANTITIES["real_contact_area_fraction"],
    "plastic_area_fraction": QUANTITIES["plastic_area_fraction"],
    "edge_load": Quantity("-", "share of the contact's load on the edge columns of its patch"),
    "load_residual": _OF_POINT["load_residual"],
    "volume_residual": _OF_POINT["volume_residual"],
    "mass_residual": Quantity("-", "what is missing in the balance of the lubricant over the flow"),
    "steps": Quantity("-", "steps taken so far"),
    "min_film": QUANTITIES["min_film"],
    "central_film": QUANTITIES["central_film"],
    "mean_film": Quantity("m", "mean film thickness over A"),
    "mean_gap": QUANTITIES["mean_gap"],
    "wet_from": Quantity("m", "begin of the pressurised film"),
    "wet_to": Quantity("m", "end of the pressurised film"),
    "max_pressure": Quantity("Pa", "largest pressure of the film"),
    "flash_temperature_rise": QUANTITIES["flash_temperature_rise"],
    "film_temperature_rise": QUANTITIES["film_temperature_rise"],
    "net_inflow": Quantity("m2/s", "flow into the film per unit width"),
    "stored": Quantity("m2/s", "growth of the film per unit width"),
    "cavity_growth": Quantity("m2/s", "growth of the cavities per unit width"),
}
KEYS = {  # of a scene, as far as they are numbers
    "speed": _OF_POINT["speed"],
    "bodies.radius": Quantity("m", "reduced radius"),
    "bodies.radii": Quantity("m", "radii of both bodies"),
    "bodies.width": Quantity("m", "length of the line contact"),
    "bodies.load": Quantity("N", "total load"),
    "bodies.e_prime": Quantity("Pa", "composite modulus E'"),
    "bodies.young_modulus": Quantity("Pa", "Young's modulus of both bodies"),
    "bodies.poisson_ratio": Quantity("-", "Poisson ratio of both bodies"),
    "bodies.hardness": Quantity("Pa", "plastic limit of the contact pressure"),
    "bodies.boundary_film": Quantity("m", "gap below which the bodies rub with f_b"),
    "bodies.boundary_friction_coefficient": Quantity("-", "boundary friction coefficient"),
    "lubricant.viscosity": Quantity("Pa s", "viscosity at ambient pressure"),
    "lubricant.pressure_viscosity_coefficient": Quantity("1/Pa", "pressure-viscosity coefficient"),
    "lubricant.eyring_stress": Quantity("Pa", "Eyring stress"),
    "lubricant.carreau": Quantity("Pa, -", "critical stress and exponent of Carreau's law"),
    "lubricant.limiting_stress_coefficient": Quantity("-", "limiting shear stress per pressure"),
    "lubricant.limiting_stress_offset": Quantity("Pa", "limiting shear stress at ambient pressure"),
    "lubricant.inlet_length": Quantity("m", "distance upstream of the contact where the lubricant begins"),
    "lubricant.inlet_film": Quantity("m", "lubricant that arrives, its thickness on both surfaces together"),
    "lubricant.temperature_coefficient": Quantity("1/K", "fall of ln(viscosity) with the temperature"),
    "lubricant.conductivity": Quantity("W/(m K)", "thermal conductivity of the film"),
    "motion.entrainment_speed": Quantity("m/s", "entrainment speed"),
    "motion.speeds": Quantity("m/s", "entrainment speeds"),
    "motion.surface_speeds": Quantity("m/s", "speeds of both surfaces"),
    "motion.speed_range": Quantity("m/s, m/s, -", "lowest and highest speed, and how many"),
    "motion.slide_roll_ratio": Quantity("-", "slide-roll ratio"),
    "motion.slip_percent": Quantity("%", "slide-roll ratio in percent"),
    "bodies.conductivity": Quantity("W/(m K)", "thermal conductivity of both bodies"),
    "bodies.volumetric_heat": Quantity("J/(m3 K)", "heat capacity of both bodies"),
    "bodies.hertz_pressure": Quantity("Pa", "peak Hertz pressure"),
    "bodies.hardness_hv": Quantity("HV", "Vickers hardness"),
    "lubricant.temperature": Quantity("K", "temperature of the oil"),
    "lubricant.temperature_celsius": Quantity("°C", "temperature of the oil"),
    "lubricant.viscosity_index": Quantity("-", "viscosity index"),
    "lubricant.nu40": Quantity("m2/s", "kinematic viscosity at 40 °C"),
    "lubricant.nu100": Quantity("m2/s", "kinematic viscosity at 100 °C"),
    "lubricant.viscosity_table": Quantity("K, m2/s", "temperatures and kinematic viscosities"),
    "lubricant.density": Quantity("kg/m3", "density of the oil at 15 °C"),
    "lubricant.density_slope": Quantity("kg/(m3 K)", "fall of the density with the temperature"),
    "surface.sq": Quantity("m", "root mean square roughness"),
    "surface.ra": Quantity("m", "mean absolute height"),
    "surface.rz": Quantity("m", "height of a sampling length"),
    "surface.correlation_length": Quantity("m", "correlation length"),
    "surface.spacing": Quantity("m", "cell size of the map"),
    "surface.s_filter": Quantity("m", "nesting index below which the map is smoothed"),
    "surface.l_filter": Quantity("m", "nesting index above which the map is levelled"),
    "contact.spacing": Quantity("m", "cell size"),
    "transient.tolerance": Quantity("-", "largest local error of the film in a step"),
    "transient.duration": Quantity("s", "duration"),
    "transient.initial_film": Quantity("m", "film to start from"),
}
KEYS |= {
    f"numerics.{part}tolerance": Quantity("-", f"relative tolerance {of}")
    for part, of in {"": "on f", "sampling_": "on f, by sampling", "model_": "on f, by the model"}.items()
} | {f"numerics.{part}_tolerance": Quantity("-", f"of the {part}") for part in ("film", "contact", "balance")}
KEYS |= {
    key.replace("surface.", "counterface."): Quantity(unit, f"{label}, of the other body")
    for key, (unit, label, *_) in KEYS.items()
    if key.startswith("surface.")
}
OF_STUDY = {f"uncertainty_{name}": q for name, q in OF_UNCERTAINTY.items()} | {  # columns of the tables of studies
    "uncertainty_low": INTERVAL["interval_low"],
    "uncertainty_high": INTERVAL["interval_high"],
    "uncertainty_freedom": Quantity("-", "degrees of freedom of the standard error of f"),
    "uncertainty_tolerance": Quantity("-", "relative standard error of f that was asked for"),
}
COLUMNS = OF_MOMENT | KEYS | QUANTITIES | INTERVAL | {q.column or n: q for n, q in OF_UNCERTAINTY.items()} | OF_STUDY
COLUMNS["ratio"] = KEYS["motion.slide_roll_ratio"]


def depending_on(error: str) -> tuple[str, ...]:
    """Names of the quantities whose error depends on that: "split" (the division of the load), "shear", "area",
    "spots", "film", "heat"."""
    return tuple(name for name, q in QUANTITIES.items() if q.error == error)


def described(name: str, table: dict[str, Quantity] = COLUMNS) -> dict[str, str]:
    """Attributes of a column, in the words of the CF conventions."""
    unit, label = table.get(name, Quantity("", name.rpartition(".")[2].replace("_", " ")))[:2]
    return {"units": "1" if unit == "-" else unit, "long_name": label} if unit else {"long_name": label}


def heading(name: str) -> str:
    """The heading of a column: its name, and its unit in brackets; of words, the name alone."""
    return f"{name} [{COLUMNS[name].unit}]" if name in COLUMNS else name


def axis_label(name: str) -> str:
    """The label of an axis: long name, symbol and unit."""
    unit, label, symbol = COLUMNS.get(name, Quantity("", name))[:3]
    return " ".join((label, *filter(None, (symbol,)), *([f"({unit})"] if unit else [])))


def in_words(values: Any, names: Iterable[str]) -> dict[str, str]:
    """Attributes of ``values`` by symbol, to four digits and with their units: ``{"F_C": "3.2 N"}``."""
    rows = [(COLUMNS[name], getattr(values, name)) for name in names]
    return {q.symbol or q.label: f"{value:.4g}" + (f" {q.unit}" if q.unit != "-" else "") for q, value in rows}


def counted(count: int, plural: str) -> str:
    """How many there are, in words: "1 speed", "2 speeds"."""
    return f"{count} {plural if count != 1 else plural.removesuffix('s')}"


def key_unit(section: str, key: str) -> str:
    """The unit of a key of a scene, for people; "" where it has none."""
    unit = KEYS[f"{section}.{key}"].unit if f"{section}.{key}" in KEYS else "-"
    return "" if unit == "-" else unit
