"""Options that are lost on their way to the number. Each function works, but something that was asked for does not
arrive."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from .mutant import Mutant, with_keywords

FILM, CONTACT, MAPS, TIME = (("wiring_" + name,) for name in ("film", "contact", "maps", "time"))


def with_oil(**lost):
    """A film solver that gets the line contact with another oil."""
    return lambda original: (
        lambda line, *args, **options: original(
            replace(line, lubricant=replace(line.lubricant, **lost)), *args, **options
        )
    )


def in_time_without(**lost):
    """A contact in time with another oil."""

    def broken(original):
        return lambda **history: original(**history | {"lubricant": replace(history["lubricant"], **lost)})

    return broken


def sheared_without(**lost):
    """A shear law that leaves something out."""
    return lambda original: lambda lubricant, *args: original(replace(lubricant, **lost), *args)


def itself(original):
    """A function that hands a map back as it came."""
    return lambda surface, *args, **options: surface


def same_cells(original):
    """A function that exchanges the axes and not the cell lengths."""
    return lambda surface: replace(original(surface), spacing=surface.spacing)


def not_mirrored(original):
    """A map that is called periodic without being made so."""
    return lambda surface, edge="mirror", *, axes=(True, True): replace(
        surface, periodic_axes=tuple(a or b for a, b in zip(axes, surface.periodic_axes))
    )


def from_the_corner(original):
    """A map that is cut from its first point instead of its middle."""
    return lambda surface, shape, start=None: original(surface, shape, (0, 0))


def swapped_cells(original):
    """A file whose cell lengths are the wrong way round."""
    return lambda path, **options: original(path, **options | {"spacing": options["spacing"][::-1]})


def one_length(original):
    """A generated map with one correlation length for both axes."""
    return lambda *args, **options: original(
        *args, **options | {"correlation_length": np.max(options["correlation_length"])}
    )


def subsampled(original):
    """A coarse grid of every other height instead of the mean of the cells."""

    def coarse(contact):
        found = original(contact)
        if found is None:
            return None
        fx, fy = (a // b for a, b in zip(contact.heights.shape, found.heights.shape))
        return replace(found, heights=contact.heights[::fx, ::fy])

    return coarse


def half_a_column(original):
    """The columns in contact, half a column off."""
    return lambda state, x: original(state, np.asarray(x) + 0.5 * (state.x[1] - state.x[0]))


def whole_patch(original):
    """An area A as long as the patch."""
    return lambda scene, x, step: np.ones(x.size)


def doubled(original):
    """Twice what it should be."""
    return lambda *args: 2 * original(*args)


def of_unit_width(original):
    """A contact in time whose load is not divided by the width."""
    return lambda **history: original(**history | {"width": 1.0})


def still(original):
    """A history that stays at its first value."""
    return lambda history, time: original(history, 0.0)


MUTANTS = (
    Mutant(
        "transient_newtonian",
        "Eyring's law dropped in a transient",
        {"lubfric.time.moment:shear_stress": sheared_without(eyring_stress=None)},
        TIME,
    ),
    Mutant(
        "transient_no_limit",
        "limiting stress dropped in a transient",
        {"lubfric.time.moment:shear_stress": sheared_without(limiting_stress_coefficient=None)},
        TIME,
    ),
    Mutant(
        "transient_density",
        "density law dropped in a transient",
        {"lubfric.time.begin:ContactHistory": in_time_without(density_law="constant")},
        TIME,
    ),
    Mutant(
        "transient_viscosity_law",
        "viscosity law of a transient is Roelands' whatever was asked",
        {"lubfric.time.begin:ContactHistory": in_time_without(viscosity_law="roelands")},
        TIME,
    ),
    Mutant(
        "transient_sliding",
        "sliding speed of a transient twice what it is",
        {f"lubfric.time.{where}:sliding_at": lambda f: lambda *args: 2 * f(*args) for where in ("scene_now", "moment")},
        TIME,
    ),
    Mutant(
        "transient_load",
        "load of a transient taken as load per width",
        {"lubfric.time.begin:ContactHistory": of_unit_width},
        TIME,
    ),
    Mutant("ramp_ignored", "ramps of a transient stay at their start", {"lubfric.scene.history:Ramp.at": still}, TIME),
    Mutant(
        "film_viscosity_law",
        "viscosity law not passed to the film",
        {"lubfric.film.levels:solve_line_contact": with_oil(viscosity_law="barus")},
        FILM,
    ),
    Mutant(
        "film_density_law",
        "density law not passed to the film",
        {"lubfric.film.levels:solve_line_contact": with_oil(density_law="constant")},
        FILM,
    ),
    Mutant(
        "film_alpha",
        "pressure-viscosity coefficient of the film not that of the scene",
        {"lubfric.film.levels:solve_line_contact": with_oil(pressure_viscosity_coefficient=25e-9)},
        FILM,
    ),
    Mutant(
        "steady_newtonian",
        "Eyring's law dropped in steady shear",
        {"lubfric.film.shear:shear_stress": sheared_without(eyring_stress=None)},
        FILM,
    ),
    Mutant(
        "limit_offset",
        "limiting stress without its offset",
        {"lubfric.film.shear:shear_stress": sheared_without(limiting_stress_offset=0.0)},
        FILM,
    ),
    Mutant(
        "slide_roll",
        "slide-roll ratio always 2",
        {"lubfric.film.contract:shear_force": with_keywords(slide_roll_ratio=2.0)},
        FILM,
    ),
    Mutant(
        "half_a_column",
        "contact fraction half a column off",
        {"lubfric.contact.rough_contract:ContactState.touching": half_a_column},
        CONTACT,
    ),
    Mutant(
        "flat_hardness",
        "hardness not passed to the flat curve",
        {"lubfric.contact.flat:contact_curve": with_keywords(hardness=None)},
        CONTACT,
    ),
    Mutant(
        "asperity_hardness",
        "hardness not passed to the asperities of a flat contact",
        {"lubfric.contact.flat:asperity_curve": with_keywords(hardness=None)},
        CONTACT,
    ),
    Mutant(
        "asperity_hardness_cylinder",
        "hardness not passed to the asperities under a cylinder",
        {"lubfric.contact.asperities:find_asperities": with_keywords(hardness=None)},
        CONTACT,
    ),
    Mutant(
        "cylinder_hardness",
        "hardness not passed to the contact under a cylinder",
        {"lubfric.contact.half_space:solve_contact": with_keywords(hardness=None)},
        CONTACT,
    ),
    Mutant(
        "region",
        "area A is the whole patch, whatever was asked",
        {"lubfric.contact.half_space:area_weight": whole_patch},
        CONTACT,
    ),
    Mutant(
        "subsampled_grids",
        "coarse grids take every other height instead of means",
        {"lubfric.contact.half_space_grid:HalfSpaceGrid.coarsened": subsampled},
        CONTACT,
    ),
    Mutant("motion_axis", "motion_axis = 'y' ignored", {"lubfric.surface.height_map:Surface.transposed": itself}, MAPS),
    Mutant(
        "transposed_cells",
        "axes exchanged, cell lengths not",
        {"lubfric.surface.height_map:Surface.transposed": same_cells},
        MAPS,
    ),
    Mutant("map_not_scaled", "a map not scaled to sq", {"lubfric.surface.height_map:Surface.scaled": itself}, MAPS),
    Mutant(
        "map_spacing",
        "contact.spacing of a map ignored",
        {"lubfric.surface.height_map:Surface.resampled": itself},
        MAPS,
    ),
    Mutant(
        "map_not_mirrored",
        "a map called periodic that is not",
        {"lubfric.surface.height_map:Surface.periodic": not_mirrored},
        MAPS,
    ),
    Mutant(
        "map_corner",
        "a map cut from its corner instead of its middle",
        {"lubfric.surface.height_map:Surface.cropped": from_the_corner},
        MAPS,
    ),
    Mutant(
        "map_unit",
        "unit of a file ignored",
        {"lubfric.contact.height_map:read_surface": with_keywords(unit=None)},
        MAPS,
    ),
    Mutant(
        "map_form",
        "form of a file ignored",
        {"lubfric.contact.height_map:read_surface": with_keywords(form="plane")},
        MAPS,
    ),
    Mutant(
        "map_cells", "cell lengths of a file swapped", {"lubfric.contact.height_map:read_surface": swapped_cells}, MAPS
    ),
    Mutant(
        "seed",
        "seed of a generated map ignored",
        {"lubfric.contact.height_map:generate_surface": with_keywords(seed=1)},
        MAPS,
    ),
    Mutant(
        "decay_level",
        "level at which a correlation length is read ignored",
        {"lubfric.contact.height_map:generate_surface": with_keywords(decay_level=0.3679)},
        MAPS,
    ),
    Mutant(
        "one_length",
        "one correlation length for both axes",
        {"lubfric.contact.height_map:generate_surface": one_length},
        MAPS,
    ),
)
