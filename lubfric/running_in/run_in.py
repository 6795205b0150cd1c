"""The surface after the contact has passed over it: dents, and wear of its asperities, `run_in`.

First the dry cylinder moves along the map, step by step, and pass by pass, until no cell sinks any more
(`lubfric.contact.dent_by_pass`). Then the asperities that still carry load wear (`lubfric.running_in.wear`).
"""

import math
from collections.abc import Callable, Iterator
from contextlib import nullcontext
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from .._base import FrozenArrays, Shown, figures, limited_work, table_bytes, validate, with_default_errors, write_whole
from .._base.progress import progress_to, report_progress
from ..contact import dent_by_pass, operator_under
from ..errors import InputError, WorkLimitError
from ..estimate import cited, dry_contact_to_quote, grid_to_quote, lubricated_contact_to_quote, roughness_to_quote
from ..models import AUTO, MODELS, model_named
from ..models.load_sharing import flattening
from ..quantities import counted
from ..samples import contact_maps, cylinder_of, is_measured, whole_maps
from ..scene import Scene
from ..surface import Surface, rms_slope
from ..units import converted, plain_number, printed, unit_for, worded
from .wear import NM, Wear, estimated_wear, worn_in

if TYPE_CHECKING:
    from matplotlib.axes import Axes

# Positions of the contact within a half-width of the Hertz strip: an asperity misses 3 % of the highest pressure. A
# choice: √(1 - 1/16) is .97.
STEPS_OF_HALF_WIDTH = 2.0
# Tolerance of the dry contact [-], at most: its overlaps become heights. A choice: a smaller value takes more
# iterations.
PASS_TOLERANCE = 1e-5
# Processor seconds of an iteration of a contact of a pass, whatever its cells, and over its cells. These and the next
# three are fitted to the counted work of 38 runs of `python -m verification.campaigns.estimates`; their time is .8 to
# 2.3 times as long, 1.25 times in the median.
ITERATION_SECONDS = 1.75e-4
ITERATION_CELL_SECONDS = 2.2e-8

# Iterations of such a contact between bodies that do not flatten [-]; 8 to 55 in all, by a power of one plus the
# flattening over the Hertz strip in Sq, within a fifth. Measured.
CONTACT_ITERATIONS = 9.4
ITERATIONS_BY_FLATTENING = 0.32

# Passes beyond the first until nothing sinks, over E' times a quarter of the rms slope, the scale of the asperity
# pressures (`solved_ends_of_hardness`), over the hardness [-]: none at .25, two at .7, five at 2.3.
PASSES_BY_YIELDING = 2.2

