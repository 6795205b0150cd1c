"""Keywords by the name they had before."""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import ParamSpec, TypeVar

from .errors import InputError

P = ParamSpec("P")
R = TypeVar("R")


def keyword_before(before: str, today: str) -> Callable[[Callable[P, R]], Callable[P, R]]:
    """A decorator: the function takes its keyword ``today`` under the name ``before`` as well."""

    def decorated(function: Callable[P, R]) -> Callable[P, R]:
        @wraps(function)
        def call(*args: P.args, **given: P.kwargs) -> R:
            if before in given:
                if today in given:
                    raise InputError(f"{before} and {today} say the same thing; give {today} alone")
                given[today] = given.pop(before)
            return function(*args, **given)

        return call

    return decorated
