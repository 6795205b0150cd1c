"""The warning that the model-form error of f is above its target."""

from collections.abc import Iterator

from .prepared import Prepared
from .violation import Assumption, Violation
from .wording import is_near_zero

MODEL_ERROR = "model-form error of f"
MODEL_ERROR_NEAR_ZERO = f"{MODEL_ERROR} near 0, in f itself,"


def violations_by_model_error(
    prepared: Prepared, error: float, f: float, *, consequence: str, recommendation: str = ""
) -> Iterator[Violation]:
    """Yield a violation where the model-form ``error`` of ``f``, relative, is above ``numerics.model_tolerance``.

    ``consequence``: where it comes from; ``recommendation``: what reduces it ("": nothing that a user may give).
    Where f is near 0, the warning states the error in f itself.
    """
    tolerance = prepared.scene.numerics.model_tolerance
    if not error > tolerance:
        return
    is_relative = not is_near_zero(f, error)
    unit = 100.0 if is_relative else abs(f)
    yield Violation(
        assumption=Assumption.MODEL_FORM_ERROR,
        what=MODEL_ERROR if is_relative else MODEL_ERROR_NEAR_ZERO,
        value=unit * error,
        limit=unit * tolerance,
        unit="%" if is_relative else "",
        consequence=consequence,
        recommendation=recommendation or "read f with its interval",
    )
