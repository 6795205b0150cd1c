"""All points of a study, laid out before the first is solved."""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from itertools import product

import numpy as np

from .._base import validate
from ..errors import InputError
from ..scene import FASTEST, Scene
from .choose import AUTO, CHOSEN, MOST
from .explain import explain
from .store import fingerprint
from .vary import Axis, axes_of


@dataclass(frozen=True)
class StudyPlan:
    """The plan of a study: curves over the speed, one for each combination of the varied values.
    ``print(plan.explain())`` says what it is and will cost; `lubfric.study` carries it out.

    ``speeds`` [m/s]: none if every curve chooses its own; ``scenes`` of the curves, the last axis fastest, and their
    ``keys``: hashes of all that their points depend on beside the speed.
    """

    scene: Scene
    axes: tuple[Axis, ...]
    speeds: tuple[float, ...]
    scenes: tuple[Scene, ...]
    keys: tuple[str, ...]

    @property
    def shape(self) -> tuple[int, ...]:
        """Shape of the results: the axes, then the number of speeds, or the largest number that a curve may choose."""
        return (*(len(axis.values) for axis in self.axes), len(self.speeds) or MOST)

    @property
    def points(self) -> int:
        """Number of points. Where speeds are chosen it is an estimate."""
        return len(self.scenes) * (len(self.speeds) or CHOSEN)

    explain = explain


def plan_study(scene: Scene, vary=None, speeds=None) -> StudyPlan:
    """Plan a study without solving anything.

    Parameters
    ----------
    scene, vary, speeds : as in `lubfric.study`

    Returns
    -------
    StudyPlan : ``print(plan.explain())`` tells what it is; `lubfric.study` carries it out

    Raises
    ------
    InputError : a key or a value is not one that a scene can have
    """
    validate.instance("scene", scene, Scene, "a scene to vary: what lubfric.load_scene returned, not lubfric.prepare")
    axes = axes_of(scene, {} if vary is None else vary)
    scenes, keys = [], []
    maps: dict[str, str] = {}  # a map is read once, however many scenes it serves
    for index in product(*(range(len(axis.values)) for axis in axes)):
        values = {key: value for axis, i in zip(axes, index) for key, value in axis.at(i).items()}
        one = replace(scene.with_keys(values), transient=None)
        rough = repr((one.surface, one.counterface))
        if rough not in maps:
            maps[rough] = fingerprint(one.surface, one.counterface)
        others = [getattr(one, f.name) for f in fields(one) if f.name not in ("name", "surface", "counterface")]
        scenes.append(one)
        keys.append(fingerprint(maps[rough], *others))
    return StudyPlan(scene, axes, _speeds(scene, speeds), tuple(scenes), tuple(keys))


def _speeds(scene: Scene, speeds) -> tuple[float, ...]:
    """The speeds in m/s: those of the scene for None, none for "auto"."""
    if isinstance(speeds, str):
        if speeds != AUTO:
            raise InputError(
                f"speeds = {speeds!r}; allowed: speeds in m/s, or 'auto', where each curve chooses its own"
            )
        return ()
    if speeds is None:
        speeds = scene.motion.speeds or (scene.motion.entrainment_speed,)
    speeds = validate.numbers("speeds", speeds, "m/s", FASTEST)
    if np.unique(speeds).size < speeds.size:
        raise InputError("speeds hold a value twice; give each once, in m/s")
    return tuple(speeds.tolist())
