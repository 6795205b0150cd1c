"""A keyword under its former name."""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import ParamSpec, TypeVar

from ..errors import InputError

P = ParamSpec("P")
R = TypeVar("R")
BEFORE, TODAY = "density", "density_law"


def density_before(function: Callable[P, R]) -> Callable[P, R]:
    """``function``, which accepts its keyword ``density_law`` under the name ``density`` as well."""

    @wraps(function)
    def call(*args: P.args, **given: P.kwargs) -> R:
        if BEFORE in given:
            if TODAY in given:
                raise InputError(f"{BEFORE} and {TODAY} say the same thing; give {TODAY} alone")
            given[TODAY] = given.pop(BEFORE)
        return function(*args, **given)

    return call
