"""The public names of lubfric, listed once: `__init__.py` reads this file, and type checkers do.

One import a line, `from .room import name as name`.
"""

from . import oil as oil
from ._base import __version__ as __version__
from .contact import AsperityResult as AsperityResult
from .contact import ContactResult as ContactResult
from .contact import asperity_contact as asperity_contact
from .contact import separation_for_load as separation_for_load
from .contact import solve_contact as solve_contact
from .errors import ConvergenceError as ConvergenceError
from .errors import InputError as InputError
from .errors import LubfricError as LubfricError
from .errors import OutputError as OutputError
from .errors import Report as Report
from .errors import ValidityError as ValidityError
from .estimate import FrictionResult as FrictionResult
from .estimate import friction as friction
from .film import EHLResult as EHLResult
from .film import solve_ehl as solve_ehl
from .models import prepare as prepare
from .models.shared import Prepared as Prepared
from .models.shared import Violation as Violation
from .oil import Lubricant as Lubricant
from .paper import solve_differential_deflection as solve_differential_deflection
from .running_in import run_in as run_in
from .scene import Bodies as Bodies
from .scene import ContactDomain as ContactDomain
from .scene import Motion as Motion
from .scene import Numerics as Numerics
from .scene import Roughness as Roughness
from .scene import Scene as Scene
from .scene import Transient as Transient
from .scene import load_scene as load_scene
from .studies import Between as Between
from .studies import FitResult as FitResult
from .studies import Measured as Measured
from .studies import StribeckResult as StribeckResult
from .studies import StudyPlan as StudyPlan
from .studies import StudyResult as StudyResult
from .studies import TractionResult as TractionResult
from .studies import explain_fit as explain_fit
from .studies import fit as fit
from .studies import open_study as open_study
from .studies import plan_study as plan_study
from .studies import read_measured as read_measured
from .studies import sample as sample
from .studies import stribeck as stribeck
from .studies import study as study
from .studies import traction as traction
from .surface import Surface as Surface
from .surface import generate_surface as generate_surface
from .surface import read_surface as read_surface
from .time import TransientResult as TransientResult
from .time import transient as transient
