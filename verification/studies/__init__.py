"""The list of studies of the plain command. A study is named here, and imported only when it runs.

A study is a function ``name(level)`` with ``level`` one of "quick", "default", "full". It may yield `Check`, `Table`,
`Figure` and `Field` objects as it goes. Then each check is timed, and what was yielded before a failure is kept. Or it
returns a `StudyResult`. Its docstring is the text of its section in the report. To add one, put the function in a
module of this package and add a line below.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from ..check import LEVELS, file_name


@dataclass(frozen=True)
class Study:
    """Where a study is.

    Attributes
    ----------
    target : "package.module:function"
    levels : those that it runs at
    options : keywords of the function beside the level
    """

    name: str
    target: str
    title: str
    levels: tuple[str, ...] = LEVELS
    options: dict = field(default_factory=dict)

    def __post_init__(self):
        file_name(self.name)
        module, _, function = self.target.partition(":")
        unknown = set(self.levels) - set(LEVELS)
        if not (module and function) or unknown or not self.levels:
            raise ValueError(
                f"study {self.name!r}: target = {self.target!r}, levels = {self.levels}; allowed: "
                f"'module:function' and a choice of {LEVELS}"
            )


STUDIES: tuple[Study, ...] = (
    Study("reynolds", "verification.studies.reynolds:reynolds", "Reynolds equation on a line"),
    Study(
        "reynolds_surface", "verification.studies.reynolds_surface:reynolds_surface", "Reynolds equation on a surface"
    ),
    Study("layer", "verification.studies.layer:layer", "Elastic layer by finite elements, and the half-space"),
    Study("contact", "verification.studies.contact:contact", "Dry contact on the layer: Hertz line"),
    Study("contact_rough", "verification.studies.contact_rough:contact_rough", "Dry contact on the layer: rough patch"),
    Study("ehl", "verification.studies.ehl:ehl", "Smooth EHL line contact, full-system finite elements"),
    Study(
        "contact_grid", "verification.studies.contact_grid:contact_grid", "Dry contact of lubfric on ever finer grids"
    ),
    Study("ehl_grid", "verification.studies.ehl_grid:ehl_grid", "Smooth film of lubfric on ever finer grids"),
    Study(
        "friction", "verification.studies.friction:friction", "The whole job of lubfric: grid, patch, area, tolerance"
    ),
    Study(
        "load_sharing", "verification.studies.load_sharing:load_sharing", "Load sharing, both halves by finite elements"
    ),
    Study(
        "deterministic",
        "verification.studies.deterministic:deterministic",
        "One gap, one pressure: limits, and the film in the same gap by finite elements",
    ),
    Study(
        "sharing_cases",
        "verification.studies.sharing_cases:sharing_cases",
        "Load sharing by finite elements: other oils, sliding, yielding, flat, a measured map",
    ),
    Study(
        "formulations",
        "verification.studies.formulations:formulations",
        "Contact formulations of the paper against the default",
    ),
    Study("wiring_film", "verification.wiring.film:wiring_film", "Every option reaches the number: film and shear"),
    Study("wiring_contact", "verification.wiring.contact:wiring_contact", "Every option reaches the number: contact"),
    Study("wiring_maps", "verification.wiring.maps:wiring_maps", "Every option reaches the number: height maps"),
    Study("wiring_time", "verification.wiring.time:wiring_time", "Every option reaches the number: motion in time"),
    Study("transient", "verification.studies.transient:transient", "Smooth contact in time: squeeze, stops, jumps"),
    Study(
        "transient_mixed",
        "verification.studies.transient_mixed:transient_mixed",
        "Load sharing in time",
        ("default", "full"),
    ),
)
