"""A curve or a study as a formula f(U, T, p) for system simulations, fitted, with its error and range: as text, JSON
and C."""

import json
from collections.abc import Iterable, Mapping
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from .._base import FloatArray, Shown, plain, validate
from ..errors import InputError
from ..models.shared import LARGE_NUMERICAL_ERROR, percent, percent_or_less
from ..scene import Scene
from .interpolate import Interpolant

# Speeds of a curve to which a law is fitted, in addition to those that were solved.
FITTED_SPEEDS = 50

# Relative error of a curve between its points, as it estimates it, up to which it is used. A choice: a smaller value
# leaves fewer points to the law.
USABLE_ERROR = 0.02

# Fewest points of a law. A choice: more than the law has parameters.
FEWEST_POINTS = 12

# Largest relative deviation of a law from the curves to which it is fitted, above which it has a warning. A choice, as
# wide as many intervals of f: above it the formula, and not f, limits what a simulation shows.
LARGEST_OF_LAW = 0.1

LAW_OVER_OTHERS = (
    "no law over other inputs is offered: result.best() compares designs, the report states what each input does, and "
    "result.to_csv(path) has all numbers for a fit of your own"
)
MORE_SPEEDS = "solve more speeds, or speeds='auto'"

# Relative distance by which a number may lie outside a range. A choice, above rounding.
ROUNDED = 1e-9

# Largest friction of asperity contacts that carry the whole load, over f_b. A choice: a larger value lets the law rise
# above its points.
OVER_REST = 1.1

# Speed over the slowest one below which f falls to 0 at rest. A choice: it is below all points.
REST_SPEED_RATIO = 0.03

# Walther's equation (ASTM D341), of the viscosity in mPa s.
WALTHER = "0.001*(pow(10.0, pow(10.0, A - B*log10(T))) - 0.7)"

# Smallest viscosity [Pa s] for which it has a value. A choice above it, for rounding.
LEAST_VISCOSITY = 3.001e-4

# The law: valid in Python and C, one name after the other.
LAW_FORMULA = {
    "V": "sqrt(U*U + u0*u0)",
    "e": "eta/eta0",
    "q": "p/p0",
    "H": "V/U1*pow(e, a)*pow(q, c)",
    "s": "pow(1.0 + pow(H, n)/m, -m)/(1.0 + r*H)",
    "t1": "C1*pow(V/U0, k1)*pow(e, e1)*pow(q, d1)",
    "t2": "C2*pow(V/U0, k2)*pow(e, e2)*pow(q, d2)",
    "f": "U/V*(b*s + (1.0 - s)/(1.0/t1 + 1.0/t2))",
}
CODE = {expression: compile(expression, "law", "eval") for expression in (WALTHER, "eta0", *LAW_FORMULA.values())}
FUNCTIONS = {"sqrt": np.sqrt, "pow": np.power, "log10": np.log10, "__builtins__": {}}
LOAD_RATIO_PARAMETERS = ("b", "U1", "n", "m", "r")
FILM_PARAMETERS = ("C1", "k1", "C2", "k2")

# Parameters that are searched in logarithms, the others as they are: bounds and starts by choice, far outside of what
# curves have.
POSITIVE = {
    "b": (1e-6, 10.0),
    "U1": (1e-15, 1e15),
    "n": (0.2, 10.0),
    "m": (0.2, 50.0),
    "r": (1e-6, 1e3),
} | dict.fromkeys(("C1", "C2"), (1e-9, 1e9))
EXPONENT_BOUNDS = np.array([-3.0, 3.0])
START_PARAMETERS = dict.fromkeys(("c", "e1", "e2", "d1", "d2"), 0.0) | {"a": 1.0, "n": 1.0, "m": 2.0, "r": 0.5}
SYMBOLS = {"speed": ("U", "m/s"), "temperature": ("T", "K"), "pressure": ("p", "Pa")}
VARIED = ("lubricant.temperature", "lubricant.temperature_celsius", "bodies.load")


