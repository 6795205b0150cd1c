"""Every exception the library raises on purpose."""

from __future__ import annotations


class LubfricError(Exception):
    """Base class: catch this to catch everything lubfric raises on purpose."""


class InputError(LubfricError, ValueError):
    """An input is outside its allowed range, raised before any work starts.

    The message names the quantity, the value, the allowed range and the unit.
    """


class OutputError(LubfricError, OSError):
    """A file could not be written or read: a full disk, a missing right, a folder that went away.

    The message names the file and what the system said. What was complete on disk before stays.
    """


class ConvergenceError(LubfricError, RuntimeError):
    """A solver stopped before it reached the tolerance it was asked for.

    ``report`` is the solver's `lubfric.Report`. ``result`` is whatever the solver had when it stopped (or ``None``), so
    that nothing computed is lost. Both survive pickling.
    """

    def __init__(self, message: str, report=None, result=None):
        super().__init__(message, report, result)
        self.message = message
        self.report = report
        self.result = result

    def __str__(self) -> str:
        return self.message


class ValidityError(LubfricError, ValueError):
    """A converged solution lies outside the range of the model, so that its coefficient is no answer.

    ``entries`` are the `lubfric.Validity` entries that refuse it. ``result`` is the whole result (or ``None``), so that
    nothing computed is lost. ``numerics.accept = true`` returns it instead. The error survives pickling.
    """

    def __init__(self, message: str, entries=(), result=None):
        super().__init__(message, entries, result)
        self.message = message
        self.entries = entries
        self.result = result

    def __str__(self) -> str:
        return self.message
