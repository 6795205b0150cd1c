"""The mutants: ways in which `lubfric` could be wrong without an error.

Some are mistakes in the kernels, which the studies against closed forms and finite elements have to catch. The others
are options that are lost on their way to the number: each function works, but something that was asked for does not
arrive. The wiring checks have to catch these.
"""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from lubfric.contact import weighted_mean

from .mutant import Mutant, with_keywords


def times(factor: float) -> Callable:
    """Replace a function by ``factor`` times it."""
    return lambda original: lambda *args, **kwargs: factor * original(*args, **kwargs)


def argument(place: int, change: Callable) -> Callable:
    """Replace a function by one whose argument at ``place`` (negative: from the last) is changed."""

    def broken(original):
        def call(*args, **options):
            given = list(args)
            given[place] = change(given[place])
            return original(*given, **options)

        return call

    return broken


def keywords(**changes: Callable) -> Callable:
    """Replace a function by one of which these keywords are changed."""
    return lambda original: (
        lambda *args, **given: original(
            *args, **given | {name: change(given[name]) for name, change in changes.items()}
        )
    )


def oil_without(place: int, **lost) -> Callable:
    """Replace a function by one whose lubricant at ``place`` has lost something."""
    return argument(place, lambda oil: replace(oil, **lost))


def history_without(**lost) -> Callable:
    """Replace a contact in time by one whose lubricant has lost something."""
    return keywords(lubricant=lambda oil: replace(oil, **lost))


def line_without(**lost) -> Callable:
    """Replace a film solver by one that gets the line contact with another oil."""
    return argument(0, lambda line: replace(line, lubricant=replace(line.lubricant, **lost)))


def reversed_couette(original):
    """Fluxes through faces with -rho H for the Couette flow."""

    def residual(grid, problem, z, H):
        R, terms = original(grid, problem, z, H)
        flux = terms.flux - 2 * terms.face_density * terms.face_H
        return np.concatenate([1 - flux / terms.q, R[grid.n :]]), replace(terms, flux=flux)

    return residual


def first_row(original):
    """A contact whose mean gap is that of its first row along y."""

    def close(contact, *args, **options):
        found = original(contact, *args, **options)
        if found.fields is None:
            return found
        return replace(found, mean_gap=weighted_mean(np.maximum(found.fields.gap[:, 0], 0.0), contact.weight))

    return close


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
    return lambda cells, factors=None: original(cells, factors) - cells.coarse[0] / 2


def itself(original):
    """A function that hands a map back as it came."""
    return lambda surface, *args, **options: surface


def same_cells(original):
    """A function that exchanges the axes and not the cell lengths."""
    return lambda surface: replace(original(surface), spacing=surface.spacing)


def not_mirrored(original):
    """A map that is called periodic without being made so."""
    return lambda surface, *, axes=(True, True): replace(
        surface, periodic_axes=tuple(a or b for a, b in zip(axes, surface.periodic_axes))
    )


def from_the_corner(original):
    """A map that is cut from its first point instead of its middle."""
    return lambda surface, shape, start=None: original(surface, shape, (0, 0))


def from_the_first(original):
    """Coarse cells with the heights of their first own cells, not of those at their x."""
    return lambda cells, heights, factors: heights[:: factors[0], :: factors[1]]


def half_a_column(original):
    """The columns in contact, half a column off."""
    return lambda state, x: original(state, np.asarray(x) + 0.5 * (state.x[1] - state.x[0]))


def whole_patch(original):
    """An area A as long as the patch."""
    return lambda scene, x, step: np.ones(x.size)


