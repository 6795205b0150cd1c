"""The roughness of one body: a measured map and how it is prepared, or a generated one."""

import math
import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import KW_ONLY, dataclass
from functools import partial
from typing import Any

from .._base import Shown, changed, validate
from ..errors import InputError
from ..surface import ACFS, DECIMALS, FORM_POWERS, PER_SQ, honed_sq, honing_of, units_of
from .bodies import lengths

NEEDED = "either 'file', or 'sq' (or 'ra', 'rz', or 'sk', 'spk' and 'svk') and 'correlation_length' in m"
OPTIONS = {"acf": ACFS, "motion_axis": ("x", "y"), "decimal": DECIMALS, "form": FORM_POWERS}
OPTIONS |= {"outliers": ("refuse", "keep", "mask"), "extension": ("none", "mirror")}
HONED = ("sk", "spk", "svk", "honing_angle", "groove_width")  # fields of a plateau-honed map
GENERATED = ("correlation_length", "acf", "decay_level", "seed", "oversize", *HONED)  # fields of a generated map
LENGTH_KEYS = ("surface.correlation_length", "counterface.correlation_length")  # whose value may be a pair
SAME_SQ = 1e-9  # relative difference of two Sq that are one; a choice, above rounding


@dataclass(frozen=True, repr=False)
class Roughness(Shown):
    """Where the height map of a body comes from: a file, or a generated surface.

    The keys of a file are applied in the order given here.

    Attributes
    ----------
    file : path of a height map (`lubfric.read_surface`), or None to generate one
    sq : standard deviation of the heights [m]; a file is scaled to it when given
    correlation_length : of a generated map [m], one, or x and y, at ``decay_level``
    acf : of a generated map: "exponential" or "gaussian"
    decay_level : value of the autocorrelation at ``correlation_length``
    seed : of a generated map
    oversize : a generated map is made this many times as long in x and y. Then its middle is cut out and scaled to sq.
        This is for correlation lengths that do not fit the patch
    spacing : of a file that does not carry its own [m]
    unit : "m", "mm", "um" or "µm", "nm", of a file that does not carry its own; of a list of points also several, (x
        and y, heights) or (x, y, heights)
    decimal : "." or ",", of a text file in which commas can be either
    missing_value : number in a text or .npy file that represents "not measured"
    form : F-operation, least squares: "plane" or "quadratic" (second order: cylinder or paraboloid too)
    outliers : what to do with points that are isolated (`lubfric.surface.outliers`), which would carry the load:
        "refuse" the map, "keep" them, or "mask" and fill them
    s_filter, l_filter : nesting indices [m] of the Gaussian filters of ISO 16610-61. The first removes shorter waves,
        the second longer ones
    motion_axis : the axis of the *file*, "x" or "y", that lies along the motion
    extension : "mirror" continues a map that is too short along x by its mirror image
    sk, spk, svk : core height, reduced peak height, reduced dale height [m] of a generated plateau-honed map; ``sq``
        follows from them
    honing_angle : of such a map, angle [°] between the two directions of its grooves, which the y axis bisects (None:
        50)
    groove_width : correlation length across its grooves at 1/e [m] (None: the longer correlation length)

    Raises
    ------
    InputError : values out of range, and fields that do not apply to the kind of map
    """

    file: str | None = None
    _: KW_ONLY
    sq: float | None = None
    correlation_length: float | tuple[float, float] | None = None
    acf: str = "exponential"
    decay_level: float = math.exp(-1)
    seed: int = 0
    motion_axis: str = "x"
    spacing: float | tuple[float, float] | None = None
    unit: str | tuple[str, ...] | None = None
    oversize: int = 1
    form: str = "plane"
    decimal: str | None = None
    missing_value: float | None = None
    outliers: str = "refuse"
    s_filter: float | None = None
    l_filter: float | None = None
    extension: str = "none"
    sk: float | None = None
    spk: float | None = None
    svk: float | None = None
    honing_angle: float | None = None
    groove_width: float | None = None

    def __post_init__(self) -> None:
        validate.python_fields(self, "surface")
        if self.file is None and any(getattr(self, name) is not None for name in HONED):
            object.__setattr__(self, "sq", self._honed_sq())
        if self.file is None and (self.sq is None or self.correlation_length is None):
            raise InputError(f" needs {NEEDED}", "surface")
        if isinstance(self.file, os.PathLike):
            object.__setattr__(self, "file", os.fspath(self.file))
        if self.file is not None and (not isinstance(self.file, str) or "\0" in self.file):
            raise InputError(
                f" = {validate.shown(self.file)} is not a path", "surface.file", recommendation="write it in quotes"
            )
        for name, check in _CHECKS.items():
            value = getattr(self, name)
            if value is not None:
                object.__setattr__(self, name, check(f"surface.{name}", value))
        check_fields(changed(self))

    def _honed_sq(self) -> float:
        """Return the Sq [m] of a plateau-honed map, 0 where it is switched off by sq = 0. Raise `InputError` for keys
        that do not go together."""
        for name in HONED:
            if getattr(self, name) is not None:
                object.__setattr__(self, name, validate.of_key(f"surface.{name}", getattr(self, name)))
        with in_section("surface"):
            honing_of(self.sk, self.spk, self.svk, self.honing_angle, self.groove_width, (1.0, 1.0))
        if self.sq == 0:
            return 0.0
        sq = honed_sq(self.sk, self.spk, self.svk)
        if self.sq is not None and abs(self.sq - sq) > SAME_SQ * sq:
            message = (
                f" = {validate.shown(self.sq)} cannot be combined with sk, spk and svk, from which Sq {sq:.4g} m "
                "follows"
            )
            raise InputError(message, "surface.sq", recommendation="give sq, or sk, spk and svk (the others None)")
        return sq

    @property
    def applicable(self) -> dict[str, Any]:
        """The fields with a value that apply to this kind of map, from a file or generated, by name."""
        names = [
            name for name in self.__dataclass_fields__ if (name in GENERATED) == (self.file is None) or name == "sq"
        ]
        return {name: getattr(self, name) for name in names if getattr(self, name) is not None}


