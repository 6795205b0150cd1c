"""Every number of a result and of a scene, once: unit, name, symbol, what its error depends on (CONTRIBUTING.md)."""

from __future__ import annotations

import json
import math
import re
import tomllib
from collections.abc import Iterable, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, fields
from importlib.resources import files
from inspect import cleandoc
from typing import Any, Generic, NamedTuple, TypeVar

from .errors import InputError
from .units import converted, plain_number, printed, unit_of_largest, worded

T = TypeVar("T")  # float, or an array over operating points


class Quantity(NamedTuple):
    """``unit`` ("-" without one), ``label`` (long name), ``symbol``; ``error``: what its error depends on ("" where
    none is estimated); ``column``: its name in tables where that is not its own; ``note``: what a reader should know;
    ``is_friction``: whether it is a part of the friction force, on surface 2: positive against its sliding in
    steady motion, and along -x in time.

    Of a number of a result, what changes it after its strips are solved, and where it is known:
    ``follows_asperity_load``: in proportion to the asperity load of moving roughness; ``follows_sliding``: in
    proportion to the sliding part of f, where its change by shorter cells is only expected; ``is_left_by_cells``: not
    changed by shorter cells, because it is an input, a residual, made of small differences, or follows from others;
    ``is_controlled``: corrected by the control of a cheaper model; ``is_in_time``: known in runs in time.

    Of the key of a scene (keys.toml): the ``least`` and the ``most`` that it may be, or ``above`` which it has to be;
    its ``usual`` range, whether 0 is usual too (``zero``), and the units that are mistaken for its own (``meant``).
    """

    unit: str
    label: str
    symbol: str = ""
    error: str = ""
    column: str = ""
    note: str = ""
    is_friction: bool = False
    follows_asperity_load: bool = False
    follows_sliding: bool = False
    is_left_by_cells: bool = False
    is_controlled: bool = False
    is_in_time: bool = True
    least: float = -math.inf
    above: float = -math.inf
    most: float = math.inf
    usual: Sequence[float] = ()
    zero: bool = False
    meant: Sequence[Any] = ()

    @property
    def limited(self) -> bool:
        """Whether there are numbers that it cannot be."""
        return max(self.least, self.above) > -math.inf


def quantity(unit: str, label: str, symbol: str = "", **more: Any) -> Any:
    """Return a field of a dataclass that is a `Quantity`. ``more``: ``error``, ``column``, ``note`` and further fields
    of it, ``default``."""
    default = {"default": more.pop("default")} if "default" in more else {}
    return field(metadata={"quantity": Quantity(unit, label, symbol, **more)}, **default)


def quantities(kind: type) -> dict[str, Quantity]:
    """Return the quantities among the fields of a dataclass, by name."""
    return {f.name: f.metadata["quantity"] for f in fields(kind) if "quantity" in f.metadata}


def described_in_doc(kind: type[T]) -> type[T]:
    """Return the class ``kind`` with its quantities at the begin of the attributes in its docstring."""
    head = "Attributes\n----------\n"
    lines = [f"{name} : {q.label} [{q.unit}]{q.note and '; ' + q.note}\n" for name, q in quantities(kind).items()]
    kind.__doc__ = cleandoc(kind.__doc__ or "").replace(head, head + "".join(lines))
    return kind


