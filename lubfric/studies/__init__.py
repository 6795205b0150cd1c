"""Many points: sweeps, studies, curves, fits, and the store that keeps them."""

from .choose import AUTO
from .codec import classes_of, decode, encode
from .curve import CurveResult, csv_bytes
from .draw import friction_over_speed, interval_band, plot_map
from .executor import MOST_WORKERS, pool, processors
from .explain import in_words
from .fit import explain_fit, fit
from .fit_input import Measured, read_measured
from .fit_result import FitResult
from .plan import StudyPlan, plan_study
from .result import StudyResult, open_study
from .run import study
from .store import fingerprint
from .study_file import load_study
from .sweep import StribeckResult, stribeck
from .tables import check_tools
from .traction import TractionResult, traction
from .vary import Between, sample
