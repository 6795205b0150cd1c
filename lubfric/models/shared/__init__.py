"""What the models have in common: the scene made ready, heat, limits of validity, effects that are not modelled.

`prepared` has a scene made ready, and the contact on its strips and pieces, with `memo`; `statistics` has the standard
errors of means along a line and the number of strips that they need; `wording` writes errors as text. `load_sharing`
and `deterministic` do not import each other, `quick` imports both, and all import this one.
"""

from .alpha_in_words import (
    alpha_beside_interval,
    alpha_of_fit_in_words,
    alpha_of_points_in_words,
    expected_alpha_in_words,
    expected_alpha_of_scene,
)
from .checks import (
    ERROR_OF_ORDER_OF_MAGNITUDE,
    LARGE_NUMERICAL_ERROR,
    NUMERICAL_ERROR,
    SAMPLING_ERROR,
    is_of_impossible_stress,
    peak_hertz_pressure,
    violations_by_asperities,
    violations_by_deflection,
    violations_by_ends,
    violations_by_film,
    violations_by_heat,
    violations_by_inlet,
    violations_by_inlet_of_moment,
    violations_by_motion,
    violations_by_numerical_error,
    violations_by_patches,
    violations_by_pressure,
    violations_by_shear,
    violations_by_thickness,
    violations_by_typical_heat,
)
from .checks_before import (
    ExpectedViolations,
    beforehand,
    expected_in_film,
    expected_on_hertz,
    expected_without_interval,
    is_of_map_alone,
    stated_sq,
    violations_by_bodies,
    violations_by_form,
    violations_by_map,
    violations_by_strips,
    violations_by_unusual_inputs,
    why_map_too_small,
    why_sample_too_short,
    why_too_few_blocks,
)
from .control_variate import ControlVariate, with_divided_sliding, with_forces_of_film, with_rest_rolling
from .decision import Decision
from .film_speed import film_and_exponents, speed_of
from .guessed_friction import GAP_IN_CONTACT, expected_coefficient, expected_typical_heat
from .heat import (
    Heat,
    PressurisedFilm,
    error_by_heat,
    film_lubricant,
    heat_error_in_words,
    inlet_at,
    peclet_at,
    point_heat,
    surroundings,
    typical_heat,
)
from .largest_friction import (
    Sliding,
    beside_asperities,
    largest_boundary_friction,
    largest_of_each,
    largest_of_oil,
    largest_sliding_friction,
)
from .length_in_words import length_beside_interval
from .memo import (
    AttenuatedSummitsKey,
    BalanceKey,
    CellEffectKey,
    DryContactKey,
    JoinedKey,
    Key,
    Memo,
    OperatorKey,
    ShorterCellsKey,
    numbers_of_fields,
)
from .model_error import (
    BY_HEAT,
    DETERMINISTIC,
    IN_INTERVAL,
    MODEL_ERROR,
    REDUCED_BY_DETERMINISTIC,
    REDUCED_BY_TOLERANCE,
    ModelErrorPart,
    error_of_parts,
    largest_of,
    sides_of_parts,
    violations_by_model_error,
)
from .prepared import (
    Prepared,
    cells_of_contact,
    contact_at_inputs,
    contact_on_joined_strips,
    contact_on_piece,
    contact_on_strip,
    operator_on,
    pictured_contact,
    remembered,
    scene_of,
    way_to_shorter_cells,
    why_no_rough_film,
)
from .rolling import rolling_error_by_load, rolling_model_error, smooth_rolling_resistance
from .sides import UNKNOWN_SIDES, Sides, added_changes, added_sides, below_and_above
from .sliding import is_by_sliding
from .statistics import (
    FEW_CONTACTS,
    FREEDOM_NOT_COUNTED,
    LEAST_FREEDOM,
    PLACE_BLOCK,
    SAMPLE_GROWTH,
    SAMPLING_ERROR_MISSED,
    SAMPLING_MATTERS,
    SHARED_LENGTH,
    STRIPS_SAFETY,
    TIME_BLOCK,
    StandardError,
    add_errors,
    area_needed,
    block_error,
    half_width_of_error,
    has_too_few_contacts,
    is_smooth_over_cells,
    means_of_blocks,
    ratio_of_changes,
    strips_for_error,
    student,
)
from .unknown_limit import GIVE_LIMIT, LIMIT_RANGE, limit_bounds, limit_in_words
from .unmodelled import (
    ExpectedEffect,
    UnmodelledEffect,
    change_in_words,
    effect_in_words,
    ends_of_alpha,
    expected_effects,
    stated_way_to_motion,
    unmodelled_effects,
)
from .violation import (
    Assumption,
    GatheredTexts,
    Violation,
    at_value,
    at_values,
    first_sentence,
    gathered,
    gathered_in_table,
    gathered_on_curve,
    in_a_cell,
    numbers_in_words,
    refused,
    sentence,
    violations_of,
)
from .wording import (
    LEAST_STATED_PART,
    LEAST_STATED_RISE,
    NEAR_ZERO,
    is_near_zero,
    percent,
    percent_beside,
    percent_of_sides,
    percent_or_less,
    rise_in_words,
    sides_in_f,
    standard_error_in_words,
)
