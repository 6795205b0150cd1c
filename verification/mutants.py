"""Ways to break `lubfric` while it runs: functions replaced in one process, no source edited.

A mutant names the places it changes as "module:attribute"; ``wrong(original)`` gives what is put there. A
place that no longer exists is an AttributeError, and `applied` counts the calls, so that a mutant that never
ran is not taken for one that was caught.
"""

from __future__ import annotations

import contextlib
import functools
import importlib
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np


@dataclass(frozen=True)
class Mutant:
    """A mistake: ``name``, ``what`` it is in a sentence, for each place "module:attribute" its replacement, and the
    studies that are asked to catch it.
    """

    name: str
    what: str
    places: dict[str, Callable]
    suite: tuple[str, ...] = ("contact_grid", "ehl_grid", "friction", "load_sharing")


@contextlib.contextmanager
def applied(mutant: Mutant) -> Iterator[list[str]]:
    """While open, `lubfric` is broken; the list grows by a place whenever its replacement is called."""
    calls: list[str] = []
    undo = []
    try:
        for place, wrong in mutant.places.items():
            owner, name = located(place)
            original = owner.__dict__[name] if isinstance(owner, type) else getattr(owner, name)
            undo.append((owner, name, original))
            setattr(owner, name, replacement(original, wrong, place, calls))
        yield calls
    finally:
        for owner, name, original in reversed(undo):
            setattr(owner, name, original)


def located(place: str) -> tuple[object, str]:
    """The module or class that holds an attribute, and its name."""
    module, _, path = place.partition(":")
    owner = importlib.import_module(module)
    *outer, name = path.split(".")
    for part in outer:
        owner = getattr(owner, part)
    if not hasattr(owner, name):
        raise AttributeError(f"{place} does not exist any more: the mutant has to follow the code")
    return owner, name


def replacement(original, wrong: Callable, place: str, calls: list[str]):
    """``wrong(original)`` that counts; a property stays one."""
    function = original.fget if isinstance(original, property) else original
    broken = wrong(function)

    @functools.wraps(function)
    def counted(*args, **kwargs):
        calls.append(place)
        return broken(*args, **kwargs)

    return property(counted) if isinstance(original, property) else counted


def times(factor: float) -> Callable:
    """Replace a function by ``factor`` times it."""
    return lambda original: lambda *args, **kwargs: factor * original(*args, **kwargs)


def reversed_couette(original):
    """Face fluxes with -rho H for the Couette flow."""

    def residual(grid, problem, z, H):
        R, terms = original(grid, problem, z, H)
        flux = terms.flux - 2 * terms.face_density * terms.face_H
        R = R.copy()
        R[: grid.n] = 1 - flux / terms.q
        return R, replace(terms, flux=flux)

    return residual


def first_row_only(original):
    """Gap of the first row along y instead of the mean."""
    return lambda patch, film, gap, contact: original(patch, film, np.broadcast_to(gap[:, :1], gap.shape), contact)


def decadic_exponent(original):
    """Roelands' z with the decadic logarithm of the viscosity."""

    def exponent(lubricant):
        return lubricant.pressure_viscosity_coefficient * 1.96e8 / (np.log10(lubricant.viscosity) + 9.67)

    return exponent


def without_overlap(original):
    """A search that knows only cells under pressure: elsewhere the gap is taken for open."""

    def look(descent):
        unloaded = descent.change <= descent.lower
        np.maximum(descent.gap, descent.level, out=descent.gap, where=unloaded)
        return original(descent)

    return look


def no_penetration(original):
    """Residuals that see no penetration."""
    return lambda *args: original(*args) | {"penetration": 0.0}


def half_load(original):
    """The contact pressed with half of what it should carry."""
    return lambda *args, **options: original(*args, **options | {"mean_pressure": options["mean_pressure"] / 2})


def lower_side(original):
    """Shear taken on the lower surface: the pressure-gradient part changes sign."""

    def force(*args, **options):
        found = original(*args, **options)
        return replace(found, rolling=-found.rolling)

    return force


def mean_wave_only(original):
    """Every wave along y lost: the row of images that makes a point load a point load."""

    def coefficients(*args):
        kernel = original(*args).copy()
        kernel[:, 1:] = 0
        kernel[0, 1:] = 1e-6 * kernel[0, 0]
        return kernel

    return coefficients


def stale(original):
    """A warm start handed back as the solution."""
    return lambda *args, **options: options.get("start") or original(*args, **options)


def corner_axis(original):
    """Cell corners taken for cell centres."""
    return lambda count, step: original(count, step) - step / 2


MUTANTS = (
    Mutant(
        "kernel_factor_2",
        "influence coefficients halved, as printed in the paper's Appendix 1",
        {"lubfric.halfspace.operator:_symbol": times(0.5)},
    ),
    Mutant(
        "couette_sign",
        "Couette flow of Reynolds' equation runs backwards",
        {"lubfric.ehl.newton:residual": reversed_couette},
    ),
    Mutant(
        "missing_y_mean",
        "volume balance on one row instead of the mean along y",
        {"lubfric.rough.half_space:HalfSpaceContact._state": first_row_only},
    ),
    Mutant(
        "viscosity_exponent",
        "Roelands' exponent with the decadic logarithm",
        {"lubfric.lubricant:Lubricant.roelands_exponent": decadic_exponent},
    ),
    Mutant(
        "penetration_ignored",
        "contact set and stopping test look at p g only",
        {
            "lubfric.contact.descent:Descent._look": without_overlap,
            "lubfric.contact.looked:contact_residuals": no_penetration,
        },
    ),
    Mutant("half_the_load", "rough contact carries half of F_C", {"lubfric.rough.half_space:solve_contact": half_load}),
    Mutant("shear_side", "shear taken on the lower surface", {"lubfric.film.contract:shear_force": lower_side}),
    Mutant(
        "lost_images",
        "semi-periodic operator without its waves along y, the sum over images",
        {"lubfric.halfspace.operator:semiperiodic_coefficients": mean_wave_only},
    ),
    Mutant(
        "stale_warm_start",
        "contact of the neighbouring load returned for this one",
        {"lubfric.rough.half_space:solve_contact": stale},
    ),
    Mutant(
        "half_cell",
        "film and strip half a cell off the roughness",
        {"lubfric.rough.half_space:centred_axis": corner_axis},
    ),
)