@contextmanager
def in_section(section: str) -> Iterator[None]:
    """Put the ``section`` before the quantity of an `InputError`."""
    try:
        yield
    except InputError as error:
        if error.quantity and "." not in error.quantity:
            error.quantity = f"{section}.{error.quantity}"
        raise


def check_fields(given: dict[str, Any]) -> None:
    """Raise `InputError` for a field that has no meaning for this kind of map, from a file or generated."""
    generated = "file" not in given
    this, other = ("a map from a file", "generated") if generated else ("a generated map", "read from a file")
    for name, value in given.items():
        if name not in ("file", "sq", *PER_SQ) and (name in GENERATED) != generated:
            message = f" = {validate.shown(value)} applies to {this}, and this one is {other}"
            raise InputError(message, f"surface.{name}", recommendation="omit it")


@contextmanager
def named(section: str) -> Iterator[None]:
    """Make an `InputError` about a `Roughness` name the ``section`` in which it is."""
    try:
        yield
    except InputError as error:
        first, dot, key = error.quantity.partition(".")
        if first == "surface":
            error.quantity = f"{section}{dot}{key}"
        raise


def as_given(old: Roughness | None, values: dict[str, Any]) -> dict[str, Any]:
    """Return the fields that ``values`` change in ``old``. If a file replaces a generated map, the fields of the
    generated map go, and the reverse."""
    if any(values.get(name) is not None for name in ("sk", "spk", "svk")) and "sq" not in values:
        values = {"sq": None} | values  # it follows from them
    if old is not None and old.file is None and values.get("file") is not None:
        height = {} if any(key in values for key in PER_SQ) else {"sq": None}
        return height | {name: getattr(Roughness, name) for name in GENERATED} | values
    if old is not None and old.file is not None and values.get("file", old.file) is None:
        return dict.fromkeys(name for name in changed(old) if name not in ("sq", *GENERATED)) | values
    return values


def lengths_in_range(name: str, given: Any) -> tuple[Any, tuple[Any, Any] | None]:
    """Return the correlation length ``given`` for the key ``name`` (section.key), one [m] or a pair, and its range: of
    three parts the last two, of anything else None. Raise `InputError` for three that are no [value, low, high]."""
    if not isinstance(given, (list, tuple)):
        return given, None
    is_pair = [isinstance(part, (list, tuple)) for part in given]
    if len(given) < 3 and not any(is_pair):
        return given, None
    if len(given) != 3 or any(is_pair) != all(is_pair):
        allowed = "a length, a pair [along x, along y], or [value, low, high] of three lengths or three pairs"
        raise InputError(f" = {validate.shown(given)}", name, allowed)
    (value, low, high) = (lengths(name, part) for part in given)
    return value, (low, high)


def checked_unit(name: str, value: Any) -> str | tuple[str, ...]:
    """Return the unit of a map, or several, as given. Raise `InputError` for others."""
    units_of(name, value)
    return tuple(value) if isinstance(value, (list, tuple)) else value


_CHECKS: dict[str, Callable[[str, Any], Any]] = dict.fromkeys(
    ("sq", "decay_level", "s_filter", "l_filter"), validate.of_key
)
_CHECKS |= dict.fromkeys(("correlation_length", "spacing"), lengths)
_CHECKS |= {name: partial(validate.choice, options=options) for name, options in OPTIONS.items()}
_CHECKS |= {
    "unit": checked_unit,
    "seed": partial(validate.integer, minimum=0, maximum=2**128 - 1),
    "oversize": partial(validate.integer, minimum=1, maximum=64),
    "missing_value": partial(validate.number, unit="(unit of the file)"),
}