@dataclass(frozen=True, repr=False, kw_only=True)
class Quantities(Generic[T]):
    """The numbers of an operating point whose errors are estimated (T: float), or of many points (T: array)."""

    coefficient: T = quantity(
        *("-", "friction coefficient", "f"),
        error="all",
        note="(f_b F_C + F_sh)/F_T (Akchurin et al. 2015, Eq. 9), of surface 2 against its sliding",
    )
    contact_load: T = quantity(
        *("N", "load carried by the rough contact", "F_C"),
        error="sharing",
        note="load where the shear stress is f_b p, including saturated films of a Newtonian oil; by load sharing "
        "alone the load of the rough contact",
        follows_asperity_load=True,
        follows_sliding=True,
        is_controlled=True,
    )
    film_load: T = quantity(*("N", "load carried by the film", "F_H"), error="sharing", is_controlled=True)
    shear_force: T = quantity(
        *("N", "shear force of the film", "F_sh"),
        error="shear",
        note="of both parts",
        is_friction=True,
        is_controlled=True,
        is_in_time=False,
    )
    couette_force: T = quantity(
        "N",
        "sliding part of the shear force",
        error="shear",
        is_friction=True,
        follows_sliding=True,
        is_controlled=True,
    )
    rolling_force: T = quantity(
        "N",
        "rolling part of the shear force",
        error="shear",
        note="with moving roughness it includes the pressure on the flanks of surface 2, which scatters about 0",
        is_friction=True,
        is_left_by_cells=True,
        is_controlled=True,
    )
    rolling_resistance: T = quantity(
        "N",
        "rolling resistance of both surfaces together, against the entrainment",
        error="shear",
        note="moment of the load about the middle of the contact, over R; with roughness at rest it includes the asperity "
        "contacts, whose part is 0 on average; with moving roughness it is that of the smooth film",
        is_left_by_cells=True,
        is_controlled=True,
    )
    boundary_force: T = quantity(
        *("N", "friction force of the asperity contacts", "f_b F_C"),
        error="sharing",
        note="zero in pure rolling",
        is_friction=True,
        follows_asperity_load=True,
        follows_sliding=True,
        is_controlled=True,
    )
    real_contact_area_fraction: T = quantity(
        *("-", "contact area inside the Hertz strip over its area A", "A_i/A"),
        error="area",
        note="without the contacts outside the strip",
        follows_asperity_load=True,
        follows_sliding=True,
    )
    real_contact_area: T = quantity(
        *("m2", "real contact area", "A_c"),
        error="area",
        note="inside and outside the Hertz strip, over the length of the line contact: area where the shear stress is "
        "f_b p; by load sharing alone that of the rough contact",
        follows_asperity_load=True,
        follows_sliding=True,
        is_in_time=False,
    )
    plastic_area_fraction: T = quantity("-", "plastic area over nominal area", "A_p/A", error="contacts")
    min_film: T = quantity(
        "m",
        "smallest film thickness",
        "h_min",
        error="film",
        note="of the smooth film under the load F_H by load sharing, of the rough gap by the other models; NaN at U = 0",
    )
    central_film: T = quantity(
        *("m", "central separation", "h_c"),
        error="film",
        note="mean gap of the rough surfaces at x = 0: no film thickness where asperities touch; by load sharing the "
        "smooth film at x = 0 under the load F_H; NaN at U = 0",
    )
    mean_gap: T = quantity(
        "m",
        "mean separation",
        error="film",
        note="mean gap of the rough surfaces over A",
        is_controlled=True,
    )
    film_to_roughness_ratio: T = quantity(
        *("-", "central separation over Sq", "h_c/Sq"),
        error="film",
        note="not the lambda ratio, which has the full-load film: larger where asperities hold the gap open",
        is_left_by_cells=True,
    )
    inlet_film_factor: T = quantity(
        *("-", "factor on the film by the heat of its inlet"),
        error="heat",
        note="1 where the heat is too small to matter; NaN where it was not computed",
    )
    flash_temperature_rise: T = quantity(
        *("K", "largest temperature rise of the surfaces"),
        error="heat",
        note="mean along the line, of both surfaces alike; NaN where it was not computed",
    )
    film_temperature_rise: T = quantity(
        "K",
        "largest mean temperature rise of the film over the surfaces",
        error="heat",
        note="mean across the film and along the line; by the deterministic model for the solved strips at one moment, so "
        "it scatters; NaN where it was not computed",
    )
    power_loss: T = quantity(
        "W",
        "power loss",
        "P",
        error="all",
        note="friction forces on both surfaces times their speeds, rolling resistance included",
    )

    def in_unit(self, name: str, unit: str) -> T:
        """Return the number ``name`` in another unit, ``result.in_unit("min_film", "nm")``; `InputError` for other
        kinds."""
        if name not in NUMBERS:
            raise InputError(f" = {name!r} is not a number of a result", "name", ", ".join(NUMBERS))
        number: T = converted(getattr(self, name), _OF_POINT[name].unit, unit)
        return number


