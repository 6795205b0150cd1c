"""The mutants. Some are mistakes in the kernels, which the studies against closed forms and finite elements have to
catch. The others are options that do not arrive (`wiring_mutants`), which the wiring checks have to catch."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from . import wiring_mutants
from .mutant import Mutant


def times(factor: float) -> Callable:
    """Replace a function by ``factor`` times it."""
    return lambda original: lambda *args, **kwargs: factor * original(*args, **kwargs)


def reversed_couette(original):
    """Fluxes through faces with -rho H for the Couette flow."""

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
    """A search that knows only cells under pressure, and takes the gap for open elsewhere."""

    def look(search):
        np.maximum(search.gap, search.level, out=search.gap, where=search.change <= search.lower)
        return original(search)

    return look


def no_penetration(original):
    """Residuals that see no penetration."""
    return lambda *args: original(*args) | {"penetration": 0.0}


def half_load(original):
    """The contact pressed with half of what it should carry."""
    return lambda *args, **options: original(*args, **options | {"mean_pressure": options["mean_pressure"] / 2})


def lower_side(original):
    """The shear on the lower surface, where the part of the pressure gradient has the other sign."""

    def force(*args, **options):
        found = original(*args, **options)
        return replace(found, rolling=-found.rolling)

    return force


def mean_wave_only(original):
    """A line kernel that has lost every wave along y: the row of images that makes a point load a point load."""

    def coefficients(*args):
        kernel = original(*args).copy()
        kernel[:, 1:] = 0
        kernel[0, 1:] = 1e-6 * kernel[0, 0]
        return kernel

    return coefficients


def stale(original):
    """The contact before this one, handed back where it is the warm start."""
    before = {}

    def solve(gap0, *args, **options):
        if options.get("start") is None or gap0.shape not in before:
            before[gap0.shape] = original(gap0, *args, **options)
        return before[gap0.shape]

    return solve


def corner_axis(original):
    """Corners of cells in place of their centres."""
    return lambda count, step: original(count, step) - step / 2


KERNELS = (
    Mutant(
        "kernel_factor_2",
        "influence coefficients halved, as printed in the paper's Appendix 1",
        {"lubfric.contact.operator:_symbol": times(0.5)},
    ),
    Mutant(
        "couette_sign",
        "Couette flow of Reynolds' equation runs backwards",
        {"lubfric.film.newton:residual": reversed_couette},
    ),
    Mutant(
        "missing_y_mean",
        "volume balance on one row instead of the mean along y",
        {"lubfric.contact.half_space:HalfSpaceContact._state": first_row_only},
    ),
    Mutant(
        "viscosity_exponent",
        "Roelands' exponent with the decadic logarithm",
        {"lubfric.oil.lubricant:Lubricant.roelands_exponent": decadic_exponent},
    ),
    Mutant(
        "penetration_ignored",
        "contact set and stopping test look at p g only",
        {
            "lubfric.contact.search:Search._look": without_overlap,
            "lubfric.contact.rounds:contact_residuals": no_penetration,
        },
    ),
    Mutant(
        "half_the_load", "rough contact carries half of F_C", {"lubfric.contact.half_space:solve_contact": half_load}
    ),
    Mutant("shear_side", "shear taken on the lower surface", {"lubfric.film.contract:shear_force": lower_side}),
    Mutant(
        "lost_images",
        "semi-periodic operator without its waves along y, the sum over images",
        {"lubfric.contact.operator:semiperiodic_coefficients": mean_wave_only},
    ),
    Mutant(
        "stale_warm_start",
        "contact of the neighbouring load returned for this one",
        {"lubfric.contact.half_space:solve_contact": stale},
    ),
    Mutant(
        "half_cell",
        "film and strip half a cell off the roughness",
        {"lubfric.contact.half_space:centred_axis": corner_axis},
    ),
)
MUTANTS = (*KERNELS, *wiring_mutants.MUTANTS)
