"""Friction of mixed-lubricated rough line contacts.

The public names load on first use, so that ``import lubfric`` stays light.
"""

from importlib import import_module

TYPE_CHECKING = False  # as `typing` has it, which takes longer to import than all of this
if TYPE_CHECKING:
    from . import oil as oil
    from .asperity import AsperityResult as AsperityResult
    from .asperity import asperity_contact as asperity_contact
    from .asperity import separation_for_load as separation_for_load
    from .contact import ContactResult as ContactResult
    from .contact import solve_contact as solve_contact
    from .curves import TractionResult as TractionResult
    from .curves.traction import traction as traction
    from .ehl import EHLResult as EHLResult
    from .ehl import solve_ehl as solve_ehl
    from .errors import ConvergenceError as ConvergenceError
    from .errors import InputError as InputError
    from .errors import LubfricError as LubfricError
    from .errors import OutputError as OutputError
    from .errors import ValidityError as ValidityError
    from .fitting import FitResult as FitResult
    from .fitting import Measured as Measured
    from .fitting import explain_fit as explain_fit
    from .fitting import read_measured as read_measured
    from .fitting.fit import fit as fit
    from .history.plan import Transient as Transient
    from .lubricant import Lubricant as Lubricant
    from .paper.differential import solve_differential_deflection as solve_differential_deflection
    from .prepared import Prepared as Prepared
    from .prepared import prepare as prepare
    from .report import Report as Report
    from .result import FrictionResult as FrictionResult
    from .scene import Bodies as Bodies
    from .scene import ContactDomain as ContactDomain
    from .scene import Motion as Motion
    from .scene import Numerics as Numerics
    from .scene import Roughness as Roughness
    from .scene import Scene as Scene
    from .scene_file import load_scene as load_scene
    from .steady import friction as friction
    from .studies import Between as Between
    from .studies import StudyPlan as StudyPlan
    from .studies import StudyResult as StudyResult
    from .studies import open_study as open_study
    from .studies import plan_study as plan_study
    from .studies import sample as sample
    from .studies import study as study
    from .surface import Surface as Surface
    from .surface import generate_surface as generate_surface
    from .surface import read_surface as read_surface
    from .sweep import StribeckResult as StribeckResult
    from .sweep import stribeck as stribeck
    from .unsteady.result import TransientResult as TransientResult
    from .unsteady.run import transient as transient
    from .validity import Validity as Validity
    from .version import __version__ as __version__

_NAMES = {  # by the module that they come from
    "version": ("__version__",),
    "errors": ("ConvergenceError", "InputError", "LubfricError", "OutputError", "ValidityError"),
    "validity": ("Validity",),
    "report": ("Report",),
    "surface": ("Surface", "generate_surface", "read_surface"),
    "contact": ("solve_contact", "ContactResult"),
    "asperity": ("asperity_contact", "separation_for_load", "AsperityResult"),
    "ehl": ("solve_ehl", "EHLResult"),
    "paper.differential": ("solve_differential_deflection",),
    "scene": ("Scene", "Numerics", "ContactDomain", "Roughness", "Motion", "Bodies"),
    "lubricant": ("Lubricant",),
    "scene_file": ("load_scene",),
    "steady": ("friction",),
    "prepared": ("prepare", "Prepared"),
    "result": ("FrictionResult",),
    "unsteady.run": ("transient",),
    "unsteady.result": ("TransientResult",),
    "history.plan": ("Transient",),
    "fitting": ("fit", "explain_fit", "read_measured", "Measured", "FitResult"),
    "studies": ("study", "plan_study", "open_study", "sample", "Between", "StudyPlan", "StudyResult"),
    "sweep": ("stribeck", "StribeckResult"),
    "curves": ("traction", "TractionResult"),
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
