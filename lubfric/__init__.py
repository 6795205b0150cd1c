"""Friction of mixed-lubricated rough line contacts.

The public names load on first use, so that ``import lubfric`` stays light.
"""

from importlib import import_module

__version__ = "0.1.0"

_HOME = {
    "ConvergenceError": "errors",
    "InputError": "errors",
    "LubfricError": "errors",
    "OutputError": "errors",
    "ValidityError": "errors",
    "Validity": "validity",
    "Report": "report",
    "Surface": "surface",
    "generate_surface": "surface",
    "read_surface": "surface",
    "solve_contact": "contact",
    "ContactResult": "contact",
    "asperity_contact": "asperity",
    "separation_for_load": "asperity",
    "AsperityResult": "asperity",
    "solve_ehl": "ehl",
    "EHLResult": "ehl",
    "solve_differential_deflection": "paper.differential",
    "Scene": "scene",
    "Lubricant": "lubricant",
    "Numerics": "scene",
    "Patch": "scene",
    "Roughness": "scene",
    "Motion": "scene",
    "Bodies": "scene",
    "load_scene": "scene_file",
    "friction": "steady",
    "prepare": "model",
    "Model": "model",
    "FrictionResult": "result",
    "transient": "unsteady.run",
    "TransientResult": "unsteady.result",
    "Transient": "history.plan",
    "fit": "fitting",
    "read_measured": "fitting",
    "Measured": "fitting",
    "FitResult": "fitting",
    "study": "studies",
    "plan_study": "studies",
    "open_study": "studies",
    "sample": "studies",
    "Between": "studies",
    "StudyPlan": "studies",
    "StudyResult": "studies",
    "stribeck": "sweep",
    "traction": "curves",
    "TractionResult": "curves",
    "StribeckResult": "sweep",
}
_PACKAGES = ("oil",)
__all__ = sorted([*_HOME, *_PACKAGES])


def __getattr__(name):
    if name in _PACKAGES:
        return import_module(f"lubfric.{name}")
    if name not in _HOME:
        raise AttributeError(f"module 'lubfric' has no attribute {name!r}")
    value = getattr(import_module(f"lubfric.{_HOME[name]}"), name)
    globals()[name] = value
    return value


def __dir__():
    return sorted(set(globals()) | set(__all__))
