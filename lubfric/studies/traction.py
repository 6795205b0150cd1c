"""Traction curves: friction over the slide-roll ratio at one entrainment speed."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .._base import validate
from ..errors import LubfricError, Report
from ..sampling import FrictionResult, friction
from ..scene import FASTEST, LARGEST_RATIO, Scene
from ..sharing import Prepared, prepare
from .curve import CurveResult, judged, report_of
from .points import made_ready


@dataclass(frozen=True, repr=False)
class TractionResult(CurveResult):
    """Friction over the slide-roll ratio, in the order asked for; NaN where a point failed.

    Attributes
    ----------
    ratio : slide-roll ratios [-], (n,)
    speed : entrainment speed [m/s]
    points : the results, without fields (None where failed). ``result["contact_load"]`` gives one of their numbers
    errors : {index: exception}
    report : the largest residual of the points over its tolerance
    """

    SWEPT = "ratio", "S", "(slide-roll ratio)", "ratios"

    ratio: np.ndarray
    speed: float
    points: tuple[FrictionResult | None, ...]
    errors: dict[int, Exception]
    report: Report

    @property
    def coefficient(self) -> np.ndarray:
        """Friction coefficient [-]."""
        return self["coefficient"]


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

    The ratio changes the shear of the film, its heat, and the heat of the inlet. A point that fails leaves NaN, and its
    exception in ``errors``; the others are still solved.

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
    if speed is not None:
        speed = validate.number("speed", speed, "m/s", minimum=-FASTEST, maximum=FASTEST)
    base = made_ready(scene, tolerance, model)
    speed = base.scene.motion.entrainment_speed if speed is None else speed
    models = [prepare(base.scene.with_(motion={"slide_roll_ratio": ratio}), like=base) for ratio in ratios.tolist()]
    points: list[FrictionResult | None] = [None] * ratios.size
    errors: dict[int, Exception] = {}
    for i, prepared in enumerate(models):
        try:
            points[i] = friction(prepared, speed).without_fields()
        except LubfricError as error:
            errors[i] = error
        if on_point:
            on_point(i + 1, ratios.size, float(ratios[i]), points[i] or errors[i])
    names = [f"slide-roll ratio {ratio:g}" for ratio in ratios]
    report = report_of("traction", names, "ratios", points, errors)
    return judged(TractionResult(ratios, float(speed), tuple(points), errors, report), raise_on_failure)
