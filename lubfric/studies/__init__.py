"""Many points: sweeps, studies, curves, fits, and the store that keeps them."""

from .._base.processes import MOST_WORKERS, cluster, pool, processors
from .best import COMPARED_DISTANCE, CORRELATION_OF_DESIGNS, BestDesign, best, best_mean
from .choose import AUTO_SPEEDS, each_once, expected_speeds, span
from .codec import classes_of, decode, encode, fits
from .conditions import design_keys, is_condition, operating_keys, points_are_designs, why_not_compared
from .curve import CurveResult, columns_of_curve, csv_bytes
from .curve_axes import draw_curve
from .differences import Difference, SingleChange, differences, single_changes
from .distributions import Normal
from .explain import WITHIN_WORDS, estimated_study, explained, in_words
from .fit import estimated_fit, explain_fit, fit, starts_in_words
from .fit_checks import ResidualTests, chance_of, residual_tests
from .fit_input import Measured, read_measured
from .fit_profile import Profile, confirmed_ends, flat_parameters, follow, loose_parameters
from .fit_result import FitResult, draw_fit, draw_residuals
from .fit_search import Candidate, are_parted, search_minima, with_minimum
from .interpolate import Interpolant, Samples, knee_of
from .law import Law, law_of
from .main_effects import MainEffect, is_scattered, main_effects, why_not_separated
from .operating_points import DURATION, INTERVAL_COLUMNS, ORDERED_BY, POSITION, mean_over_cycle
from .plan import StudyPlan, given_tables_of_study, load_study, plan_study, scenes_of
from .points import SPEED, UNUSED
from .result import OF_TOLERANCES, StudyResult, has_study, open_study, study
from .store import Store, digest, fingerprint, fingerprint_without_files, opened, point_key
from .study_lines import MOST_BANDS, NAMED, NAMED_SHADES, STYLES, line_colours, lines_over, name_places, tick_values
from .sweep import StribeckResult, TractionResult, stribeck, traction
from .tables import (
    LARGEST_BETWEEN,
    MOST_OF_POINTS,
    OVER_X,
    check_tools,
    columns_of_study,
    friction_over_speed,
    interval_band,
    label,
    mark_models,
    name_of,
    pairs_around_reversals,
    place_in_words,
    places_without_sliding,
    plot_map,
    plot_points,
    shown_numbers,
)
from .traction_gaps import Gap, gaps_of
from .unfinished import (
    UnfinishedCurve,
    count_of_kept,
    count_of_kept_ratios,
    is_all_solved,
    keep_ratios,
    keep_request,
    keys_of_ratios,
    unfinished_curve,
)
from .vary import Between, sample