@dataclass(frozen=True, repr=False, kw_only=True)
class PointQuantities(Quantities[T]):
    """All numbers of an operating point: of a `lubfric.FrictionResult`, and as arrays of a `lubfric.StribeckResult`."""

    speed: T = quantity(
        "m/s",
        "entrainment speed",
        "U",
        is_left_by_cells=True,
    )
    load_residual: T = quantity(
        "-",
        "relative residual of the load balance",
        note="(F_C + F_H - F_T)/F_T",
        is_left_by_cells=True,
    )
    volume_residual: T = quantity(
        "-",
        "relative residual of the volume balance",
        note="(gap - g)/(gap + g), where the closure requires the gap g (by Eq. (8) the film)",
    )
    clearance: T = quantity(
        "-",
        "gap between the film and the highest asperities over Sq",
        note="NaN where they touch, or without a film",
        is_in_time=False,
    )
    steepness: T = quantity(
        "-",
        "d ln(film_load/contact_load) over d ln(speed)",
        note="NaN where film and contact do not share the load",
        is_in_time=False,
    )
    seconds: T = quantity(
        "s",
        "time of the solve",
        note="wall-clock time of this point in its process",
        is_in_time=False,
    )
    full_load_film: T = quantity(
        "m",
        "full-load film thickness",
        "h_F",
        note="central film of smooth surfaces under F_T, by closed forms, also for a starved inlet",
    )
    lambda_ratio: T = quantity(
        *("-", "lambda ratio", "Λ"),
        note="full-load film thickness over Sq; in time that of steady motion with the values of the moment",
    )
    boundary_film_load: T = quantity(
        "N",
        "load on gaps below the boundary film",
        note="at boundary friction f_b; by load sharing alone the load of the rough contact",
        follows_asperity_load=True,
        follows_sliding=True,
        is_in_time=False,
    )
    saturated_film_load: T = quantity(
        "N",
        "load on thicker films whose shear stress is at its limit",
        note="limit of the oil, or f_b p for a Newtonian oil, whose asperity load includes this load; NaN by load "
        "sharing alone",
        is_in_time=False,
    )


@dataclass(frozen=True, kw_only=True)
class UncertaintyQuantities(Generic[T]):
    """How sure a friction coefficient is, in numbers: of a point (T: float) or of many (T: array)."""

    numerical: T = quantity(
        "-", "estimated relative error of f by film, grids and solvers", column="numerical_error", default=math.nan
    )
    sampling: T = quantity(
        "-",
        "relative standard error of f because the sample of the rough surface is finite",
        column="sampling_error",
        note="NaN where it is not known",
        default=math.nan,
    )
    freedom: T = quantity("-", "degrees of freedom of the standard error of f", column="sampling_freedom", default=0.0)
    line_scatter: T = quantity(
        "-", "relative standard deviation of f between lines as wide as that of the scene", default=math.nan
    )
    effective_contacts: T = quantity(
        "-", "effective number of asperity contacts: equal contacts that would scatter as much", default=math.nan
    )
    length: T = quantity("m", "length of the line of rough surface", column="line_length", default=math.nan)
    area_needed: T = quantity("-", "required area of a measured map over its own", note="1: enough", default=1.0)
    model: T = quantity("-", "relative error of f by the model, at 95 %", column="model_error", default=math.nan)
    by_limit: T = quantity(
        "-",
        "part of the model-form error: the limiting stress of a Newtonian lubricant is not known",
        column="limit_error",
        note="not counted against numerics.model_tolerance",
        default=0.0,
    )
    not_given: T = quantity(
        "-",
        "relative change of f by the range of an input that the scene does not give",
        column="not_given_error",
        note="not counted against numerics.model_tolerance",
        default=0.0,
    )
    inputs: T = quantity("-", "relative change of f by the ranges of inputs", column="input_error", default=0.0)