@dataclass(frozen=True, repr=False, kw_only=True)
class Law(Shown):
    """Friction coefficient over entrainment speed U [m/s], oil temperature T [K] and mean Hertz pressure p [Pa].

    f = U/V (b s + (1 - s)/(1/t1 + 1/t2)), with s the share of the load on the asperity contacts, over U eta(T) as in a
    Stribeck curve, and t1, t2 the traction of the film at low and at high stress. ``V = sqrt(U² + u0²)`` makes f zero
    at rest, smooth, and odd: a force against the motion in both directions. ``text``, ``json`` and ``c`` say it for
    people, programs and compilers.

    Attributes
    ----------
    name : of the scene
    numbers : of the formula, by name; SI
    ranges : {"speed", "temperature", "pressure": (lowest, highest)} of the points; temperature NaN if not known
    largest, rms : relative deviation from the solved points, and from the curve between them where it is sure
    interval : largest distance of an end of the 95 % interval of a point from its f, model included, relative; NaN if
        one is not known
    """

    name: str
    numbers: dict[str, float]
    ranges: dict[str, tuple[float, float]]
    largest: float
    rms: float
    interval: float

    def __call__(
        self,
        speed: ArrayLike,
        temperature: ArrayLike | None = None,
        pressure: ArrayLike | None = None,
        *,
        extrapolate: bool = False,
    ) -> FloatArray:
        """Return f at ``speed`` [m/s] (either sign), ``temperature`` [K] and ``pressure`` [Pa], numbers or arrays;
        None: in the middle of the range. Raises `InputError` outside ``ranges``, unless ``extrapolate``. Slower than
        the slowest point, f goes to 0 at rest."""
        given = {"speed": speed, "temperature": temperature, "pressure": pressure}
        for name, (low, high) in self.ranges.items():
            if given[name] is None:
                given[name] = 0.5 * (low + high)
            values = validate.real_array(name, given[name], SYMBOLS[name][1])
            given[name] = values
            if name == "speed":
                low = 0.0
                values = np.abs(values)
            outside = values[(values < low * (1 - ROUNDED)) | (values > high * (1 + ROUNDED))]
            if outside.size and not extrapolate:
                unit = SYMBOLS[name][1]
                way = "solve a wider range (lubfric.study(...).law()), or pass extrapolate=True"
                raise InputError(f" = {outside[0]:.6g} {unit}", name, f"{low:.6g} to {high:.6g} {unit}", way)
        return value(self.numbers, *given.values())

    @property
    def error_in_words(self) -> str:
        """How far the formula deviates from the curves to which it is fitted, and how well their points are known, as
        text."""
        of_points = (
            f"whose points have 95 % intervals of up to {percent(self.interval)} (model-form error included)"
            if np.isfinite(self.interval)
            else "whose points have errors that are not known"
        )
        return (
            f"{percent_or_less(self.rms)} (rms) and at most {percent_or_less(self.largest)} from the solved curves, "
            f"{of_points}"
        )

    @property
    def warning(self) -> str:
        """Why the formula should not be used, where it deviates by more than `LARGEST_OF_LAW`; else ""."""
        if self.largest <= LARGEST_OF_LAW:
            return ""
        return (
            f"warning: the formula deviates by up to {percent(self.largest)} from the solved curves, above "
            f"{100 * LARGEST_OF_LAW:g} %. Recommendation: interpolate the table of the curve"
        )

    @property
    def text(self) -> str:
        """The formula, its numbers, range and error."""
        (low, high), T, p = self.ranges.values()
        return "\n".join(
            [
                f"friction of {self.name} over U (m/s), T (K), mean Hertz pressure p (Pa)",
                *([f"  {self.warning}"] if self.warning else []),
                *(f"  {name} = {expression}" for name, expression in _expressions(self.numbers).items()),
                "  with " + ", ".join(f"{name} = {number:.6g}" for name, number in self.numbers.items()),
                f"  {self.error_in_words}",
                f"  for |U| up to {high:.4g} m/s, slower than {low:.4g} m/s continued to 0 at rest; "
                f"{_range('T', T, 'K')}; {_range('p', p, 'Pa')}",
            ]
        )

    @property
    def json(self) -> str:
        """All of it as JSON, with units; ``formula`` is to be computed line by line."""
        units = {name: unit for name, unit in SYMBOLS.values()}
        return json.dumps(
            plain(asdict(self) | {"warning": self.warning, "formula": _expressions(self.numbers), "units": units}),
            indent=1,
        )

    @property
    def c(self) -> str:
        """A C function ``double friction(double U, double T, double p, int *outside)``: ``outside`` (may be NULL)
        becomes the sum of 1, 2, 4 where |U| is too large, T or p out of range, and f an extrapolation."""
        comment = "\n".join(f" * {line}" for line in self.text.replace("*/", "* /").splitlines())
        numbers = "".join(f"    const double {name} = {float(number)!r};\n" for name, number in self.numbers.items())
        lines = "".join(f"    const double {name} = {code};\n" for name, code in _expressions(self.numbers).items())
        (_, top), *others = self.ranges.values()
        top *= 1 + ROUNDED
        bits = [f"(U > {top!r} || U < {-top!r})"]
        for bit, symbol, (low, high) in zip((2, 4), "Tp", others):
            if low == low:  # known
                bits.append(f"{bit}*({symbol} < {low * (1 - ROUNDED)!r} || {symbol} > {high * (1 + ROUNDED)!r})")
        head = "double friction(double U, double T, double p, int *outside)"
        range_check = f"    (void)T;\n    if (outside)\n        *outside = {' + '.join(bits)};\n"
        return f"/*\n{comment}\n */\n#include <math.h>\n\n{head}\n{{\n{numbers}{range_check}{lines}    return f;\n}}\n"

    def _facts(self) -> dict[str, str]:
        return {"": self.name, "rms": percent_or_less(self.rms), "largest": percent_or_less(self.largest)}


