"""Friction of mixed-lubricated rough line contacts.

The public names load on first use, so that ``import lubfric`` stays light.
"""

from importlib import import_module

TYPE_CHECKING = False  # as `typing` has it, which takes longer to import than all of this
if TYPE_CHECKING:
    from . import oil as oil
    from ._base.version import __version__ as __version__
    from .contact.asperity import AsperityResult as AsperityResult
    from .contact.asperity import asperity_contact as asperity_contact
    from .contact.asperity_separation import separation_for_load as separation_for_load
    from .contact.result import ContactResult as ContactResult
    from .contact.solve import solve_contact as solve_contact
    from .errors import ConvergenceError as ConvergenceError
    from .errors import InputError as InputError
    from .errors import LubfricError as LubfricError
    from .errors import OutputError as OutputError
    from .errors import ValidityError as ValidityError
    from .film.ehl import solve_ehl as solve_ehl
    from .film.ehl_result import EHLResult as EHLResult
    from .oil.lubricant import Lubricant as Lubricant
    from .paper.differential import solve_differential_deflection as solve_differential_deflection
    from .report import Report as Report
    from .sampling.friction import friction as friction
    from .sampling.result import FrictionResult as FrictionResult
    from .scene.bodies import Bodies as Bodies
    from .scene.contact import ContactDomain as ContactDomain
    from .scene.file import load_scene as load_scene
    from .scene.motion import Motion as Motion
    from .scene.numerics import Numerics as Numerics
    from .scene.roughness import Roughness as Roughness
    from .scene.scene import Scene as Scene
    from .scene.transient import Transient as Transient
    from .sharing.prepared import Prepared as Prepared
    from .sharing.prepared import prepare as prepare
    from .sharing.validity import Validity as Validity
    from .studies.fit import fit as fit
    from .studies.fit_outlook import explain_fit as explain_fit
    from .studies.fit_result import FitResult as FitResult
    from .studies.measured import Measured as Measured
    from .studies.measured import read_measured as read_measured
    from .studies.plan import StudyPlan as StudyPlan
    from .studies.plan import plan_study as plan_study
    from .studies.result import StudyResult as StudyResult
    from .studies.result import open_study as open_study
    from .studies.run import study as study
    from .studies.sweep import stribeck as stribeck
    from .studies.sweep_result import StribeckResult as StribeckResult
    from .studies.traction import TractionResult as TractionResult
    from .studies.traction import traction as traction
    from .studies.vary import Between as Between
    from .studies.vary import sample as sample
    from .surface.generate import generate_surface as generate_surface
    from .surface.height_map import Surface as Surface
    from .surface.read import read_surface as read_surface
    from .time.result import TransientResult as TransientResult
    from .time.run import transient as transient

_NAMES = {  # by the module that they come from
    "contact.asperity": (
        "AsperityResult",
        "asperity_contact",
    ),
    "contact.asperity_separation": ("separation_for_load",),
    "contact.result": ("ContactResult",),
    "contact.solve": ("solve_contact",),
    "studies.traction": (
        "TractionResult",
        "traction",
    ),
    "film.ehl_result": ("EHLResult",),
    "film.ehl": ("solve_ehl",),
    "errors": (
        "ConvergenceError",
        "InputError",
        "LubfricError",
        "OutputError",
        "ValidityError",
    ),
    "studies.fit_result": ("FitResult",),
    "studies.measured": (
        "Measured",
        "read_measured",
    ),
    "studies.fit_outlook": ("explain_fit",),
    "studies.fit": ("fit",),
    "scene.transient": ("Transient",),
    "oil.lubricant": ("Lubricant",),
    "paper.differential": ("solve_differential_deflection",),
    "sharing.prepared": (
        "Prepared",
        "prepare",
    ),
    "report": ("Report",),
    "sampling.result": ("FrictionResult",),
    "scene.bodies": ("Bodies",),
    "scene.contact": ("ContactDomain",),
    "scene.motion": ("Motion",),
    "scene.numerics": ("Numerics",),
    "scene.roughness": ("Roughness",),
    "scene.scene": ("Scene",),
    "scene.file": ("load_scene",),
    "sampling.friction": ("friction",),
    "studies.vary": (
        "Between",
        "sample",
    ),
    "studies.plan": (
        "StudyPlan",
        "plan_study",
    ),
    "studies.result": (
        "StudyResult",
        "open_study",
    ),
    "studies.run": ("study",),
    "surface.height_map": ("Surface",),
    "surface.generate": ("generate_surface",),
    "surface.read": ("read_surface",),
    "studies.sweep_result": ("StribeckResult",),
    "studies.sweep": ("stribeck",),
    "time.result": ("TransientResult",),
    "time.run": ("transient",),
    "sharing.validity": ("Validity",),
    "_base.version": ("__version__",),
}
_HOME = {name: home for home, names in _NAMES.items() for name in names}
_PACKAGES = ("oil",)
_BEFORE = {"Patch": "ContactDomain", "Model": "Prepared"}
__all__ = sorted([*(name for name in _HOME if name != "__version__"), *_PACKAGES])


def __getattr__(name: str) -> object:
    if name in _PACKAGES:
        return import_module(f"lubfric.{name}")
    if name not in _HOME:
        today = f": it is lubfric.{_BEFORE[name]} now" if name in _BEFORE else ""
        raise AttributeError(f"module 'lubfric' has no attribute {name!r}{today}")
    value = getattr(import_module(f"lubfric.{_HOME[name]}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted(set(globals()) | set(__all__))