_OF_POINT = quantities(PointQuantities)
NUMBERS = ("speed", *(name for name in _OF_POINT if name != "speed"))  # of a result, in the order of its tables
QUANTITIES = {name: _OF_POINT[name] for name in NUMBERS[1:]}
ESTIMATED = tuple(quantities(Quantities))  # those with an error of their own
FRICTION_FORCES = tuple(name for name, q in QUANTITIES.items() if q.is_friction)
OF_UNCERTAINTY = quantities(UncertaintyQuantities)
INTERVAL = {
    "interval_low": Quantity("-", "lower end of the 95 % interval of f"),
    "interval_high": Quantity("-", "upper end of the 95 % interval of f"),
    "power_loss_low": Quantity("W", "lower end of the 95 % interval of the power loss"),
    "power_loss_high": Quantity("W", "upper end of the 95 % interval of the power loss"),
}
OF_SIDES = {  # of the errors of f that differ towards 0 and away from it
    f"{OF_UNCERTAINTY[name].column}_{end}": Quantity("-", f"{label} {side}, at 95 %")
    for name, label in (
        ("model", "relative model-form error of f"),
        ("not_given", "relative change of f by the range of an input that the scene does not give,"),
        ("inputs", "relative change of f by the ranges of inputs,"),
    )
    for end, side in (("low", "towards 0"), ("high", "away from 0"))
}
OF_MOMENT = {  # of a run in time, in the order of its table
    "time": Quantity("s", "time"),
    "angle_of_rotation": Quantity("°", "angle of rotation", note="NaN without transient.rotational_speed"),
    "entrainment_speed": _OF_POINT["speed"],
    "sliding_speed": Quantity("m/s", "sliding speed u2 - u1"),
    "load": Quantity("N", "total load", "F_T"),
    "friction_force": Quantity("N", "tangential force on surface 2, positive along -x"),
    **{name: q for name, q in QUANTITIES.items() if q.is_in_time},
    "sampling_error": OF_UNCERTAINTY["sampling"],
    "shear_error": Quantity("-", "estimated relative error of f by the sum of the film's shear stress"),
    **{
        name: q._replace(label=f"{q.label}, as in steady motion")
        for name, q in OF_SIDES.items()
        if "model_error" in name
    },
    "largest_friction": Quantity("-", "largest f that the limits of the shear stress allow"),
    **INTERVAL,
    "time_error": Quantity("-", "local error of the last step over its tolerance"),
    "heat_change": Quantity("-", "relative change of f by the heat of film and surfaces"),
    "edge_load": Quantity("-", "share of the contact's load on the edge columns of its patch"),
    "mass_residual": Quantity("-", "error of the mass balance of the lubricant over the flow"),
    "steps": Quantity("-", "steps taken so far"),
    "mean_film": Quantity("m", "mean film thickness over A"),
    "wet_from": Quantity("m", "start of the pressurised film"),
    "wet_to": Quantity("m", "end of the pressurised film"),
    "max_pressure": Quantity("Pa", "largest pressure of the film"),
    "net_inflow": Quantity("m2/s", "flow into the film per unit width"),
    "stored": Quantity("m2/s", "growth of the film per unit width"),
    "cavity_growth": Quantity("m2/s", "growth of the cavities per unit width"),
}
OF_CYCLE = {  # of operating points: where they lie
    "position": Quantity("m", "position on the path of contact"),
    "angle": Quantity("rad", "angle"),
    "duration": Quantity("s", "duration"),
}
OF_SURFACES = {  # speeds of both surfaces in a table of operating points
    "u1": Quantity("m/s", "speed of surface 1"),
    "u2": Quantity("m/s", "speed of surface 2"),
    "sliding_speed": OF_MOMENT["sliding_speed"],
}
RADII_OF_SURFACES = {  # of the same table
    "R1": Quantity("m", "radius of surface 1"),
    "R2": Quantity("m", "radius of surface 2"),
}
_ROWS = tomllib.loads((files(__package__) / "keys.toml").read_text(encoding="utf-8")).items()
_ROW = {f"{section}.{key}": row for section, rows in _ROWS for key, row in rows.items()}
CHOICES = {key: row["one_of"] for key, row in _ROW.items() if "one_of" in row}  # keys of a scene that are words
# What is meant by other words than these, in small letters.
OTHER_VALUES = {word: meant for row in _ROW.values() for word, meant in row.get("other_words", {}).items()}
KEYS = {key: Quantity(**row) for key, row in _ROW.items() if key not in CHOICES}  # those that are numbers: section.key
KEYS["speed"] = _OF_POINT["speed"]
KEYS |= {
    key.replace("surface.", "counterface."): q._replace(label=f"{q.label}, of the other body")
    for key, q in KEYS.items()
    if key.startswith("surface.")
}
COLUMN_OF_ERROR = {name: q.column or name for name, q in OF_UNCERTAINTY.items()}  # columns of tables
COLUMNS = (
    OF_MOMENT
    | OF_CYCLE
    | OF_SURFACES
    | RADII_OF_SURFACES
    | KEYS
    | QUANTITIES
    | INTERVAL
    | OF_SIDES
    | {COLUMN_OF_ERROR[name]: q for name, q in OF_UNCERTAINTY.items()}
    | {"sampling_tolerance": Quantity("-", "requested relative standard error of f")}
)
COLUMNS["ratio"] = KEYS["motion.slide_roll_ratio"]
# Digits of where an operating point lies, at most. A choice: tables of users have as many.
GIVEN_DIGITS = 6
# Ends of the keys of two lengths, along x and y.
LENGTHS_ALONG_AXES = ("correlation_length", "spacing")