def _range(symbol: str, ends: tuple[float, float], unit: str) -> str:
    low, high = ends
    if low != low:
        return f"{symbol} is not given and changes nothing"
    return f"at {symbol} = {low:.5g} {unit} only" if low == high else f"{symbol} from {low:.5g} to {high:.5g} {unit}"


def conditions_of(scene: Scene) -> tuple[float, float, float, float]:
    """Return what a law knows of a scene: temperature of the oil [K], its viscosity there [Pa s], -d ln(viscosity)/dT
    [1/K], mean Hertz pressure [Pa]; NaN where not known."""
    oil = scene.lubricant
    temperature, slope = (np.nan if v is None else v for v in (oil.temperature, oil.temperature_coefficient))
    return temperature, oil.viscosity, slope, scene.bodies.mean_hertz_pressure


def value(numbers: Mapping[str, float], U: Any, T: Any, p: Any) -> Any:
    """Return f by the formula."""
    names: dict[str, Any] = {**numbers, "U": U, "T": T, "p": p}
    with np.errstate(over="ignore", under="ignore", divide="ignore"):
        for name, expression in _expressions(numbers).items():
            names[name] = eval(CODE[expression], FUNCTIONS, names)
    return names["f"]


def _expressions(numbers: Mapping[str, float]) -> dict[str, str]:
    return {"eta": WALTHER if "A" in numbers else "eta0"} | LAW_FORMULA


def law_of(
    scene: Scene,
    curves: Iterable[tuple[Any, Interpolant]],
    f: FloatArray,
    low: FloatArray,
    high: FloatArray,
    model: FloatArray,
) -> Law:
    """Return the `Law` of solved curves of ``scene`` with their conditions (`conditions_of`). ``f``, ``low``, ``high``,
    ``model``: of all points, arrays with their intervals, and their errors by the model. Raises `InputError` where
    there are too few points, f is not positive, or the numerical error of a point is above `LARGE_NUMERICAL_ERROR`."""
    rows = [np.zeros((7, 0))]
    for known, curve in curves:
        _check_numerical_errors(curve)
        solved = curve.samples.speed
        fine = np.geomspace(solved[0], solved[-1], FITTED_SPEEDS)
        fine = np.append(solved, fine[curve.error(fine) < USABLE_ERROR])
        rows.append(np.array(np.broadcast_arrays(fine, *known, curve.boundary(fine), curve.film(fine))))
    U, T, eta, slope, p, boundary, film = np.concatenate(rows, axis=1)
    if U.size < FEWEST_POINTS:
        raise InputError(
            f"a law needs {FEWEST_POINTS} points known within {USABLE_ERROR:.0%}, and has {U.size}; {MORE_SPEEDS}"
        )
    if not (boundary + film > 0).all():
        raise InputError("a law needs f above 0 at all speeds; give a slide-roll ratio that is not near 0")
    numbers = {"u0": REST_SPEED_RATIO * U.min()}
    numbers |= {name: float(np.exp(np.log(v).mean())) for name, v in (("U0", U), ("eta0", eta), ("p0", p))}
    numbers |= _viscosity(T, eta, slope)
    sliding = scene.motion.slide_roll_ratio * U
    at_rest = max(scene.bodies.boundary_friction(*place) for place in zip(sliding.tolist(), T.tolist()))
    numbers |= _fitted(numbers, (U, T, p), boundary, film, eta, at_rest)
    deviations = value(numbers, U, T, p) / (boundary + film) - 1
    ranges = {n: (float(v.min()), float(v.max())) for n, v in (("speed", U), ("temperature", T), ("pressure", p))}
    sides = np.where(np.isfinite(model), np.maximum(high - f, f - low) / np.abs(f), np.nan)[np.isfinite(f)]
    return Law(
        name=scene.name,
        numbers=numbers,
        ranges=ranges,
        largest=float(abs(deviations).max()),
        rms=float(np.sqrt(np.mean(deviations**2))),
        interval=float(sides.max()),
    )


