"""All points of a study, laid out before the first is solved: walks along its curves, in batches that share a height
map."""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from itertools import product

import numpy as np

from .._base import validate
from ..errors import InputError
from ..scene import FASTEST, Scene
from ..sharing import scene_of
from .adaptive import AUTO, CHOSEN
from .cost import by_curve
from .fingerprint import fingerprint
from .vary import Axis, axes_of
from .walk import MOST, Batch, Walk

BATCH = 50  # points at least, where curves that share a map are solved by one process


@dataclass(frozen=True)
class StudyPlan:
    """The plan of a study. ``print(plan.explain())`` says what it is and will cost; `lubfric.study` carries it out.

    The walks, and with them the starts, depend on the values and speeds alone, never on how many processes share the
    work. So every executor gives the same bits. ``speeds``: none if every curve chooses its own.
    """

    scene: Scene
    axes: tuple[Axis, ...]
    speeds: tuple[float, ...]
    batches: tuple[Batch, ...]

    @property
    def shape(self) -> tuple[int, ...]:
        """Shape of the results: the axes, then the number of speeds, or the largest number that a curve may choose."""
        return (*(len(axis.values) for axis in self.axes), len(self.speeds) or MOST)

    @property
    def points(self) -> int:
        """Number of points. Where speeds are chosen it is an estimate."""
        return int(np.prod(self.shape[:-1])) * (len(self.speeds) or CHOSEN)

    @property
    def walks(self) -> list[Walk]:
        """All walks of the study."""
        return [walk for batch in self.batches for walk in batch.walks]

    def keys(self) -> np.ndarray:
        """The key of each point, an array of ``shape``. If speeds are chosen: the key of each complete curve, over the
        axes."""
        found = np.empty(self.shape if self.speeds else self.shape[:-1], dtype=object)
        at = {speed: i for i, speed in enumerate(self.speeds)}
        for walk in self.walks:
            if not self.speeds:
                (found[walk.index],) = walk.marks
            for speed, key in zip(walk.speeds, walk.keys):
                found[(*walk.index, at[speed])] = key
        return found

    def explain(self, store=None) -> str:
        """Points, what they share, predicted cost and disk, in words. ``store``: the folder of the study; points that
        are in it already cost nothing."""
        from .explain import explain

        return explain(self, store)


def plan_study(scene: Scene, vary=None, speeds=None) -> StudyPlan:
    """Plan a study without solving anything: points, maps they share, predicted time and disk.

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
    if scene_of(scene) is not scene:
        raise InputError("a study varies a scene; give what lubfric.load_scene returned, not what lubfric.prepare did")
    axes = axes_of(scene, {} if vary is None else vary)
    speeds = _speeds(scene, speeds)
    scenes = {}
    for index in product(*(range(len(axis.values)) for axis in axes)):
        values = {key: value for axis, i in zip(axes, index) for key, value in axis.at(i).items()}
        scenes[index] = replace(scene.with_keys(values), transient=None)
    return StudyPlan(scene, axes, speeds, tuple(_batches(scenes, speeds)))


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
    return tuple(float(u) for u in speeds)


def _batches(scenes: dict, speeds: tuple[float, ...]):
    """The curves grouped by their map, in pieces. The pieces fix which curves are solved by the same process."""
    groups: dict = {}
    maps: dict = {}
    for index, scene in scenes.items():
        groups.setdefault(_shared(scene), []).append((index, scene))
    for group in groups.values():
        leader = max((scene for _, scene in group), key=lambda scene: scene.bodies.mean_hertz_pressure)
        size = len(group) if by_curve(leader) else max(1, -(-BATCH // (len(speeds) or CHOSEN)))
        curves = [_walks(index, scene, leader, speeds, maps) for index, scene in group]
        for first in range(0, len(curves), size):
            walks = tuple(walk for curve in curves[first : first + size] for walk in curve)
            yield Batch(leader if by_curve(leader) else walks[0].scene, walks)


def _walks(index, scene, leader, speeds, maps) -> list[Walk]:
    """The walks along one curve, from its fastest speed down."""
    order = sorted(speeds, key=lambda u: -abs(u))
    rough = repr((scene.surface, scene.counterface))
    if rough not in maps:  # a file is read once, however many curves it serves
        maps[rough] = fingerprint(scene.surface, scene.counterface)
    others = [f.name for f in fields(scene) if f.name not in ("surface", "counterface", "motion", "name", "transient")]
    parts = [maps[rough], scene.motion.slide_roll_ratio, *(getattr(scene, name) for name in others)]
    if by_curve(leader):  # the contact curve reaches to the heaviest load of the group
        parts.append(leader.bodies)
    runs = np.array_split(order, max(1, -(-len(order) // MOST)))
    name = fingerprint(*parts)
    return [Walk(scene, name, tuple(run.tolist()), index=index) for run in runs]


def _shared(scene: Scene) -> str:
    """What must be equal in two scenes that share a map, and an operator or a curve."""
    bodies, numerics = scene.bodies, scene.numerics
    cut = bodies.half_width if scene.contact.shape is None else 0.0
    return repr((scene.surface, scene.counterface, scene.contact, bodies.e_prime, bodies.hardness, numerics, cut))
