"""The list of studies of the plain command. A study is named here, and imported only when it runs.

A study is a function ``name(level)`` with ``level`` one of "quick", "default", "full". It yields `Check`, `Table`,
`Figure` and `Field` objects as it goes, so that each check is timed, and what was yielded before a failure is kept. Its
docstring is the text of its section in the report. To add one, put the function in a module of its name in
`verification.fem.studies` and add a line below.
"""

from dataclasses import KW_ONLY, dataclass, field

from .check import LEVELS, file_name
from .types import Keywords


@dataclass(frozen=True)
class Study:
    """Where a study is.

    target : "package.module:function"
    levels : those that it runs at
    grade : grade of its checks that state none (`verification.check.GRADES`)
    options : keywords of the function in addition to the level
    """

    name: str
    target: str
    title: str
    _: KW_ONLY
    levels: tuple[str, ...] = LEVELS
    options: Keywords = field(default_factory=dict)
    grade: str = "C"

    def __post_init__(self) -> None:
        file_name(self.name)
        module, _, function = self.target.partition(":")
        unknown = set(self.levels) - set(LEVELS)
        if not (module and function) or unknown or not self.levels:
            raise ValueError(
                f"study {self.name!r}: target = {self.target!r}, levels = {self.levels}; allowed: "
                f"'module:function' and a choice of {LEVELS}"
            )


def study(name: str, title: str, levels: tuple[str, ...] = LEVELS, grade: str = "C") -> Study:
    """Return the study of this name, in the module of its name."""
    return Study(name, f"verification.fem.studies.{name}:{name}", title=title, levels=levels, grade=grade)


def wiring(part: str, title: str) -> Study:
    """Return a study of whether the options of a scene arrive."""
    target = f"verification.campaigns.wiring.{part}:wiring_{part}"
    return Study(f"wiring_{part}", target, title=f"Every option changes the result: {title}")


def published(name: str, title: str) -> Study:
    """Return a part of ``python -m verification published``."""
    return Study(
        name, f"verification.fem.published.{name}:{name}", title=f"{title}, compared with publications", grade="A"
    )


DRY = published("dry", "Dry contact: Hertz, waves, rough surfaces")
HEAT = published("heat", "Heat of a film")
OILS = published("oils", "Oils: viscosity, density, pressure-viscosity coefficient")
PUBLISHED: tuple[Study, ...] = (
    DRY,
    published("films", "Smooth films"),
    published("cavitation", "Films that rupture and fill again"),
    published("friction", "Rolling and sliding friction of smooth films"),
    published("waves", "Waves of a surface in the film, at rest and moving"),
    HEAT,
    OILS,
    published("mixed", "Mixed lubrication"),
)
STUDIES: tuple[Study, ...] = (
    study("reynolds", "Reynolds equation on a line", grade="B"),
    study("reynolds_surface", "Reynolds equation on a surface", grade="B"),
    study("layer", "Elastic layer by finite elements, and the half-space", grade="B"),
    study("contact", "Dry contact on the layer: Hertz line"),
    study("contact_rough", "Dry contact on the layer: rough patch"),
    study("ehl", "Smooth EHL line contact, full-system finite elements"),
    study("contact_grid", "Dry contact of lubfric on ever finer grids", grade="B"),
    study("ehl_grid", "Smooth film of lubfric on ever finer grids", grade="B"),
    study("friction", "Friction of lubfric: grid, patch, area, tolerance"),
    study("load_sharing", "Load sharing, both halves by finite elements"),
    study("deterministic", "Deterministic model: limits, and the film in the same gap by finite elements"),
    study("starved", "Starved smooth film by finite elements"),
    study("rough_strip", "Deterministic model: a rough strip by finite elements, at rest and moving"),
    study("touching_strip", "Deterministic model: touching bodies by finite elements, at rest and moving"),
    study("sharing_cases", "Load sharing by finite elements: other oils, sliding, yielding, flat, a measured map"),
    DRY,
    OILS,
    HEAT,
    study("sampling", "Samples of the surface: statistics, and the scatter of f"),
    study("formulations", "Contact formulations of the paper against the default"),
    wiring("film", "film and shear"),
    wiring("contact", "contact"),
    wiring("maps", "height maps"),
    wiring("time", "motion in time"),
    study("transient", "Smooth contact in time: squeeze, stops, jumps"),
    study("sharing_in_time", "Load sharing in time, both halves by finite elements"),
    study("transient_mixed", "Load sharing in time", ("default", "full")),
    Study(
        "long_tests",
        "verification.campaigns.long_tests:long_tests",
        title="Tests that take minutes",
        levels=("full",),
        grade="B",
    ),
)