def _check_numerical_errors(curve: Interpolant) -> None:
    """Raise `InputError` where the numerical error of a point of a ``curve`` is large."""
    s = curve.samples
    worst = int(np.argmax(s.numerical))
    if s.numerical[worst] > LARGE_NUMERICAL_ERROR:
        raise InputError(
            f"the numerical error of f at {s.speed[worst]:.4g} m/s is {percent(float(s.numerical[worst]))}, and a "
            f"formula needs at most {percent(LARGE_NUMERICAL_ERROR)}",
            recommendation="see the warnings of that point, or omit its speed",
        )


def law_of_study(result: Any) -> Law:
    """Return the friction of a study over speed and, as far as they were varied, temperature of the oil and load, as a
    formula for system simulations (`lubfric.studies.law`). Raises `InputError` where anything else was varied."""
    others = [key for axis in result.plan.axes for key in axis.keys if key not in VARIED]
    if others:
        raise InputError(
            f"a law is over speed, temperature and load; this study varies {', '.join(others)} as well",
            recommendation=LAW_OVER_OTHERS,
        )
    if result.paired:
        raise InputError("a law is over speed; this study has operating points: give speeds instead of points")
    curves_of_study = [result.curve(index) for index in np.ndindex(*result.status.shape[:-1])]
    scenes = result.plan.scenes
    curves = [(conditions_of(scene), curve) for scene, curve in zip(scenes, curves_of_study) if curve is not None]
    columns = (result[name] for name in ("coefficient", "interval_low", "interval_high", "model_error"))
    return law_of(result.plan.scene, curves, *columns)


def _viscosity(T: FloatArray, eta: FloatArray, coefficient: FloatArray) -> dict[str, float]:
    """Return a and B of `WALTHER` through the viscosities, or through one with its slope; none without a temperature,
    or where at a single one the fluid is too thin for it."""
    thin = eta.min() <= LEAST_VISCOSITY
    if not np.isfinite(T).all() or thin and np.ptp(T) == 0:
        return {}
    if thin:
        allowed = f"above {LEAST_VISCOSITY:g} Pa s, or one temperature"
        message = f" = {eta.min():.3g} Pa s is too thin for a law over temperature"
        raise InputError(message, "lubricant.viscosity", allowed)
    x = np.log10(T)
    y = np.log10(np.log10(1e3 * eta + 0.7))
    if np.ptp(T) > 0:
        slope = np.polyfit(x, y, 1)[0]
    else:
        inner = 1e3 * eta[0] + 0.7
        slope = -np.nan_to_num(coefficient[0]) * T[0] * 1e3 * eta[0] / inner / np.log(inner)
    return {"A": float(np.mean(y - slope * x)), "B": float(-slope)}


def _fitted(
    numbers: dict[str, float],
    at: tuple[FloatArray, FloatArray, FloatArray],
    boundary: FloatArray,
    film: FloatArray,
    eta: FloatArray,
    at_rest: float,
) -> dict[str, float]:
    """Return the other numbers, by least squares of ln f from several starts."""
    from scipy.optimize import least_squares

    (U, T, p) = at
    f = boundary + film
    most = float(boundary.max())
    e = np.log(eta / numbers["eta0"])
    q = np.log(p / numbers["p0"])
    middle = float((U * np.exp(e))[abs(boundary - 0.5 * most).argmin()])
    start = START_PARAMETERS | {"b": most or 1.0, "C1": float(np.median(f)), "U1": middle if most else 1e-12}
    free = (*(LOAD_RATIO_PARAMETERS if most else ()), *FILM_PARAMETERS)
    for exponents, moved in ((("a", "e1", "e2"), e), (("c", "d1", "d2"), q)):
        if np.ptp(moved) > 1e-9:
            free += exponents if most else exponents[1:]
    bounds = POSITIVE | {"b": (POSITIVE["b"][0], OVER_REST * max(most, at_rest))}
    low, high = np.array([np.log(bounds[name]) if name in bounds else EXPONENT_BOUNDS for name in free]).T

    def read(z: FloatArray) -> dict[str, float]:
        return numbers | start | {n: float(np.exp(v) if n in POSITIVE else v) for n, v in zip(free, z)}

    def left(z: FloatArray) -> FloatArray:
        return np.log(np.maximum(value(read(z), U, T, p), 1e-9) / f)

    solution = []
    for bend, steep in ((0.1, 1.0), (0.1, 2.0), (0.5, 1.0), (0.5, 2.0)):
        tried = start | {"k1": bend, "k2": -bend, "C2": 3 * start["C1"], "n": steep}
        z = np.clip([np.log(tried[n]) if n in POSITIVE else tried[n] for n in free], low + 1e-6, high - 1e-6)
        solution.append(least_squares(left, z, bounds=(low, high), max_nfev=150, ftol=1e-6, xtol=1e-6))
    return read(min(solution, key=lambda one: one.cost).x)
