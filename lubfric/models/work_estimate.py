"""What a model will take at one operating point, estimated before anything is solved."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

# Whether asperities touch under an expected film, in words (`WorkEstimate.asperities`).
ALL_TOUCH = "touching"
FEW_TOUCH = "none or a few summits"
NONE_TOUCHES = "none"


@dataclass(frozen=True, kw_only=True)
class SharedWork:
    """Work that points have in common, and that the first of them does.

    Attributes
    ----------
    what : its name: work of one name is done once
    seconds : processor time [s]
    is_of_surface_alone : whether it serves other speeds, lubricants and tolerances on the same surface as well (as in
        `lubfric.models.shared.memo.Key`); else all points of one scene
    """

    what: str
    seconds: float
    is_of_surface_alone: bool


@dataclass(frozen=True, kw_only=True)
class WorkEstimate:
    """What a model will take at one operating point, from closed forms and to an order of magnitude.

    Attributes
    ----------
    strips : number of strips that the tolerances need; 0: the model is not asked
    seconds : processor time [s] of all of it, beyond that of the cheaper models
    has_answer : whether the model is expected to have an answer of its own (`Model.why_unable`)
    waits_for_next : whether "auto" spends them only where the next model is not solved (`SampleSolution.may_suffice`)
    shared : the parts of these seconds that other points are spared
    ends_seconds : processor time [s] of the ends of the input ranges, beside ``seconds``, where this model answers
    fine_fields_seconds : processor time [s] of fields on cells fine enough to look at, if they are requested
    strip_seconds : processor time [s] of one strip, where its roughness moves; 0 where it does not, or has little
        effect
    longest_strip_seconds : the same if that strip has to be solved again on shorter cells
    most_seconds : processor time [s] after which ``numerics.max_work`` ends it
    length : of the strips [m]; NaN: there is one patch
    expected_sampling_error : relative standard error of f after the first strips; NaN: not known
    expected_model_error : relative model-form error of f
    asperities : whether asperities touch: `ALL_TOUCH`, `FEW_TOUCH` or `NONE_TOUCHES`
    """

    strips: int
    seconds: float
    has_answer: bool = True
    waits_for_next: bool = False
    shared: tuple[SharedWork, ...] = ()
    ends_seconds: float = 0.0
    fine_fields_seconds: float = 0.0
    strip_seconds: float = 0.0
    longest_strip_seconds: float = 0.0
    most_seconds: float = math.inf
    length: float = math.nan
    expected_sampling_error: float = math.nan
    expected_model_error: float = math.nan
    asperities: str = ""

    def as_measured(self, measured: "MeasuredTime") -> "WorkEstimate":
        """Return the same with the time of moving roughness that is ``measured``: without an answer where a strip takes
        so long that the solve ends after its first steps."""
        times = measured.over_expected
        if times * self.strip_seconds > measured.most_strip_seconds:
            return replace(
                self, strips=0, seconds=measured.seconds, has_answer=False, strip_seconds=times * self.strip_seconds
            )
        return replace(
            self,
            seconds=min(times * self.seconds, self.most_seconds),
            strip_seconds=times * self.strip_seconds,
            longest_strip_seconds=times * self.longest_strip_seconds,
        )


@dataclass(frozen=True, kw_only=True)
class MeasuredTime:
    """What a strip of moving roughness takes, as measured on its first steps in time.

    Attributes
    ----------
    speed : of entrainment [m/s], not 0
    over_expected : processor time of the strip over that of `WorkEstimate`
    steps : number of steps in time that were measured
    seconds : processor time [s] of the measurement
    most_strip_seconds : processor time [s] of a strip above which its solve ends after so many steps; infinite: none
        does
    """

    speed: float
    over_expected: float
    steps: int
    seconds: float
    most_strip_seconds: float = math.inf


def time_at(measured: Sequence[MeasuredTime], speed: float) -> MeasuredTime:
    """Return what the times that are ``measured``, at least one, say of a strip at ``speed`` [m/s]: that at the nearest
    speed, with a ratio to the expected time whose logarithm is linear in that of the speed between two of them."""
    if speed == 0:
        return measured[0]
    ordered = sorted(measured, key=lambda time: abs(time.speed))
    log_speeds = np.log([abs(time.speed) for time in ordered])
    log_ratios = np.log([time.over_expected for time in ordered])
    log_speed = math.log(abs(speed))
    nearest = ordered[int(np.argmin(np.abs(log_speeds - log_speed)))]
    return replace(nearest, over_expected=float(np.exp(np.interp(log_speed, log_speeds, log_ratios))))