def worded_value(name: str, value: Any) -> str:
    """Return a ``value`` of the column or key ``name``, in a common unit; that of the oil's temperature in °C. Several
    numbers, also as a text such as "[1e-05, 5e-05]", have one unit; lengths along x and y are "10 x 50 µm"."""
    unit = COLUMNS[name].unit if name in COLUMNS else "-"
    numbers = _listed_numbers(value)
    if numbers and unit != "-":
        largest = unit_of_largest(numbers, unit)
        between = " and " if len(numbers) == 2 else ", "
        if name.endswith(LENGTHS_ALONG_AXES):
            between = " x "
        return f"{between.join(f'{converted(v, unit, largest):.4g}' for v in numbers)} {printed(largest)}".rstrip()
    if name in OF_CYCLE:
        return plain_number(value, unit, GIVEN_DIGITS)
    if name == "lubricant.temperature" and not isinstance(value, str):
        return f"{converted(value, 'K', '°C'):.4g} °C"
    return worded(value, unit)


def _listed_numbers(value: Any) -> list[float]:
    """Return the numbers of a list of them, or of a text that is one; none of anything else."""
    if isinstance(value, str) and value.startswith("["):
        with suppress(ValueError):
            value = json.loads(value)
    is_list = isinstance(value, (list, tuple)) and all(type(part) in (int, float) for part in value)
    return [float(part) for part in value] if is_list else []


def names_with(fact: str) -> tuple[str, ...]:
    """Return the names of the numbers of a result with this ``fact``, a boolean field of `Quantity`."""
    return tuple(name for name in NUMBERS if getattr(_OF_POINT[name], fact))


def depending_on(error: str) -> tuple[str, ...]:
    """Return the names of the quantities whose error depends on ``error``: "sharing" (the division of the load),
    "shear", "area", "contacts", "film", "heat", or "all" of these."""
    return tuple(name for name, q in QUANTITIES.items() if q.error == error)


def described(name: str, table: dict[str, Quantity] = COLUMNS) -> dict[str, str]:
    """Return the attributes of a column, in the words of the CF conventions."""
    unit, label = table.get(name, Quantity("", name.rpartition(".")[2].replace("_", " ")))[:2]
    return {"units": "1" if unit == "-" else unit, "long_name": label} if unit else {"long_name": label}


# Names of columns in headings, where they differ: beside errors that are half of a 95 % interval, one that is a standard
# error says so.
NAMES_IN_TABLES = {"sampling_error": "sampling_standard_error"}


def heading(name: str) -> str:
    """Return the heading of a column: its name in tables (`NAMES_IN_TABLES`), and its unit in brackets; of words, the
    name alone."""
    return f"{NAMES_IN_TABLES.get(name, name)} [{COLUMNS[name].unit}]" if name in COLUMNS else name


def axis_label(name: str, in_unit: str = "") -> str:
    """Return the label of an axis: long name, symbol in italics and unit, its own or ``in_unit``."""
    unit, label, symbol = COLUMNS.get(name, Quantity("", name))[:3]
    unit = printed(in_unit) or unit
    formula = re.sub(r"_(\w+)", r"_{\1}", symbol).replace(" ", r"\,")
    return " ".join((label, *([f"${formula}$"] if formula else []), *([f"({unit})"] if unit else [])))


def in_words(values: Any, names: Iterable[str]) -> dict[str, str]:
    """Return the attributes of ``values`` by symbol, to four digits and with their units: ``{"F_C": "3.2 N"}``."""
    rows = [(COLUMNS[name], getattr(values, name)) for name in names]
    return {q.symbol or q.label: f"{value:.4g}" + (f" {q.unit}" if q.unit != "-" else "") for q, value in rows}


def counted(count: int, plural: str) -> str:
    """Return how many there are, as text: "1 speed", "2 speeds", "1 pass"."""
    singular = plural.removesuffix("es" if plural.endswith("sses") else "s")
    return f"{count} {plural if count != 1 else singular}"