FORMULAS = ("contact_grid", "ehl_grid", "friction", "load_sharing")
# what is asked to catch them, the place, and (name, what it is, what is put there) of every mutant
SINGLE: dict[tuple[str, ...], dict[str, tuple[tuple[str, str, Callable], ...]]] = {
    FORMULAS: {
        "lubfric.contact.operator:_symbol": (
            ("kernel_factor_2", "influence coefficients halved, as printed in the paper's Appendix 1", times(0.5)),
        ),
        "lubfric.contact.operator:semiperiodic_coefficients": (
            ("lost_images", "semi-periodic operator without its waves along y, the sum over images", mean_wave_only),
        ),
        "lubfric.film.newton:residual": (
            ("couette_sign", "Couette flow of Reynolds' equation runs backwards", reversed_couette),
        ),
        "lubfric.oil.lubricant:Lubricant.roelands_exponent": (
            ("viscosity_exponent", "Roelands' exponent with the decadic logarithm", decadic_exponent),
        ),
        "lubfric.contact.half_space:HalfSpaceContact.close": (
            ("missing_y_mean", "volume balance on one row instead of the mean along y", first_row),
        ),
        "lubfric.contact.half_space:solve_contact": (
            ("half_the_load", "rough contact carries half of F_C", keywords(mean_pressure=lambda p: p / 2)),
            ("stale_warm_start", "contact of the neighbouring load returned for this one", stale),
        ),
        "lubfric.contact.strip_cells:Cells.axis": (
            ("half_cell", "film and strip half a cell off the roughness", corner_axis),
        ),
        "lubfric.sharing.forces:shear_force": (("shear_side", "shear taken on the lower surface", lower_side),),
    },
    ("wiring_film",): {
        "lubfric.sharing.point:solve_line_contact": (
            ("film_viscosity_law", "viscosity law not passed to the film", line_without(viscosity_law="barus")),
            ("film_density_law", "density law not passed to the film", line_without(density_law="constant")),
            ("film_alpha", "alpha not passed to the film", line_without(pressure_viscosity_coefficient=25e-9)),
        ),
        "lubfric.film.shear:shear_stress": (
            ("steady_newtonian", "Eyring's law dropped in steady shear", oil_without(0, eyring_stress=None)),
            ("limit_offset", "limiting stress without its offset", oil_without(0, limiting_stress_offset=0.0)),
        ),
        "lubfric.sharing.forces:shear_force": (
            ("slide_roll", "slide-roll ratio always 2", with_keywords(slide_roll_ratio=2.0)),
        ),
    },
    ("wiring_contact",): {
        "lubfric.contact.rough_contract:ContactState.touching": (
            ("half_a_column", "contact fraction half a column off", half_a_column),
        ),
        "lubfric.contact.flat:contact_curve": (
            ("flat_hardness", "hardness not passed to the flat curve", with_keywords(hardness=None)),
        ),
        "lubfric.contact.flat:asperity_curve": (
            ("asperity_hardness", "hardness not passed to flat asperities", with_keywords(hardness=None)),
        ),
        "lubfric.contact.asperities:find_asperities": (
            ("asperity_hardness_cylinder", "hardness not passed to a cylinder's", with_keywords(hardness=None)),
        ),
        "lubfric.contact.half_space:solve_contact": (
            ("cylinder_hardness", "hardness not passed to a cylinder's contact", with_keywords(hardness=None)),
        ),
        "lubfric.contact.half_space:area_weight": (
            ("region", "area A is the whole patch, whatever was asked", whole_patch),
        ),
        "lubfric.contact.strip_cells:Cells.thinned": (
            ("coarse_heights", "coarse cells with heights from another x", from_the_first),
        ),
    },
    ("wiring_maps",): {
        "lubfric.surface.height_map:Surface.transposed": (
            ("motion_axis", "motion_axis = 'y' ignored", itself),
            ("transposed_cells", "axes exchanged, cell lengths not", same_cells),
        ),
        "lubfric.surface.height_map:Surface.scaled": (("map_not_scaled", "a map not scaled to sq", itself),),
        "lubfric.surface.height_map:Surface.resampled": (("map_spacing", "contact.spacing of a map ignored", itself),),
        "lubfric.surface.height_map:Surface.periodic": (
            ("map_not_mirrored", "a map called periodic that is not", not_mirrored),
        ),
        "lubfric.surface.height_map:Surface.cropped": (
            ("map_corner", "a map cut from its corner instead of its middle", from_the_corner),
        ),
        "lubfric.contact.height_map:read_surface": (
            ("map_unit", "unit of a file ignored", with_keywords(unit=None)),
            ("map_form", "form of a file ignored", with_keywords(form="plane")),
            ("map_cells", "cell lengths of a file swapped", keywords(spacing=lambda cells: cells[::-1])),
        ),
        "lubfric.contact.height_map:generate_surface": (
            ("seed", "seed of a generated map ignored", with_keywords(seed=1)),
            ("decay_level", "level at which a correlation length is read ignored", with_keywords(decay_level=0.3679)),
            ("one_length", "one correlation length for both axes", keywords(correlation_length=np.max)),
        ),
    },
    ("wiring_time",): {
        "lubfric.time.moment:shear_stress": (
            ("transient_newtonian", "Eyring's law dropped in a transient", oil_without(0, eyring_stress=None)),
            ("transient_no_limit", "limiting stress dropped", oil_without(0, limiting_stress_coefficient=None)),
        ),
        "lubfric.time.begin:ContactHistory": (
            ("transient_density", "density law dropped in a transient", history_without(density_law="constant")),
            ("transient_viscosity_law", "always Roelands' law in time", history_without(viscosity_law="roelands")),
            ("transient_load", "load of a transient taken as load per width", with_keywords(width=1.0)),
        ),
        "lubfric.scene.history:Ramp.at": (
            ("ramp_ignored", "ramps of a transient stay at their start", argument(1, lambda time: 0.0)),
        ),
    },
}
MUTANTS = (
    *(
        Mutant(name, what, {place: wrong}, suite)
        for suite, places in SINGLE.items()
        for place, mistakes in places.items()
        for name, what, wrong in mistakes
    ),
    Mutant(
        "penetration_ignored",
        "contact set and stopping test look at p g only",
        {
            "lubfric.contact.search:Search._look": without_overlap,
            "lubfric.contact.rounds:contact_residuals": no_penetration,
        },
        FORMULAS,
    ),
    Mutant(
        "transient_sliding",
        "sliding speed of a transient twice what it is",
        {"lubfric.time.sharing:sliding_at": times(2.0), "lubfric.time.moment:sliding_at": times(2.0)},
        ("wiring_time",),
    ),
)
