"""What the host of the library may have changed, and the library does not depend on."""

from collections.abc import Callable
from functools import wraps
from typing import ParamSpec, TypeVar

import numpy as np

P = ParamSpec("P")
T = TypeVar("T")


def with_default_errors(function: Callable[P, T]) -> Callable[P, T]:
    """Return the ``function`` such that it runs with NumPy's default handling of floating-point errors.

    ``np.seterr(all="raise")`` in a host would turn an underflow, which is no error here, into an exception. Every
    public function that computes has this decorator.
    """

    @wraps(function)
    def wrapped(*args: P.args, **kwargs: P.kwargs) -> T:
        with np.errstate(divide="warn", over="warn", under="ignore", invalid="warn"):
            return function(*args, **kwargs)

    return wrapped
