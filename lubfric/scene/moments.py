"""The moments at which a run in time is looked through before it begins, and the longest contact of them."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..film import hertz
from .bodies import Bodies
from .history import Constant, horizon_of
from .scene import Scene

# Number of times at which the histories are sampled before a run begins. A choice: fewer miss short events.
SAMPLED_TIMES = 257


@dataclass(frozen=True, kw_only=True)
class LongestContact:
    """The bodies of a scene where their contact is longest along the motion: ``bodies`` with the load and the radius of
    that moment, and its ``time`` [s]; None of a scene without a ``transient``."""

    bodies: Bodies
    time: float | None = None


def sampled_times(scene: Scene, until: float | None = None) -> list[float]:
    """Return the times [s] at which a run is looked through before it begins: `SAMPLED_TIMES` of them evenly, and all
    stops and jumps; ``until`` [s]: the last one, if not the end of the run."""
    transient = scene.transient
    assert transient is not None
    last = transient.duration if until is None else until
    stops = {t for h in transient.histories for t in (*h.stops(last), *h.jumps(last))}
    return sorted({*np.linspace(0, last, SAMPLED_TIMES).tolist(), *stops})


def longest_contact(scene: Scene, rise: float = 0.0) -> LongestContact:
    """Return the longest contact of ``scene`` at any time of its histories, also after the end of a run, so that a
    longer run has the same surface. It ends where an undeformed cylinder, resting on the ends of
    the Hertz strip, has risen by ``rise`` [m], at x² = b² + 2 R ``rise``; with 0 it is the Hertz strip."""
    bodies = scene.bodies
    transient = scene.transient
    if transient is None or transient.load is None and transient.radius is None:
        return LongestContact(bodies=bodies)
    loads = transient.load or Constant(bodies.load)
    radii = transient.radius or Constant(bodies.radius)
    times = sampled_times(scene, horizon_of((loads, radii), transient.duration))
    moments = [(time, loads.before(time), radii.before(time)) for time in times]
    moments += [(time, loads.at(time), radii.at(time)) for time in times if time < times[-1]]
    time, load, radius = np.array(moments).T
    half_width = hertz.line_half_width(load / bodies.width, radius, bodies.e_prime)
    longest = int(np.argmax(half_width**2 + 2 * radius * rise))
    # Without hardness, which limits bodies.load: the contact has it.
    bodies = replace(bodies, load=float(load[longest]), radius=float(radius[longest]), hardness=None)
    return LongestContact(bodies=bodies, time=float(time[longest]))
