"""The operating point of a scene on its curve: the scene's own speed or slide-roll ratio, and the solved point nearest
to it."""

from collections.abc import Iterable

import numpy as np

from ..estimate import FrictionResult
from ..quantities import worded_value
from ..scene import Scene
from ..studies import CurveResult
from .describe import belongs_to_curve, index_of_nearest, is_among


def operating_point_of(scene: Scene, name: str) -> float:
    """Return the scene's own "speed" [m/s] or slide-roll "ratio"."""
    return scene.motion.entrainment_speed if name == "speed" else scene.motion.slide_roll_ratio


def operating_point_not_solved(scene: Scene, solved: Iterable[float], name: str = "speed") -> str:
    """Return in a sentence why a curve over speeds or slide-roll ratios (``name``: "speed", "ratio") has no point at
    the scene's own one, which is its operating point; "" where it is one of those ``solved``."""
    value = operating_point_of(scene, name)
    others = list(solved)
    if is_among(value, others):
        return ""
    key = "motion.entrainment_speed" if name == "speed" else "motion.slide_roll_ratio"
    what = (
        f"The scene's own {'speed' if name == 'speed' else 'slide-roll ratio'}, {worded_value(key, value)} ({key}), "
        "is not solved, "
    )
    if name == "speed" and value == 0:
        return f"{what}because a curve over the speed has no point at rest."
    if name == "speed" and not belongs_to_curve(value, others):
        return f"{what}because the curve is in the other direction."
    return f"{what}because --{name}s does not contain it."


def nearest_solved(scene: Scene, curve: CurveResult) -> tuple[FrictionResult, str] | None:
    """Return the solved point nearest to the scene's own, and its place as text; None if no point has an answer."""
    name = curve.SWEPT[0]
    solved = np.flatnonzero(np.isfinite(curve["coefficient"])).tolist()
    if not solved:
        return None
    values = getattr(curve, name)[solved].tolist()
    index = solved[index_of_nearest(values, operating_point_of(scene, name), are_speeds=name == "speed")]
    point = curve.points[index]
    assert point is not None
    return point, place_on_curve(curve, index)


def place_on_curve(curve: CurveResult, index: int) -> str:
    """Return where a point of a curve lies, as "at U = 0.03 m/s"."""
    name, symbol, unit, _ = curve.SWEPT
    return f"at {symbol} = {getattr(curve, name)[index]:.4g} {unit}".rstrip()
