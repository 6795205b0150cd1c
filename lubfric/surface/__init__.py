"""Height maps: read, prepared, generated, filtered and measured."""

from .generate import ACFS, generate_surface, honing_of, surface_generator
from .height_map import Surface
from .honed import GROOVE_LENGTH_RATIO, honed_sq
from .prepare import FORM_POWERS, advised_form, outliers
from .read import INSTRUMENTS, SUFFIXES, read_surface, units_of
from .statistics import PER_SQ, autocorrelation, check_slopes, correlation_length, rms_slope
from .text import DECIMALS
