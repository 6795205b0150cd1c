"""Traction curves: friction over the slide-roll ratio at one entrainment speed."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .._base import validate
from ..errors import LubfricError, Report
from ..sampling import FrictionResult, UncertaintyCurve, curve_of, friction
from ..scene import FASTEST, LARGEST_RATIO, Scene, check_resolved_gap, resolves_gap
from ..sharing import Prepared, at_tolerance, prepare, scene_of
from .sweep_points import CurveResult, Swept, columns_of, judged, report_of


@dataclass(frozen=True, repr=False)
class TractionResult(CurveResult):
    """Friction over the slide-roll ratio, in the order asked for; NaN where a point failed.

    Attributes
    ----------
    ratio : slide-roll ratios [-], (n,)
    speed : entrainment speed [m/s]
    columns : every number of `FrictionResult` by name, each (n,). ``result["contact_load"]`` gives one of them
    points : the results, without fields (None where failed)
    errors : {index: exception}
    report : the largest residual of the points over its tolerance
    """

    ratio: np.ndarray
    speed: float
    columns: dict[str, np.ndarray]
    points: tuple[FrictionResult | None, ...]
    errors: dict[int, Exception]
    report: Report

    def __getitem__(self, name: str) -> np.ndarray:
        return self.columns[validate.choice("column", name, tuple(self.columns))]

    @property
    def coefficient(self) -> np.ndarray:
        """Friction coefficient [-]."""
        return self.columns["coefficient"]

    @property
    def uncertainty(self) -> UncertaintyCurve:
        """How sure f is at every ratio: arrays of the numbers of `Uncertainty`, ``interval`` (n, 2)."""
        return curve_of([None if point is None else point.uncertainty for point in self.points])

    @property
    def _swept(self) -> Swept:
        return _over(self.ratio)


def traction(
    scene: Scene | Prepared,
    ratios,
    *,
    speed: float | None = None,
    tolerance: float | None = None,
    model: str | None = None,
    on_point=None,
    raise_on_failure: bool = True,
) -> TractionResult:
    """The traction curve of a scene: friction over the slide-roll ratio, at one entrainment speed.

    The ratio changes the shear of the film, its heat, and the heat of the inlet. Otherwise film and contact stay the
    same, so each point starts from the one before. A point that fails leaves NaN, and its exception in ``errors``; the
    others are still solved.

    Parameters
    ----------
    scene : from `lubfric.load_scene` or `lubfric.prepare`
    ratios : slide-roll ratios (u2 - u1)/U [-], (n,)
    speed : entrainment speed [m/s]; None: the scene's own
    tolerance, model : as in `lubfric.friction`
    on_point : called as on_point(done, total, ratio, outcome) as points end
    raise_on_failure : False returns a curve with failed points

    Returns
    -------
    TractionResult

    Raises
    ------
    InputError : before any work
    ConvergenceError : at the end, if a point failed; the whole curve is its ``result``
    ValidityError : the same, if all points that failed were refused as invalid
    """
    ratios = validate.numbers("ratios", ratios, "(slide-roll ratio)", LARGEST_RATIO)
    own = scene_of(scene).motion.entrainment_speed
    speed = own if speed is None else validate.number("speed", speed, "m/s", minimum=-FASTEST, maximum=FASTEST)
    prepared = at_tolerance(scene, tolerance, model)
    scenes = [prepared.scene.with_(motion={"slide_roll_ratio": ratio}) for ratio in ratios.tolist()]
    for asked in scenes if resolves_gap(prepared.scene) else ():
        check_resolved_gap(asked)
    points: list[FrictionResult | None] = [None] * ratios.size
    errors: dict[int, Exception] = {}
    start = None
    for done, i in enumerate(np.argsort(np.abs(ratios), kind="stable"), start=1):
        try:
            found = friction(prepare(scenes[i], like=prepared), speed, start=start)
        except LubfricError as error:
            errors[int(i)] = error
        else:
            start = found if found.starts else None
            points[i] = found.without_fields()
        if on_point:
            on_point(done, ratios.size, float(ratios[i]), points[i] or errors[int(i)])
    report = report_of("traction", "slide-roll ratio {:g}", _over(ratios), points, errors)
    result = TractionResult(ratios, float(speed), columns_of(points), tuple(points), errors, report)
    return judged(result, raise_on_failure)


def _over(ratios: np.ndarray) -> Swept:
    return Swept("S", ratios, "(slide-roll ratio)", "ratios")
