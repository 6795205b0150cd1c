"""`Transient`: what changes in time in a scene, and for how long."""

from __future__ import annotations

from dataclasses import dataclass

from .._base import validate
from ..errors import InputError
from .history import History
from .history_read import checked_history


@dataclass(frozen=True)
class Transient:
    """What changes in time in a scene, and for how long.

    A history is a number or one of `lubfric.scene`. None means the scene's own constant.

    Attributes
    ----------
    duration : [s]
    outputs : number of output times, spread evenly, beside 0
    speed : entrainment speed [m/s]
    sliding : u2 - u1 [m/s]; None: slide-roll ratio x speed
    load : [N]
    radius : reduced radius [m]
    viscosity : at ambient pressure [Pa s]
    initial : "steady": the steady state of the values before t = 0; "rest": no film pressure, the contact carries the
        load; "auto": steady where there is entrainment, else rest
    initial_film : start from the undeformed parabola at this height instead [m]
    tolerance : largest local error of the film in a step, relative; None: 0.01 x the scene's film tolerance
    """

    duration: float
    outputs: int = 200
    speed: History | None = None
    sliding: History | None = None
    load: History | None = None
    radius: History | None = None
    viscosity: History | None = None
    initial: str = "auto"
    initial_film: float | None = None
    tolerance: float | None = None

    @property
    def histories(self) -> tuple[History, ...]:
        """The histories of all that changes."""
        given = (self.speed, self.sliding, self.load, self.radius, self.viscosity)
        return tuple(h for h in given if h is not None)

    def __post_init__(self):
        validate.python_fields(self)
        validate.positive("transient.duration", self.duration, "s", minimum=1e-12, maximum=1e9)
        validate.integer("transient.outputs", self.outputs, minimum=1, maximum=1_000_000)
        validate.choice("transient.initial", self.initial, ("auto", "steady", "rest"))
        if self.initial_film is not None:
            validate.positive("transient.initial_film", self.initial_film, "m", minimum=1e-12, maximum=1.0)
            if self.initial != "auto":
                told = f" = {self.initial!r} does nothing beside initial_film, from which the run starts"
                raise InputError(told, "transient.initial", "one of the two")
        if self.tolerance is not None:
            validate.number("transient.tolerance", self.tolerance, "(-)", minimum=1e-9, maximum=0.1)
        for name, unit in (("speed", "m/s"), ("sliding", "m/s"), ("load", "N"), ("radius", "m"), ("viscosity", "Pa s")):
            given = getattr(self, name)
            if given is not None:
                positive = unit in ("N", "m", "Pa s")
                given = checked_history(f"transient.{name}", given, unit, self.duration, positive=positive)
                object.__setattr__(self, name, given)