# Parameters of a map in the table of a running-in, and their units.
OF_MAP = {"sq": "m", "sk": "m", "spk": "m", "svk": "m"}
# Numbers of wear in that table, and their units.
OF_WEAR = {
    "distance": "m",
    "depth": "m",
    "volume": "m3",
    "counterface_volume": "m3",
    "asperity_load_ratio": "-",
    "coefficient": "-",
    "interval": "-",
    "lift_off_speed": "m/s",
    "lift_off_interval": "m/s",
}


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class RunIn(FrozenArrays, Shown):
    """A surface before and after it has run in, from `run_in`.

    Attributes
    ----------
    before, surface : the map before and after, on the same grid; ``sq``, ``ssk``, ``sk``, ``spk``, ``svk`` of each
        state what has changed
    dented : the map after the dents, before wear
    deepest : deepest new dent of each pass [m], (passes,)
    sinking : share of the cells that sank by more than the tolerance in each pass [-], (passes,)
    shaken_down : True: nothing sank by more than the tolerance in the last pass. False: asperities still yield, and
        would in further passes
    ends : the map after at the lowest and the highest hardness, where that is known to a range only; () else
    wear : what wear changed over the distance, a `Wear`; None without wear
    inputs : what has run in, and how, in texts with units
    """

    before: Surface
    surface: Surface
    dented: Surface
    deepest: np.ndarray
    sinking: np.ndarray
    shaken_down: bool
    ends: tuple[Surface, ...] = ()
    wear: Wear | None = None
    inputs: tuple[str, ...] = ()

    @property
    def dents(self) -> np.ndarray:
        """Depth of the dents [m], without wear, (nx, ny)."""
        return self.before.heights - self.dented.heights

    def cite(self, format: str = "text") -> str:
        """Return the publications of the contact that dents the surface and, with wear, of the law of wear and of the
        asperity pressure: one a line, or with ``format`` "bibtex" as BibTeX entries, or "methods" as a paragraph with
        the ``inputs``."""
        methods = ("half-space contact", *(("wear", "load sharing") if self.wear is not None else ()))
        return cited(methods, format, inputs=self.inputs, what="Running-in of the surface")

    def bearing(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return the bearing (Abbott-Firestone) curves: the share of the area that is higher [-], and the heights [m]
        before and after, about the mean before."""
        before, after = (np.sort(surface.heights, axis=None)[::-1] for surface in (self.before, self.surface))
        level = before.mean()
        return (np.arange(before.size) + 0.5) / before.size, before - level, after - level

    def columns(self) -> dict[str, np.ndarray | list[str]]:
        """Return the table of the running-in by headings with units: the map before, after the dents, and at each
        recorded distance of wear. A number that a row does not have is NaN."""
        maps = {"before": self.before, "after the dents": self.dented}
        states = [*maps, *([] if self.wear is None else ["wear"] * self.wear.distance.size)]
        table: dict[str, np.ndarray | list[str]] = {"state": states}
        for name, unit in OF_MAP.items():
            of_maps = [float(_parameter(surface, name)) for surface in maps.values()]
            of_wear = [] if self.wear is None else getattr(self.wear, name).tolist()
            table[f"{name} [{unit}]"] = np.array([*of_maps, *of_wear])
        for name, unit in (OF_WEAR if self.wear is not None else {}).items():
            column = getattr(self.wear, name)
            for end, values in zip(("",) if column.ndim == 1 else ("_low", "_high"), np.atleast_2d(column.T)):
                table[f"{name}{end} [{unit}]"] = np.concatenate([[math.nan, math.nan], values])
        return table

    def to_csv(self, path: str | Path) -> None:
        """Write the table of `columns`."""
        write_whole(path, table_bytes(self.columns()))

    def plot(self, ax: "Axes | None" = None) -> "Axes":
        """Draw the bearing curves before and after, on ``ax`` or new axes, which are returned."""
        axes = figures.axes_or_new(ax)
        (share, *heights) = self.bearing()
        unit = unit_for([self.before.sq], "m")
        for z, colour, label in zip(heights, (figures.GREY, figures.BLUE), ("before running-in", "after running-in")):
            axes.plot(100 * share, converted(z, "m", unit), color=colour, label=label)
        axes.set(xlim=(0, 100), xlabel="bearing area (%)", ylabel=f"height ({printed(unit)})")
        figures.key_above(axes)
        return axes

    def _facts(self) -> dict[str, str]:
        old = self.before
        new = self.surface
        skewness = f"{old.ssk:.3g} to {new.ssk:.3g}" if old.sq > 0 and new.sq > 0 else "none"
        low, high = (surface.sq * NM for surface in self.ends or (new, new))
        span = f" ({low:.4g} to {high:.4g} nm by the range of the hardness)" if self.ends else ""
        end = "shaken down" if self.shaken_down else f"still yielding, by {self.deepest[-1] * NM:.3g} nm"
        return {
            "Sq": f"{old.sq * NM:.4g} to {new.sq * NM:.4g} nm{span}",
            "Ssk": skewness,
            "dented": f"{100 * np.count_nonzero(self.dents) / self.dents.size:.3g} %",
            "": f"{end} after {counted(self.deepest.size, 'passes')}",
        } | (
            {}
            if self.wear is None
            else {"worn": f"{self.wear.depth[-1] * NM:.4g} nm over {self.wear.distance[-1]:.4g} m"}
        )


@with_default_errors
def run_in(
    scene: Scene,
    surface: Surface | None = None,
    *,
    passes: int = 30,
    tolerance: float = 1e-10,
    step: float | None = None,
    distance: float = 0.0,
    wear_coefficient: float = 0.0,
    hardness: tuple[float, float] | None = None,
    on_progress: Callable[[str, int, int], None] | None = None,
) -> RunIn:
    """Let the loaded cylinder of ``scene`` pass over its rough surface until that has run in.

    First its summits yield. The cylinder carries ``bodies.load`` without a film. The map passes under it step by step,
    its end at the largest x first if the entrainment speed is positive. Cells at ``bodies.hardness`` are lowered by
    their overlap. The map continues beyond its ends: onto itself if it is periodic along x, else by its mirror image.

    Then, with a ``distance`` and a ``wear_coefficient``, the asperities wear while the surface slides in its
    lubricated contact at the speed of the scene. Each point in asperity contact loses the height K p s/H (J. F.
    Archard, J. Appl. Phys. 24 (1953) 981-988, doi:10.1063/1.1721448, V = K F s/H), p the asperity pressure of the
    load-sharing model. Film and contact are solved again at every step. Wear ends where the asperities carry less than
    0.1 % of the load. The complete map wears evenly, as a body whose every point passes through the contact does. Films
    from additives, third bodies, residual stress and hardening are not modelled.

    Parameters
    ----------
    scene : from `lubfric.load_scene`, with ``bodies.hardness`` and one rough body
    surface : the map to run in, taken as periodic along y; None: the complete map of the scene, on its own cells
    passes : number of passes after which the run-in ends, even if asperities still yield
    tolerance : depth [m]. The first pass without a deeper new dent ends it, and is not kept. The default is a third of
        an atom
    step : of the contact [m], between one cell and the half-width of the Hertz strip (None: half of that)
    distance : sliding s [m] that each surface point does inside the contact, after the dents; 0: no wear
    wear_coefficient : K [-] of Archard's law, 0 to 1 (mixed lubrication with additives: about 1e-8 to 1e-6)
    hardness : H [Pa] of the rough body and of the other one, for wear; None: ``bodies.hardness`` for both
    on_progress : called as on_progress(what, done, total) after each pass, and after each step of wear

    Returns
    -------
    RunIn : the map before and after, and at both ends of a hardness that is given as a range. `lubfric.prepare` takes
        ``surface`` of it as any other map. ``wear`` has Sq, Sk, Spk, Svk, worn volume, friction and lift-off speed over
        the distance

    Raises
    ------
    InputError : a scene without hardness, or with two rough bodies and no ``surface``; a value out of range; wear
        without sliding, or by a model without asperity pressures
    ConvergenceError : a contact or a balance that could not be solved; or (`lubfric.errors.WorkLimitError`) the run
        needs more counted work than ``numerics.max_work``: its ``result`` is the `RunIn` so far
    """
    validate.called_back("on_progress", on_progress, "what, done, total")
    options = _Options(
        passes=passes,
        tolerance=tolerance,
        step=step,
        distance=distance,
        wear_coefficient=wear_coefficient,
        hardness=hardness,
    )
    with nullcontext() if on_progress is None else progress_to(on_progress):
        return _run_in(scene, surface, options)


@dataclass(frozen=True, kw_only=True)
class _Options:
    """How a map is run in: arguments of `run_in`."""

    passes: int
    tolerance: float
    step: float | None
    distance: float
    wear_coefficient: float
    hardness: tuple[float, float] | None


def _run_in(scene: Scene, surface: Surface | None, options: _Options) -> RunIn:
    """Return `run_in` of the ``scene``, and at both ends of its hardness where that is a range."""
    validate.instance("scene", scene, Scene, "what lubfric.load_scene returned")
    wear_of = _checked_wear(scene, options.distance, options.wear_coefficient, options.hardness)
    passes = validate.integer("passes", options.passes, minimum=1, maximum=10_000)
    tolerance = validate.positive("tolerance", options.tolerance, "m", minimum=1e-15, maximum=1e-3)
    before = _whole(scene, surface)
    limit = scene.numerics.max_work or math.inf
    others = [pair for name, *pair in scene.at_ends() if name == "bodies.hardness"]
    centres = _way(scene, before, options.step)
    done = _Passes(heights=before.heights)
    wear = None
    ends: tuple[Surface, ...] = ()
    ended = ""
    try:
        with limited_work(limit):
            for done in _passes(scene, before, centres, passes, tolerance):
                pass
            dented = _run_in_map(scene, before, done)
            after = dented
            if wear_of["distance"] > 0 and wear_of["coefficient"] > 0:
                after, wear, ended = worn_in(scene, dented, **wear_of)
            if not ended:
                ends = tuple(_run_in(other, before, options).surface for pair in others for other in pair)
    except WorkLimitError:
        after = _run_in_map(scene, before, done)
        dented = after
        ended = f"{len(done.deepest)} of at most {passes} passes are done"
    result = RunIn(
        before=before,
        surface=after,
        dented=dented,
        deepest=np.array(done.deepest),
        sinking=np.array(done.sinking),
        shaken_down=done.shaken_down,
        ends=ends,
        wear=wear,
        inputs=(
            *roughness_to_quote(scene, has_given_map=surface is not None),
            *grid_to_quote(scene, [before]),
            *dry_contact_to_quote(replace(scene, transient=None)),
            *_passes_in_words(before, centres, len(done.deepest), tolerance),
            *(() if wear is None else _wear_in_words(replace(scene, transient=None), wear, wear_of)),
        ),
    )
    if ended:
        raise WorkLimitError(limit, result=result, reached=f"Until then {ended}; .result of this error contains them")
    return result


def _passes_in_words(before: Surface, centres: np.ndarray, passes: int, tolerance: float) -> Iterator[str]:
    """Yield how the contact passed over the map ``before``: so many ``passes`` above the columns ``centres``."""
    step = float(np.abs(np.diff(centres)).max(initial=0)) * before.spacing[0]
    yield f"{counted(passes, 'passes')} in steps of {worded(step, 'm')} at most"
    yield f"end of the passes where no cell sinks by more than {worded(tolerance, 'm')}"


def _wear_in_words(scene: Scene, wear: Wear, wear_of: dict[str, Any]) -> Iterator[str]:
    """Yield the inputs of ``wear``; ``wear_of``: as of `_checked_wear`."""
    yield from lubricated_contact_to_quote(scene)
    yield f"entrainment speed {worded(scene.motion.entrainment_speed, 'm/s')}"
    yield f"sliding distance {worded(wear_of['distance'], 'm')}"
    yield f"wear coefficient {plain_number(wear_of['coefficient'])}"
    of_rough, of_other = (worded(hardness, "Pa") for hardness in wear_of["hardness"])
    yield f"hardness {of_rough} of the rough body and {of_other} of the other one in the law of wear"
    yield f"{counted(wear.steps, 'steps')} of wear"


@dataclass(frozen=True, kw_only=True)
class _Passes:
    """The passes that are done: ``heights`` [m] after them, the other attributes as in `RunIn`."""

    heights: np.ndarray
    deepest: tuple[float, ...] = ()
    sinking: tuple[float, ...] = ()
    shaken_down: bool = False


def _passes(scene: Scene, before: Surface, centres: np.ndarray, passes: int, tolerance: float) -> Iterator[_Passes]:
    """Yield what is done after each of at most so many ``passes`` of the dry cylinder, until nothing sinks by more than
    the ``tolerance`` [m]. That last pass does not count as a change of the map."""
    cylinder = cylinder_of(scene)
    operator = operator_under(before.heights, before.spacing, cylinder, scene.numerics.workers)
    sharp = min(PASS_TOLERANCE, scene.numerics.tolerance_of("contact"))
    done = _Passes(heights=before.heights)
    while len(done.deepest) < passes and not done.shaken_down:
        lowered, depth = dent_by_pass(
            done.heights, cylinder, centres, operator, periodic=before.periodic_axes[0], tolerance=sharp
        )
        sinking = np.count_nonzero(lowered < done.heights - tolerance) / lowered.size
        shaken = depth <= tolerance
        done = _Passes(
            heights=done.heights if shaken else lowered,
            deepest=(*done.deepest, depth),
            sinking=(*done.sinking, sinking),
            shaken_down=shaken,
        )
        report_progress("pass", len(done.deepest), passes)
        yield done


def _parameter(surface: Surface, name: str) -> float:
    """Return Sq, Sk, Spk or Svk [m] of a map."""
    return surface.sq if name == "sq" else getattr(surface.bearing(), name)


def _run_in_map(scene: Scene, before: Surface, done: _Passes) -> Surface:
    """Return the map after the passes, with a note of them."""
    note = f"run in: {len(done.deepest)} passes under {scene.bodies.load:g} N, hardness {scene.bodies.hardness:g} Pa"
    if done.deepest and not done.shaken_down:
        note += f"; still yielding, by {done.deepest[-1]:.3g} m"
    return replace(before, heights=done.heights, notes=(*before.notes, note))


def _checked_wear(scene: Scene, distance: Any, coefficient: Any, hardness: Any) -> dict[str, Any]:
    """Return distance [m], coefficient [-] and hardness [Pa] of the wear, checked."""
    distance = validate.nonnegative("distance", distance, "m", maximum=1e9)
    coefficient = validate.number("wear_coefficient", coefficient, "(-)", minimum=0.0, maximum=1.0)
    if hardness is None:
        hardness = (scene.bodies.hardness, scene.bodies.hardness)
    elif not isinstance(hardness, (list, tuple)) or len(hardness) != 2:
        raise InputError(
            f" = {validate.shown(hardness)}", "hardness", "a pair in Pa: of the rough body, of the other one"
        )
    else:
        hardness = tuple(validate.number("hardness", value, "Pa", minimum=1.0, maximum=1e14) for value in hardness)
    if distance > 0 and coefficient > 0:
        if scene.motion.slide_roll_ratio == 0:
            message = " = 0: in pure rolling no surface point slides, and nothing wears by Archard's law"
            raise InputError(message, "motion.slide_roll_ratio", "a value other than 0, or omit distance")
        if scene.motion.entrainment_speed == 0:
            message = " = 0 m/s: wear needs the film at the speed of the running-in"
            raise InputError(message, "motion.entrainment_speed", "a speed other than 0 m/s")
        if scene.contact.model != "half-space":
            message = f" = {scene.contact.model!r} has no asperity pressure on the cells of the map"
            raise InputError(message, "contact.model", "'half-space' for wear")
        model = scene.numerics.model
        if model != AUTO and not model_named(model).takes_wear:
            message = f" = {model!r}: wear takes its asperity pressure from the load-sharing model"
            takers = " or ".join(repr(name) for name in (AUTO, *(one.name for one in MODELS if one.takes_wear)))
            raise InputError(message, "numerics.model", f"{takers} for wear")
    return {"distance": distance, "coefficient": coefficient, "hardness": hardness}


def _whole(scene: Scene, surface: Surface | None) -> Surface:
    """Return the map to run in, checked."""
    if scene.bodies.hardness is None:
        message = " is not given: an elastic contact does not yield, so its surface does not run in"
        raise InputError(message, "bodies.hardness", "1 to 1e14 Pa (hardened steel: about 6e9 to 8e9 Pa)")
    if surface is None:
        if scene.counterface is not None:
            raise InputError(
                "counterface: dents of two rough bodies that pass each other are not those of their sum; run in one "
                "body against a smooth one (a scene without counterface), or give a map as surface"
            )
        surface = whole_maps(scene)[0]
        if is_measured(scene):
            spacing = scene.contact.spacing
            surface = surface if spacing is None else surface.resampled(spacing=spacing)
            surface = surface.periodic(axes=(scene.contact.geometry == "flat", True))
    validate.instance("surface", surface, Surface, "a lubfric.Surface")
    surface = contact_maps(scene, (surface,))[0]
    half_width = scene.bodies.half_width
    if surface.spacing[0] > half_width:
        raise InputError(
            f"spacing of the map = {surface.spacing[0]:.3g} m along x does not resolve the Hertz strip; allowed: at "
            f"most its half-width {half_width:.3g} m"
        )
    return surface


def _way(scene: Scene, surface: Surface, step: float | None) -> np.ndarray:
    """Return the columns of the map above which the cylinder is, one after the other, about ``step`` [m] apart."""
    half_width = scene.bodies.half_width
    dx = surface.spacing[0]
    last = surface.shape[0] - 1
    if step is None:
        step = max(dx, half_width / STEPS_OF_HALF_WIDTH)
    columns = round(validate.number("step", step, "m", minimum=dx * (1 - 1e-9), maximum=half_width) / dx)
    centres = np.linspace(0, last, 1 + math.ceil(last / columns)).round().astype(int)
    return centres[:: -1 if scene.motion.entrainment_speed > 0 else 1]


def estimated_run_in(scene: Scene, *, distance: float = 0.0, wear_coefficient: float = 0.0) -> float:
    """Return the estimated processor seconds of `run_in`; arguments as there. The map is made, and nothing is
    solved."""
    wear_of = _checked_wear(scene, distance, wear_coefficient, None)
    before = _whole(scene, None)
    assert scene.bodies.hardness is not None  # `_whole` refuses a scene without
    operator = operator_under(before.heights, before.spacing, cylinder_of(scene), scene.numerics.workers)
    ends = 1 + 2 * sum(name == "bodies.hardness" for name, *_ in scene.ranges)
    iterations = CONTACT_ITERATIONS * (1 + flattening(scene, max(before.sq, 1e-12))) ** ITERATIONS_BY_FLATTENING
    solve = iterations * (ITERATION_SECONDS + ITERATION_CELL_SECONDS * math.prod(operator.shape))
    yielding = float(scene.bodies.e_prime * rms_slope(before)[2] / 4 / scene.bodies.hardness)
    passes = 1 + PASSES_BY_YIELDING * yielding
    seconds = passes * len(_way(scene, before, None)) * solve
    if wear_of["distance"] > 0 and wear_of["coefficient"] > 0:
        hardness = wear_of["hardness"][0]
        seconds += estimated_wear(scene, before, wear_of["distance"], wear_of["coefficient"], hardness)
    return float(ends * seconds)
