"""Every exception the library raises on purpose."""

from __future__ import annotations


class LubfricError(Exception):
    """Base class: catch this to catch everything that lubfric raises on purpose.

    ``hints`` say what else may be the cause. They are added on the way up, and end the message.
    """

    hints: tuple[str, ...] = ()

    def hint(self, text: str) -> None:
        """Add a possible cause, once; nothing if the text is empty."""
        if text and text not in self.hints:
            self.hints += (text,)

    def __str__(self) -> str:
        return "; ".join((self.worded(), *self.hints))

    def worded(self) -> str:
        """The message without the hints."""
        return str(self.args[0]) if self.args else ""


class InputError(LubfricError, ValueError):
    """An input is outside its allowed range; raised before any work starts.

    The message names the quantity, the value, the allowed range and the unit. The error has these as attributes:
    ``quantity``, with which the message begins (``also``: others that it is about), ``allowed``, and ``way_out``, which
    says what to do if there is no range.
    """

    def __init__(self, said: str, quantity: str = "", allowed: str = "", way_out: str = "", also: tuple[str, ...] = ()):
        super().__init__(said, quantity, allowed, way_out, also)
        self.said, self.quantity, self.allowed, self.way_out, self.also = said, quantity, allowed, way_out, also

    def worded(self) -> str:
        allowed = self.allowed and f"; allowed: {self.allowed}"
        return f"{self.quantity}{self.said}{allowed}{self.way_out and '; ' + self.way_out}"


class OutputError(LubfricError, OSError):
    """A file could not be written or read: a full disk, a missing right, a folder that went away.

    The message names the file and what the operating system said. Files that were complete before stay.
    """


class ConvergenceError(LubfricError, RuntimeError):
    """A solver stopped before it reached the tolerance that was asked for.

    ``report`` is the solver's `lubfric.Report`. ``result`` is what the solver had when it stopped (or ``None``), so
    that nothing computed is lost. Both survive pickling.
    """

    def __init__(self, message: str, report=None, result=None):
        super().__init__(message, report, result)
        self.message = message
        self.report = report
        self.result = result


class ValidityError(LubfricError, ValueError):
    """A converged solution is outside the range of the model, so that its coefficient is no answer.

    ``entries`` are the `lubfric.Validity` entries that refuse it. ``result`` is the whole result (or ``None``), so that
    nothing computed is lost. With ``numerics.accept = true`` it is returned instead. The error survives pickling.
    """

    def __init__(self, message: str, entries=(), result=None):
        super().__init__(message, entries, result)
        self.message = message
        self.entries = entries
        self.result = result
