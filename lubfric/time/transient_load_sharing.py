"""The load-sharing model in time, by the contract of `lubfric.time.model`."""

from dataclasses import dataclass, replace

import numpy as np

from ..models.load_sharing import why_moment_unknown
from ..models.shared import Prepared
from ..scene import Scene
from .film_setting import TIME_SHARE, Setting
from .load_sharing_solver import LoadSharingSolver, operator_to
from .march import Progress
from .model import Output
from .moment import load_sharing_moment
from .roughness_in_motion import way_to_motion_in_time
from .scene_in_time import roughness_moves, transient_of

# Tolerances of the volume balance and of the contact over the largest local error of a step, at most [-]: what they
# leave differs from step to step, and looks like an error in time that no shorter step reduces. docs/examples/cam.toml
# takes 950 steps, and 2500 with 3 and 30; with a third of these shares as many, each with a quarter more work.
BALANCE_SHARE = 1.0
CONTACT_SHARE = 3.0

# Loosest tolerance of the volume balance [-], whatever the local error of a step may be. A choice: f of every output
# follows from it.
LOOSEST_BALANCE = 1e-4
STANDS_STILL = "moving roughness is treated as stationary"


@dataclass(frozen=True, kw_only=True)
class TransientLoadSharing(LoadSharingSolver):
    """The load-sharing model in time (`lubfric.time.model.TimeModel`); its attributes are those of
    `LoadSharingSolver`."""

    stops = ()

    @property
    def first_step(self) -> float:
        """Step after a start or a jump [s]."""
        return self.setting.first_step

    @property
    def time_error(self) -> float:
        """Largest local error of a step, unless the scene states one."""
        return _default_time_error(self.scene)

    @property
    def x(self) -> np.ndarray:
        """Positions of the nodes [m]."""
        return self.setting.grid.x * self.setting.problem.length_unit

    @property
    def cells(self) -> str:
        """The grid as text."""
        return f"{self.setting.grid.n} cells"

    @property
    def model_form_unknown(self) -> str:
        """Why the model-form error of f is not known; "" where it is."""
        return why_moment_unknown(self.scene)

    @property
    def notes(self) -> tuple[str, ...]:
        """What a reader of the result should know."""
        if not roughness_moves(self.scene):
            return ()
        return (f"{STANDS_STILL}; {way_to_motion_in_time(self.scene)}",)

    def record(self, progress: Progress) -> Output:
        """Return the numbers and fields after the last step."""
        unit = self.setting.problem
        terms = progress.solution.terms
        numbers, violations = load_sharing_moment(self, progress)
        return Output(
            numbers=numbers,
            violations=violations,
            pressure=terms.P * unit.pressure_unit,
            film_thickness=terms.H * unit.film_unit,
        )

    def resumable(self, progress: Progress) -> Progress:
        """Return ``progress`` with the pressure and displacement of the contact, from which the next one is solved,
        without what the next step computes again."""
        contact_step = progress.payload
        state = contact_step.state
        fields = state.fields and replace(state.fields, gap=np.empty(0))
        return replace(
            progress, payload=replace(contact_step, state=replace(state, fields=fields, y=None)), solution=None
        )


def _default_time_error(scene: Scene) -> float:
    """Return the largest local error of a step, unless ``scene`` states one."""
    return TIME_SHARE * scene.numerics.tolerance_of("film")


def make_load_sharing(
    prepared: Prepared, setting: Setting, *, correlation_length: float, area: float, plastic: float
) -> TransientLoadSharing:
    """Return the model on the strip of ``prepared``, with the operators between the film's grid and the patch.
    ``correlation_length``, ``area``, ``plastic``: as in `TransientLoadSharing`."""
    numerics = prepared.scene.numerics
    time_error = transient_of(prepared.scene).tolerance or _default_time_error(prepared.scene)
    patch = prepared.rough_contact
    if patch.adjustable_tolerance is not None:
        patch = patch.tightened(min(patch.adjustable_tolerance, CONTACT_SHARE * time_error))
    return TransientLoadSharing(
        prepared=replace(prepared, rough_contact=patch),
        setting=setting,
        to_patch=operator_to(setting, patch.x),
        tolerance=min(numerics.tolerance_of("balance"), LOOSEST_BALANCE, BALANCE_SHARE * time_error),
        correlation_length=correlation_length,
        area=area,
        plastic=plastic,
    )
