"""Many points: sweeps, studies, curves, fits, and the store that keeps them."""

from .codec import decode, encode
from .cost import in_words
from .file import load_study
from .fingerprint import fingerprint
from .fit import fit
from .fit_outlook import explain_fit
from .fit_plot import plot_fit, plot_residuals
from .fit_result import FitResult
from .measured import Measured, read_measured
from .plan import StudyPlan, plan_study
from .pool import MOST_WORKERS, pool, processors
from .records import Records
from .result import StudyResult, open_study
from .run import study
from .sweep import AUTO, stribeck
from .sweep_points import QUANTITIES
from .sweep_result import StribeckResult
from .sweep_table import csv_bytes, curve_table, uncertainty_columns
from .table_row import CONVERGED, UNUSED
from .tables import check_tools, to_netcdf
from .traction import TractionResult, traction
from .vary import Between, sample

__all__ = [
    "AUTO",
    "Between",
    "CONVERGED",
    "FitResult",
    "MOST_WORKERS",
    "Measured",
    "QUANTITIES",
    "Records",
    "StribeckResult",
    "StudyPlan",
    "StudyResult",
    "TractionResult",
    "UNUSED",
    "check_tools",
    "csv_bytes",
    "curve_table",
    "decode",
    "encode",
    "explain_fit",
    "fingerprint",
    "fit",
    "in_words",
    "load_study",
    "open_study",
    "plan_study",
    "plot_fit",
    "plot_residuals",
    "pool",
    "processors",
    "read_measured",
    "sample",
    "stribeck",
    "study",
    "to_netcdf",
    "traction",
    "uncertainty_columns",
]
