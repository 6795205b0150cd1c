"""The scene: bodies, surfaces, lubricant, motion and numerics, from a file or from Python."""

from .bodies import (
    BOUNDARY_FILM,
    BOUNDARY_FILM_KEY,
    BOUNDARY_FRICTION_KEY,
    FASTEST,
    FRICTION_OVER,
    HARDNESS_KEY,
    LARGEST_RATIO,
    SLIDE_ROLL_RATIO_KEY,
    SLIP_KEY,
    Bodies,
    ContactDomain,
    FrictionTable,
    Motion,
)
from .file import (
    OPTIONS_KEY,
    builtin_scenes,
    given_tables,
    load_scene,
    options_of,
    read_toml,
    scene_from_table,
    write_template,
)
from .history import Constant, Harmonic, History, Ramp, Table, horizon_of
from .materials import materials_of
from .moments import LongestContact, longest_contact, sampled_times
from .numerics import Numerics
from .plausible import (
    MOST_RATIO,
    check_ratios,
    hint_unusual_values,
    likely_unit,
    other_convention,
    refuse_far_value,
    source_of,
    typical,
    unusual_values,
)
from .roughness import LENGTH_KEYS, Roughness, named
from .scene import (
    Scene,
    check_resolved_gap,
    has_generated_roughness,
    has_moving_roughness,
    inputs_not_given,
    moving_bodies,
    toml_value,
    value_of,
    why_gap_not_resolved,
)
from .sections import ROUGH_SECTIONS, SECTIONS
from .short_forms import (
    MOST_SPEEDS,
    OIL_KEYS,
    SOURCES,
    fields_of_key,
    reduced_radius,
    short_keys,
    speeds_of_range,
)
from .transient import HISTORIES, UNITS_OF_HISTORIES, Transient, checked_history, moment_in_words, read_history
