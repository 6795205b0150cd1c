"""Many operating points: planned, spread over any executor, saved as they end, and read as tables."""

from .plan import StudyPlan, plan_study
from .result import StudyResult, open_study
from .run import study
from .vary import Between, sample

__all__ = ["Between", "StudyPlan", "StudyResult", "open_study", "plan_study", "sample", "study"]
